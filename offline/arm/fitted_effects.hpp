// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "effects/fitted_laws.hpp"
#include "plumb/format/model.hpp"
#include "plumb/runtime/detail/effect_set.hpp"

namespace plumb::offline {

/// The effects of a model as a fit evaluates them: one at a time, with the parameters of the fit,
/// and including effects of the measurement, which the runtime lacks. Refers to the memory of the
/// model. Precondition: find_fitted_law knows every effect of the model.
class FittedEffects {
 public:
  explicit FittedEffects(const format::Model& model);

  bool empty() const { return effects_.empty(); }
  int size() const { return static_cast<int>(effects_.size()); }

  /// Whether effect i can be evaluated at measured poses only, and so not by the runtime: a law of
  /// the measurement, or a formula that reads the last moves or the row.
  bool of_measurement(int i) const { return effects_[static_cast<std::size_t>(i)].of_measurement; }

  /// Context and loads of one pose, computed once for all effects. Points to the context that
  /// `survey` was given.
  struct Surroundings {
    const MeasuredContext* context = nullptr;
    Loads loads;
  };
  void survey(const ChainFrames& frames, const MeasuredContext& context, Surroundings& out) const;

  /// Adds the motion of effect i, computed with the parameters theta instead of the model's.
  template <class S>
  void apply_one(int i, std::span<const S> theta, std::span<const double> q, const Chain& chain,
                 const ChainFrames& frames, const Surroundings& around, Motion<S>& out) const {
    const Bound& bound = effects_[static_cast<std::size_t>(i)];
    const Situation at{.q = q,
                       .chain = chain,
                       .frames = frames,
                       .loads = around.loads,
                       .context = around.context->known,
                       .fallbacks = fallbacks_.values()};
    apply_fitted_law<S>(bound.law, theta, bound.shape, at, *around.context, out);
  }

 private:
  struct Bound {
    int law = 0;
    EffectShape shape;
    bool of_measurement = false;
  };
  std::vector<Bound> effects_;
  Fallbacks fallbacks_;
  Weights weights_;
};

}  // namespace plumb::offline

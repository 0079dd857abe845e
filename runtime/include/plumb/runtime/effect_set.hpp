// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <string>

#include "plumb/format/model.hpp"
#include "plumb/runtime/effect_library.hpp"

namespace plumb {

/// Why the effects of a model cannot be evaluated by this library.
struct EffectFault {
  enum class Kind {
    kNone,
    kUnknownLaw,  // no law of that name
    kNewer,       // a newer version of it
    kConstants,   // another count of constants
    kParameters,  // or of parameters
    kSensors,     // more temperatures than a context holds
    kFormula      // code that cannot be run
  };
  Kind kind = Kind::kNone;
  std::size_t effect = 0;  // which
  std::size_t count = 0;   // what the law expects
};
EffectFault find_effect_fault(const format::Model& model) noexcept;

/// The k-th temperature sensor that the effects read, as Context::temperature_degC counts them;
/// null behind the last.
const std::string* temperature_name(const format::Model& model, int k) noexcept;

/// An effect of a model and its law.
struct BoundEffect {
  int law = 0;
  void (*apply)(const BoundEffect& effect, const Situation& at, Motion<double>& out) = nullptr;
  EffectShape shape;
  std::span<const double> theta;
};

/// The effects of a model, ready for the cycle. Refers to the model's memory.
/// Precondition: find_effect_fault finds none.
class EffectSet {
 public:
  EffectSet() = default;
  explicit EffectSet(const format::Model& model) noexcept;

  bool empty() const noexcept { return count_ == 0; }
  int size() const noexcept { return static_cast<int>(count_); }

  /// What all laws share at one pose.
  struct Surroundings {
    Context context;
    Loads loads;
  };
  void survey(const ChainFrames& frames, const Context& context, Surroundings& out) const noexcept;

  /// Adds the motion of effect i with parameters theta instead of the model's.
  template <class S>
  void apply_one(int i, std::span<const S> theta, std::span<const double> q, const Chain& chain,
                 const ChainFrames& frames, const Surroundings& around, Motion<S>& out) const {
    const BoundEffect& bound = effects_[static_cast<std::size_t>(i)];
    const Situation at{.q = q,
                       .chain = chain,
                       .frames = frames,
                       .loads = around.loads,
                       .context = around.context,
                       .stand_ins = stand_ins_};
    apply_effect<S>(bound.law, theta, bound.shape, at, out);
  }

  /// What the laws see of the poses of one context. One a thread.
  struct Scene {
    WidePoint payload_T;
    ChainPoints points_B;
    ChainFrames frames;
    Loads loads;
    const Context* context;
    bool stood_in;  // a fallback, for something unknown in it
  };
  /// The context must live as long as the scene is used.
  void prepare(const Context& context, Scene& out) const noexcept;

  /// Motion of the arm at one pose of the scene. `chain` is the calibrated one. True if a fallback
  /// stood in for an input that was unknown, or if a formula has no value here and moved nothing.
  /// Cost: fixed for a given model. Wait-free, any thread.
  bool apply(std::span<const double> q, const Chain& chain, Scene& scene,
             Motion<double>& out) const noexcept;

 private:
  static constexpr std::size_t kInputs = sizeof(Context) / sizeof(double);

  void bind(const format::Model& model, const format::Effect& effect, int law) noexcept;
  void stand_in(const format::ContextNeed& need, const BoundEffect& bound,
                std::size_t& sensor) noexcept;
  void stand_in(std::size_t input, double value) noexcept;

  /// Something that an effect needs.
  bool lacks(const Context& context) const noexcept;

  std::array<BoundEffect, format::kMaxEffects> effects_;
  std::array<std::size_t, kInputs + 1> needs_;  // places in Context; the last stands there twice
  std::size_t need_count_ = 0;
  Context stand_ins_;  // for what is needed and unknown: the first effect that needs it says what
  std::size_t count_ = 0;
  Weights weights_;
};

}  // namespace plumb

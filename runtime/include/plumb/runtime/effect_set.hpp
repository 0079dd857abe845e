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

/// The effects of a model, ready for the cycle. Refers to the model's memory.
/// Precondition: find_effect_fault finds none.
class EffectSet {
  using Apply = void (*)(std::span<const double> theta, const EffectShape& shape,
                         const Situation& at, Motion<double>& out);
  struct Bound {
    int law = 0;
    Apply apply = nullptr;
    EffectShape shape;
    std::span<const double> theta;
    std::span<const format::ContextNeed> needs;
    int temperature = -1;                                          // sensor
    std::array<std::uint8_t, format::kMaxTemperatures> sensors{};  // of all its temperatures
    std::size_t sensor_count = 0;
  };

 public:
  EffectSet() = default;
  explicit EffectSet(const format::Model& model) noexcept;

  bool empty() const noexcept { return count_ == 0; }
  int size() const noexcept { return count_; }

  /// What all laws share at one pose.
  struct Surroundings {
    Context context;  // fallbacks filled in
    Loads loads;
    bool stood_in = false;  // a fallback was needed
  };
  void survey(const Chain& chain, const ChainFrames<double>& frames, const Context& context,
              Surroundings& out) const noexcept;

  /// Adds the motion of effect i with parameters theta instead of the model's.
  template <class S>
  void apply_one(int i, std::span<const S> theta, std::span<const double> q, const Chain& chain,
                 const ChainFrames<double>& frames, const Surroundings& around,
                 Motion<S>& out) const {
    const Bound& bound = effects_[static_cast<std::size_t>(i)];
    apply_effect<S>(bound.law, theta, bound.shape, situation(bound, q, chain, frames, around), out);
  }

  /// Motion of the arm at one pose. `chain` is the calibrated one, `frames` its frames at q without
  /// any effect. True if a fallback stood in for an input that was unknown, or if a formula has no
  /// value here and moved nothing.
  /// Cost: fixed for a given model. Wait-free, any thread.
  bool apply(std::span<const double> q, const Chain& chain, const ChainFrames<double>& frames,
             const Context& context, Motion<double>& out) const noexcept;

 private:
  static bool fill_in(const Bound& bound, Context& context) noexcept;
  bool fill_in(Context& context) const noexcept;
  static Situation situation(const Bound& bound, std::span<const double> q, const Chain& chain,
                             const ChainFrames<double>& frames,
                             const Surroundings& around) noexcept {
    const auto sensor = static_cast<std::size_t>(bound.temperature);
    return {.q = q,
            .chain = chain,
            .frames = frames,
            .loads = around.loads,
            .context = around.context,
            .temperature_degC =
                bound.temperature < 0 ? kUnknown : around.context.temperature_degC[sensor],
            .sensors = std::span(bound.sensors).first(bound.sensor_count)};
  }

  std::array<Bound, format::kMaxEffects> effects_;
  int count_ = 0;
  const format::Model* model_ = nullptr;
  Transformd X_TF_;  // flange in the tool frame
};

}  // namespace plumb

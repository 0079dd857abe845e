// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <string>

#include "plumb/format/model.hpp"
#include "plumb/runtime/detail/effect_library.hpp"
#include "plumb/runtime/detail/fallbacks.hpp"

namespace plumb {

/// Why the effects of a model cannot be evaluated by this library.
struct EffectFault {
  enum class Kind {
    kNone,
    kUnknownLaw,  // there is no law of that name
    kNewer,       // the model needs a newer version of the law
    kConstants,   // the number of constants is wrong
    kParameters,  // the number of parameters is wrong
    kSensors,     // the effects read more temperatures than a context holds
    kFormula      // the code of a formula cannot be run
  };
  Kind kind = Kind::kNone;
  std::size_t effect = 0;  // index of the effect
  std::size_t count = 0;   // the number, or version, that the law expects
};
EffectFault find_effect_fault(const format::Model& model) noexcept;

/// Name of the k-th temperature sensor that the effects read, in the order of
/// Context::temperature_degC; null after the last.
const std::string* temperature_name(const format::Model& model, int k) noexcept;

/// What a law needs to know of an effect of the model. Refers to the memory of both.
EffectShape effect_shape(const format::Model& model, const format::Effect& effect) noexcept;

/// The masses of the model, with the payload that its effects fall back to.
Weights effect_weights(const format::Model& model, const Fallbacks& fallbacks) noexcept;

/// An effect of a model together with its law.
struct BoundEffect {
  void (*apply)(const BoundEffect& effect, const Situation& at, Motion<double>& out) = nullptr;
  EffectShape shape;
  std::span<const double> theta;
};

/// The effects of a model, ready for the cycle. Refers to the model's memory.
/// Precondition: find_effect_fault finds no fault.
class EffectSet {
 public:
  EffectSet() = default;
  explicit EffectSet(const format::Model& model) noexcept;

  bool empty() const noexcept { return count_ == 0; }

  /// Working memory for the poses of one context. Every thread needs its own.
  struct Workspace {
    WidePoint payload_T;
    ChainPoints points_B;
    ChainFrames frames;
    Loads loads;
    const Context* context;
    bool used_fallback;  // a fallback replaces at least one unknown input of the context
  };
  /// Prepares `out` for this context, which must live as long as the workspace is used.
  void prepare(const Context& context, Workspace& out) const noexcept;

  /// Adds the motion of all effects at pose q to `out`. `chain` is the calibrated one. Returns true
  /// if a fallback replaced an unknown input, or if a formula has no value here and moved nothing.
  /// Cost: fixed for a given model. Wait-free, any thread.
  bool apply(std::span<const double> q, const Chain& chain, Workspace& workspace,
             Motion<double>& out) const noexcept;

 private:
  void bind(const format::Model& model, const format::Effect& effect, int law) noexcept;

  std::array<BoundEffect, format::kMaxEffects> effects_;
  Fallbacks fallbacks_;
  std::size_t count_ = 0;
  Weights weights_;
};

}  // namespace plumb

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstring>

#include "plumb/format/model.hpp"
#include "plumb/runtime/context.hpp"
#include "plumb/runtime/detail/effect.hpp"

namespace plumb {

/// The inputs that the effects of a model need from a context, and the values that stand for those
/// that are unknown.
class Fallbacks {
 public:
  /// Adds the inputs that an effect of this shape declares. The first effect that needs an input
  /// decides on its fallback.
  void add(const format::Effect& effect, const EffectShape& shape) noexcept;

  /// The fallback of every input that is needed; kUnknown for all others.
  const Context& values() const noexcept { return values_; }

  /// True if an input that an effect needs is unknown. Compares two inputs at a time: a comparison
  /// is unordered if either of them is NaN, that is unknown.
  bool used_for(const Context& context) const noexcept {
    const auto* const bytes = reinterpret_cast<const std::byte*>(&context);
    bool any = false;
    for (std::size_t i = 0; i < need_count_; i += 2) {
      double one, other;
      std::memcpy(&one, bytes + needs_[i] * sizeof one, sizeof one);
      std::memcpy(&other, bytes + needs_[i + 1] * sizeof other, sizeof other);
      any |= __builtin_isunordered(one, other) != 0;
    }
    return any;
  }

 private:
  static constexpr std::size_t kInputs = sizeof(Context) / sizeof(double);

  void add(const format::ContextNeed& need, const EffectShape& shape, std::size_t& sensor) noexcept;
  void add(std::size_t input, double value) noexcept;

  std::array<std::size_t, kInputs + 1> needs_;  // indices into Context; the last is repeated
  std::size_t need_count_ = 0;
  Context values_;
};

}  // namespace plumb

// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/fallbacks.hpp"

#include <algorithm>
#include <span>
#include <type_traits>

namespace plumb {
namespace {

/// The position of an input in a Context, counted in doubles, so that a required input is found by
/// an index instead of a switch.
constexpr std::size_t place(std::size_t bytes) noexcept { return bytes / sizeof(double); }
constexpr std::size_t kDirectionAt = place(offsetof(Context, direction));
constexpr std::size_t kTravelAt = place(offsetof(Context, travel));
constexpr std::size_t kPayloadAt = place(offsetof(Context, payload_kg));
constexpr std::size_t kTemperatureAt = place(offsetof(Context, temperature_degC));
constexpr std::size_t kTimeAt = place(offsetof(Context, time_s));
static_assert(std::is_standard_layout_v<Context> && std::is_trivially_copyable_v<Context>);

}  // namespace

void Fallbacks::add(const format::Effect& effect, const EffectShape& shape) noexcept {
  std::size_t sensor = 0;
  for (const auto& need : effect.context) add(need, shape, sensor);
}

void Fallbacks::add(const format::ContextNeed& need, const EffectShape& shape,
                    std::size_t& sensor) noexcept {
  switch (need.input) {
    case format::ContextInput::kDirection:
      for (const std::size_t j : shape.joints) add(kDirectionAt + j, need.fallback);
      break;
    case format::ContextInput::kTravel:
      for (const std::size_t j : shape.joints) add(kTravelAt + j, need.fallback);
      break;
    case format::ContextInput::kPayload:
      add(kPayloadAt, need.fallback);
      break;
    case format::ContextInput::kTemperature:
      if (sensor < shape.sensors.size())
        add(kTemperatureAt + shape.sensors[sensor++], need.fallback);
      break;
    case format::ContextInput::kTime:
      add(kTimeAt, need.fallback);
      break;
  }
}

void Fallbacks::add(std::size_t input, double value) noexcept {
  const auto needed = std::span(needs_).first(need_count_);
  if (input >= kInputs || std::find(needed.begin(), needed.end(), input) != needed.end()) return;
  needs_[need_count_++] = input;
  needs_[need_count_] = input;
  std::memcpy(reinterpret_cast<std::byte*>(&values_) + input * sizeof value, &value, sizeof value);
}

}  // namespace plumb

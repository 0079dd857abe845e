// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/context_inputs.hpp"

namespace plumb {
namespace {

double sound(double value) noexcept {
  constexpr double kLimit = ContextInputs::kMaxReading;
  return value >= -kLimit && value <= kLimit ? value : kUnknown;
}

}  // namespace

/// Takes a new reading or ages the last one. Returns true if a new reading came.
bool ContextInputs::Input::step(const Reading& came, double ageing_s) noexcept {
  age.advance(ageing_s);
  if (came.age_s != came.age_s) return false;
  value = sound(came.value);
  age.renew(came.age_s);
  return true;
}

double ContextInputs::Input::now(double limit_s) const noexcept {
  return age.within(limit_s) ? value : kUnknown;
}

void ContextInputs::step(const ContextReadings& came, double ageing_s) noexcept {
  const bool loaded = payload_kg_.step(came.payload_kg, ageing_s);
  for (std::size_t k = 0; k < payload_com_m_.size(); ++k)
    if (loaded) payload_com_m_[k] = sound(came.payload_com_m[k]);
  for (std::size_t k = 0; k < temperature_degC_.size(); ++k)
    temperature_degC_[k].step(came.temperature_degC[k], ageing_s);
  time_s_.step(came.time_s, ageing_s);
}

Context ContextInputs::context(const LastMove& move, int joints) const noexcept {
  Context out;
  for (std::size_t i = 0; i < static_cast<std::size_t>(joints); ++i) {
    out.direction[i] = move.direction(i);
    out.travel[i] = move.travel(i);
  }
  out.payload_kg = payload_kg_.now(limits_.payload_s);
  for (std::size_t k = 0; k < payload_com_m_.size(); ++k)
    if (payload_kg_.age.within(limits_.payload_s)) out.payload_com_m[k] = payload_com_m_[k];
  for (std::size_t k = 0; k < temperature_degC_.size(); ++k)
    out.temperature_degC[k] = temperature_degC_[k].now(limits_.temperature_s);
  out.time_s = time_s_.now(limits_.time_s) + time_s_.age.value_s();
  return out;
}

}  // namespace plumb

// SPDX-License-Identifier: Apache-2.0
#include "tests/rt/laws/planted_guard.hpp"

#include <array>
#include <stdexcept>
#include <string>

#include "plumb/runtime/context.hpp"

namespace plumb::tests {

Plant plant_named(std::string_view name) {
  constexpr std::array<std::string_view, 8> kNames{"",     "slew",  "size",    "finite",
                                                   "hold", "early", "residue", "impure"};
  for (std::size_t i = 0; i < kNames.size(); ++i)
    if (kNames[i] == name) return static_cast<Plant>(i);
  throw std::invalid_argument("no defect '" + std::string(name) + "'");
}

format::GuardLimits PlantedGuard::planted(format::GuardLimits limits) const {
  if (plant_ != Plant::kSlew) return limits;
  limits.slew_m_per_s *= 1e6;
  limits.slew_rad_per_s *= 1e6;
  return limits;
}

void PlantedGuard::swap(const format::GuardLimits& limits) {
  limits_ = limits;
  guard_.swap(planted(limits));
}

GuardOutput PlantedGuard::step(const Transformd& X_BD, const Correction& correction, double dt_s,
                               Guard::Inputs age) {
  const bool rare = ++steps_ % kRare == 0;
  GuardOutput out = guard_.step(X_BD, correction, dt_s, age);
  if (plant_ == Plant::kSize && rare) out.X_BC.p(1) += 3.0 * limits_.max_correction_m;
  if (plant_ == Plant::kFinite && rare) out.X_BC.R(1, 1) = kUnknown;
  if (plant_ == Plant::kHold && out.status == Status::kNotFinite) out.X_BC.p(2) = X_BD.p(2);
  if (plant_ == Plant::kEarly) out.has_output = true;
  refused_in_a_row_ = refused(out.status) ? refused_in_a_row_ + 1 : 0;
  if (plant_ == Plant::kResidue && refused_in_a_row_ > 10) out.X_BC.p(0) *= 1.0 + 0x1p-50;
  return out;
}

Correction PlantedGuard::spoiled(Correction correction) const {
  if (plant_ == Plant::kImpure && steps_ % 2 == 0) correction.residual_m *= 1.0 + 0x1p-50;
  return correction;
}

}  // namespace plumb::tests

// SPDX-License-Identifier: Apache-2.0
#include "show/parameter_unit.hpp"

#include <fmt/format.h>

#include "show/units.hpp"

namespace plumb::offline::show {

std::string ParameterUnit::text(double si) const {
  return plain ? fmt::format("{:.4f}", si * per_si) : fmt::format("{:.4g}", si * per_si);
}

ParameterUnit unit_of(const Estimate& parameter) {
  if (parameter.unit.empty()) return {unit(parameter.is_length), shown(1.0, parameter.is_length)};
  if (parameter.unit == "rad") return {"urad", 1e6};
  if (parameter.unit == "m") return {"um", 1e6};
  return {parameter.unit, 1.0, false};
}

}  // namespace plumb::offline::show

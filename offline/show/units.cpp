// SPDX-License-Identifier: Apache-2.0
#include "show/units.hpp"

#include <fmt/format.h>

#include <cmath>

namespace plumb::offline::show {

std::string mm(double metres) {
  const double value = to_mm(metres);
  const bool small = value != 0.0 && std::abs(value) < 0.001;
  return small ? fmt::format("{:.2g}", value) : fmt::format("{:.3f}", value);
}

std::string deg(double radians) { return fmt::format("{:.4f}", to_deg(radians)); }

std::string shortest(double value) { return fmt::format("{}", value); }

}  // namespace plumb::offline::show

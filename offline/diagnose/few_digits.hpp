// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace plumb::offline {

/// A number as a person would write it into a cell file: three digits.
inline double three_digits(double value) {
  if (!(std::abs(value) > 0.0) || !std::isfinite(value)) return value;
  const double digits = std::pow(10.0, 2 - std::floor(std::log10(std::abs(value))));
  return std::round(value * digits) / digits;
}

}  // namespace plumb::offline

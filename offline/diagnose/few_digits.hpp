// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace plumb::offline {

/// The number with so many digits.
inline double with_digits(double value, int count) {
  if (!(std::abs(value) > 0.0) || !std::isfinite(value)) return value;
  const double digits = std::pow(10.0, count - 1 - std::floor(std::log10(std::abs(value))));
  return std::round(value * digits) / digits;
}

/// An error as every sentence shows it, without its unit [mm].
inline std::string digits_mm(double metres) { return fmt::format("{:.3f}", metres * 1e3); }

/// A number as a person would write it into a cell file: three digits.
inline double three_digits(double value) { return with_digits(value, 3); }

/// A pitch, which adds up over the travel: five digits.
inline double five_digits(double value) { return with_digits(value, 5); }

}  // namespace plumb::offline

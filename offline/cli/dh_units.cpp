// SPDX-License-Identifier: Apache-2.0
#include "cli/dh_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "show/units.hpp"

namespace plumb::offline::cli {
namespace {

constexpr double kEighthTurn = std::numbers::pi / 4.0;
constexpr double kRoundedPi = 5e-3;  // 1.57 for pi/2, or a calibrated 1.5687
/// The largest length of a table looks like metres if it is below the first one, and like mm if it
/// is above the second one.
constexpr double kLongest_m = 5.0, kShortest_mm = 20.0;

double largest_of(const std::vector<double>& numbers) {
  double out = 0.0;
  for (const double x : numbers) out = std::max(out, std::abs(x));
  return out;
}

LikelyUnit likely_angle(const std::vector<double>& numbers) {
  const double largest = largest_of(numbers);
  if (largest > 2.0 * std::numbers::pi + kRoundedPi)
    return {"deg", fmt::format("{} is no angle in rad", show::shortest(largest))};
  for (const double x : numbers) {
    const double eighths = std::round(x / kEighthTurn);
    if (eighths != 0.0 && std::abs(x - eighths * kEighthTurn) < kRoundedPi)
      return {"rad", fmt::format("{} is {} deg in radians", show::shortest(x), 45.0 * eighths)};
  }
  return {};
}

LikelyUnit likely_length(const std::vector<double>& numbers) {
  const double largest = largest_of(numbers);
  if (largest > kShortest_mm)
    return {"mm", fmt::format("{} m is no link of an arm", show::shortest(largest))};
  if (largest != 0.0 && largest < kLongest_m)
    return {"m", fmt::format("the longest is {}, too short for mm", show::shortest(largest))};
  return {};
}

}  // namespace

LikelyUnit likely_unit(Quantity quantity, const std::vector<double>& numbers) {
  return quantity == Quantity::kAngle ? likely_angle(numbers) : likely_length(numbers);
}

}  // namespace plumb::offline::cli

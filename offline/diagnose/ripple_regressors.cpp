// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "diagnose/constants.hpp"
#include "diagnose/regressor.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {
namespace {

double range_of(const WhitenedFit& s, int joint) {
  return std::min(travel_of(s, joint), kMostRange_rad);
}

/// Slower waves are not tried: over the range of the joint they look like its first two harmonics
/// or a straight line.
double first_ripple(double range) { return 2.0 + 2.0 * M_PI / range; }

}  // namespace

double travel_of(const WhitenedFit& s, int joint) {
  double low = 1e300, high = -1e300;
  for (Eigen::Index i = 0; i < s.fit_poses(); ++i) {
    low = std::min(low, s.q(i)[joint]);
    high = std::max(high, s.q(i)[joint]);
  }
  return high - low;
}

std::vector<double> ripple_grid(const WhitenedFit& s, int joint) {
  std::vector<double> out;
  const double range = range_of(s, joint);
  if (range < kLeastRange_rad) return out;
  const double step = std::min(kRippleStep, M_PI / range);
  const int last = static_cast<int>(std::floor(kLastRipple / step));
  for (int k = static_cast<int>(std::ceil(first_ripple(range) / step)); k <= last; ++k)
    out.push_back(k * step);
  // Slower ones only in whole numbers, as gears have them, and with a period in the range at least.
  for (int k = kFirstWholeWave; k < first_ripple(range) - 0.5 * step; ++k)
    if (k * range >= 2.0 * M_PI) out.push_back(k);
  if (const auto& ratio = s.cell->mechanics[static_cast<std::size_t>(joint)].gear_ratio)
    for (const double waves : kAlwaysMotorWaves)
      if (waves * std::abs(*ratio) > kLastRipple) out.push_back(waves * std::abs(*ratio));
  return out;
}

std::vector<double> fast_ripple_grid(const WhitenedFit& s, int joint) {
  std::vector<double> out;
  const double range = range_of(s, joint);
  if (range < kLeastRange_rad) return out;
  const double step = std::min(kRippleStep, M_PI / range);
  double k = kLastRipple + step;
  while (k <= kFastest) {
    out.push_back(k);
    k += step;
  }
  if (const auto& ratio = s.cell->mechanics[static_cast<std::size_t>(joint)].gear_ratio)
    for (const double waves : kMotorWaves)
      if (waves * std::abs(*ratio) > kLastRipple) out.push_back(waves * std::abs(*ratio));
  return out;
}

Regressor ripple_regressor(const WhitenedFit& s, int joint, const std::vector<double>& cycles) {
  const double typical = descriptor_of(wave_effect()).law->parameters[0].typical;
  Regressor out;
  out.joint = joint;
  out.entry = {.name = wave_effect(), .joints = {joint}, .options = {}, .place = {}};
  const auto count = static_cast<Eigen::Index>(cycles.size());
  out.columns.resize(s.poses(), 2 * count);
  out.typical = Eigen::VectorXd::Constant(2 * count, typical);
  if (!cycles.empty()) set_option(out.entry, OptionKey::kCyclesPerTurn, cycles.front());
  for (Eigen::Index c = 0; c < 2 * count; ++c) out.members.push_back(static_cast<int>(c % 2));
  for (Eigen::Index i = 0; i < s.poses(); ++i) {
    const double q = s.q(i)[joint];
    // In equal steps one vector turns on: four products instead of two transcendental functions.
    const double step = count > 1 ? cycles[1] - cycles[0] : 0.0;
    const double turn_sin = std::sin(step * q), turn_cos = std::cos(step * q);
    double sin = 0.0, cos = 0.0;
    for (Eigen::Index k = 0; k < count; ++k) {
      if (k == 0 || std::abs(cycles[k] - cycles[k - 1] - step) > 1e-9) {
        sin = std::sin(cycles[k] * q) * typical;
        cos = std::cos(cycles[k] * q) * typical;
      } else {
        const double next = sin * turn_cos + cos * turn_sin;
        cos = cos * turn_cos - sin * turn_sin;
        sin = next;
      }
      out.columns(i, 2 * k) = sin;
      out.columns(i, 2 * k + 1) = cos;
    }
  }
  return out;
}

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#include "check/equal_repeats.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "cell/group_rows.hpp"
#include "check/constants.hpp"
#include "check/rounding.hpp"

namespace plumb::offline {
namespace {

/// Steps of the fixed-point iteration, which always suffice for it to settle.
constexpr int kMostRounds = 200;

/// Pairs of neighbouring repeats of one pose.
struct Pairs {
  double differ = 0.0;               // pairs that differ in some coordinate
  std::array<double, 3> agree_in{};  // of these: pairs that agree in x, y, z
  double agree_in_joints = 0.0;      // of these: pairs that agree in all joint positions
};

void compare(const Measurements& m, int a, int b, Pairs& out) {
  if (m.p_M.row(a) == m.p_M.row(b)) return;
  out.differ += 1.0;
  for (int k = 0; k < 3; ++k)
    out.agree_in[static_cast<std::size_t>(k)] += m.p_M(a, k) == m.p_M(b, k) ? 1.0 : 0.0;
  out.agree_in_joints += m.q.row(a) == m.q.row(b) ? 1.0 : 0.0;
}

/// Probability that two repeats agree in all axes, from the pairs that do not. The unknown number
/// of pairs that do so by chance is found by fixed-point iteration. Adding one pair that agrees and
/// one that differs (Laplace's rule) keeps the estimate cautious if there are few pairs.
double chance_from_pairs(const Measurements& m, const Pairs& pairs) {
  double chance = 0.0;
  for (int round = 0; round < kMostRounds; ++round) {
    const double all = pairs.differ / (1.0 - chance);
    double product = 1.0;
    for (std::size_t k = 0; k < 3; ++k)
      if (m.has_axis[k]) product *= (pairs.agree_in[k] + all * chance + 1.0) / (all + 2.0);
    chance = product;
  }
  return chance;
}

double chance_in_an_axis(double step, double sigma) {
  if (step <= 0.0) return 0.0;
  const double u = step / (2.0 * std::max(sigma, 1e-3 * step));
  return std::erf(u) + std::expm1(-u * u) / (u * std::sqrt(M_PI));
}

double chance_from_steps(const Measurements& m, const std::array<double, 3>& steps, double sigma) {
  double out = 1.0;
  for (std::size_t k = 0; k < 3; ++k)
    if (m.has_axis[k]) out *= chance_in_an_axis(steps[k], sigma);
  return out;
}

}  // namespace

EqualRepeats equal_by_rounding(const MeasurementFiles& measured, const NoiseFloor& floor) {
  EqualRepeats out;
  const auto steps = point_steps(measured);
  for (std::size_t k = 0; k < 3; ++k)
    if (measured.has_axis[k]) out.step_m = std::max(out.step_m, steps[k]);
  Pairs pairs;
  std::vector<int> all(static_cast<std::size_t>(measured.size()));
  std::iota(all.begin(), all.end(), 0);
  std::vector<double> sizes;  // of the poses
  visit_groups(measured.replicate_group, std::move(all), [&](std::span<const int> rows) {
    sizes.push_back(static_cast<double>(rows.size()));
    for (std::size_t a = 0; a < rows.size(); ++a)
      for (std::size_t b = a + 1; b < std::min(rows.size(), a + 1 + check::kNeighbours); ++b)
        compare(measured, rows[a], rows[b], pairs);
  });
  double chance = 0.0, joints = 1.0;
  if (pairs.differ >= check::kEnoughPairs) {
    chance = chance_from_pairs(measured, pairs);
    joints = (pairs.agree_in_joints + 1.0) / (pairs.differ + 2.0);
  } else {
    out.assumed = floor.source == NoiseFloor::Source::kNone;
    chance =
        chance_from_steps(measured, steps, out.assumed ? check::kQuietTracker_m : floor.sigma_m);
  }
  for (const double n : sizes) out.points += std::min(n - 1.0, 0.5 * n * (n - 1.0) * chance);
  out.rows = out.points * joints;
  return out;
}

double most_by_chance(double expected) {
  return check::kChanceFactor * expected + check::kChanceDeviations * std::sqrt(expected);
}

}  // namespace plumb::offline

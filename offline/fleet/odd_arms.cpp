// SPDX-License-Identifier: Apache-2.0
#include "fleet/odd_arms.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace plumb::offline::fleet {
namespace {

/// Probability that chi^2 of n degrees of freedom exceeds a value, by the cube-root transform
/// [Wilson & Hilferty 1931].
double chance_of(double chi2, double n) {
  const double a = 2.0 / (9.0 * n);
  return 0.5 * std::erfc((std::cbrt(chi2 / n) - (1.0 - a)) / std::sqrt(2.0 * a));
}

/// How odd an arm is among those that `typical` was learnt from.
OddArm oddness(const CellSummary& arm, const std::vector<Typical>& typical, std::size_t arms) {
  std::vector<Eigen::Index> own;
  std::vector<const Typical*> known;
  for (std::size_t i = 0; i < arm.numbers.size(); ++i)
    for (const Typical& t : typical)
      if (t.name == arm.numbers[i].name) {
        own.push_back(static_cast<Eigen::Index>(i));
        known.push_back(&t);
      }
  OddArm out{.cell = arm.name, .number = {}, .unit = {}, .chance = 1.0};
  if (own.empty()) return out;
  Eigen::MatrixXd S = arm.covariance(own, own);
  Eigen::VectorXd away(S.rows());
  for (Eigen::Index k = 0; k < away.size(); ++k) {
    const Typical& t = *known[static_cast<std::size_t>(k)];
    const ArmNumber& n = arm.numbers[static_cast<std::size_t>(own[static_cast<std::size_t>(k)])];
    // The mean is known no better than by so many arms.
    S(k, k) += t.sd * t.sd * (1.0 + 1.0 / std::max(1, t.arms));
    away(k) = n.value - t.mean;
    const double times = std::abs(away(k)) / std::sqrt(S(k, k));
    if (times <= out.times) continue;
    out.number = n.name;
    out.unit = n.unit;
    out.value = n.value;
    out.mean = t.mean;
    out.times = times;
  }
  const double chi2 = away.dot(S.ldlt().solve(away));
  // Either the whole of it, or one number alone.
  const double numbers = static_cast<double>(away.size());
  const double alone = numbers * std::erfc(out.times / std::sqrt(2.0));
  out.chance =
      std::min(1.0, 2.0 * static_cast<double>(arms) * std::min(chance_of(chi2, numbers), alone));
  return out;
}

}  // namespace

Sisters learn_sisters(std::vector<const CellSummary*> arms) {
  Sisters out;
  const std::size_t most = arms.size() / 4, all = arms.size();
  while (true) {
    out.typical = learn_typical(arms);
    if (out.typical.empty() || out.odd.size() >= most) return out;
    OddArm oddest{.cell = {}, .number = {}, .unit = {}, .chance = 1.0};
    std::size_t which = 0;
    for (std::size_t i = 0; i < arms.size(); ++i) {
      std::vector<const CellSummary*> others = arms;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
      OddArm one = oddness(*arms[i], out.typical, all);
      // Against the others alone only where it may matter, since each takes as long as learning.
      if (one.chance < 100.0 * kOddByChance)
        if (const auto sisters = learn_typical(others, out.typical); !sisters.empty())
          one = oddness(*arms[i], sisters, all);
      if (one.chance >= oddest.chance) continue;
      oddest = one;
      which = i;
    }
    if (oddest.chance > kOddByChance) return out;
    out.odd.push_back(oddest);
    arms.erase(arms.begin() + static_cast<std::ptrdiff_t>(which));
  }
}

}  // namespace plumb::offline::fleet

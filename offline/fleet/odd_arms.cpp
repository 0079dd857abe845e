// SPDX-License-Identifier: Apache-2.0
#include "fleet/odd_arms.hpp"

#include <algorithm>
#include <cmath>

#include "numbers/cholesky.hpp"
#include "numbers/tails.hpp"

namespace plumb::offline::fleet {
namespace {

constexpr std::size_t kFew = 60;  // arms: each is judged against the others

/// Probability that chi2 / n exceeds what it is by chance, where the variances are known by so many
/// degrees of freedom.
double chance_of(double chi2, double n, double dof) {
  return std::exp(ln_f_tail(chi2 / n, n, dof));
}

/// Degrees of freedom with which the variance of a difference is known: the spread from arm to arm
/// is an estimate, the uncertainty of the arm's own fit is not [Welch 1947].
double dof_of(double spread, double whole, int arms) {
  const double share = spread / whole;
  return (arms - 1.0) / std::max(share * share, 1e-6);
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
  double alone = 1.0, fewest = HUGE_VAL;
  for (Eigen::Index k = 0; k < away.size(); ++k) {
    const Typical& t = *known[static_cast<std::size_t>(k)];
    const ArmNumber& n = arm.numbers[static_cast<std::size_t>(own[static_cast<std::size_t>(k)])];
    // The mean is known no better than by so many arms.
    S(k, k) += t.sd * t.sd * (1.0 + 1.0 / std::max(1, t.arms));
    away(k) = n.value - t.mean;
    const double times = std::abs(away(k)) / std::sqrt(S(k, k));
    const double dof = dof_of(t.sd * t.sd, S(k, k), t.arms);
    fewest = std::min(fewest, static_cast<double>(t.arms) - 1.0);
    const double by_chance = chance_of(times * times, 1.0, dof);
    if (by_chance >= alone) continue;
    alone = by_chance;
    out.number = n.name;
    out.unit = n.unit;
    out.value = n.value;
    out.mean = t.mean;
    out.times = times;
  }
  const double chi2 = away.dot(SymmetricSolver(S).solve(away));
  // Either the whole of it, or one number alone.
  const double numbers = static_cast<double>(away.size());
  out.chance = std::min(1.0, 2.0 * static_cast<double>(arms) *
                                 std::min(chance_of(chi2, numbers, fewest), numbers * alone));
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
      OddArm one = oddness(*arms[i], out.typical, all);
      // Against the others alone: among few arms an odd one hides behind the spread that it makes.
      if (arms.size() <= kFew || one.chance < 100.0 * kOddByChance) {
        std::vector<const CellSummary*> others = arms;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
        if (const auto sisters = learn_typical(others, out.typical); !sisters.empty())
          one = oddness(*arms[i], sisters, all);
      }
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

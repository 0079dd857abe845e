// SPDX-License-Identifier: Apache-2.0
#include "fleet/typical.hpp"

#include <algorithm>
#include <cmath>

#include "numbers/gaussian.hpp"

namespace plumb::offline::fleet {
namespace {

constexpr int kIterations = 200;
constexpr double kSettled = 1e-4;     // relative change of every sd
constexpr double kLeastShare = 1e-3;  // of spread and noise: an sd is never taken smaller

/// One arm among the numbers of all arms.
struct Arm {
  std::vector<Eigen::Index> place;  // of each of its numbers
  Eigen::VectorXd x, variance;
  Eigen::MatrixXd information;  // of its fit: C^-1
};

std::vector<Typical> all_numbers(const std::vector<const CellSummary*>& arms) {
  std::vector<Typical> out;
  for (const auto* arm : arms)
    for (const auto& n : arm->numbers) {
      auto at =
          std::find_if(out.begin(), out.end(), [&](const Typical& t) { return t.name == n.name; });
      if (at == out.end()) {
        out.push_back({.name = n.name, .effect = n.effect, .unit = n.unit});
        at = out.end() - 1;
      }
      ++at->arms;
    }
  std::erase_if(out, [](const Typical& t) { return t.arms < kFewestArms; });
  return out;
}

Arm arm_of(const CellSummary& summary, const std::vector<Typical>& numbers) {
  Arm out;
  std::vector<Eigen::Index> own;
  for (std::size_t i = 0; i < summary.numbers.size(); ++i) {
    const auto at = std::find_if(numbers.begin(), numbers.end(), [&](const Typical& t) {
      return t.name == summary.numbers[i].name;
    });
    if (at == numbers.end()) continue;
    out.place.push_back(at - numbers.begin());
    own.push_back(static_cast<Eigen::Index>(i));
  }
  out.x.resize(static_cast<Eigen::Index>(own.size()));
  for (std::size_t i = 0; i < own.size(); ++i)
    out.x(static_cast<Eigen::Index>(i)) = summary.numbers[static_cast<std::size_t>(own[i])].value;
  const Eigen::MatrixXd C = summary.covariance(own, own);
  out.variance = C.diagonal();
  out.information = SymmetricSolver(C).inverse();
  return out;
}

}  // namespace

std::vector<Typical> learn_typical(const std::vector<const CellSummary*>& arms,
                                   const std::vector<Typical>& start) {
  if (static_cast<int>(arms.size()) < kFewestArms) return {};
  std::vector<Typical> out = all_numbers(arms);
  const auto count = static_cast<Eigen::Index>(out.size());
  if (count == 0) return out;
  std::vector<Arm> all;
  for (const auto* arm : arms) all.push_back(arm_of(*arm, out));

  Eigen::VectorXd mu = Eigen::VectorXd::Zero(count), spread = mu, told = mu;
  for (const Arm& arm : all)
    for (Eigen::Index k = 0; k < arm.x.size(); ++k) {
      mu(arm.place[static_cast<std::size_t>(k)]) += arm.x(k);
      told(arm.place[static_cast<std::size_t>(k)]) += 1.0;
    }
  mu = mu.cwiseQuotient(told);
  for (const Arm& arm : all)
    for (Eigen::Index k = 0; k < arm.x.size(); ++k) {
      const Eigen::Index p = arm.place[static_cast<std::size_t>(k)];
      spread(p) += std::pow(arm.x(k) - mu(p), 2);
    }
  Eigen::VectorXd of_fits = Eigen::VectorXd::Zero(count);  // variance
  for (const Arm& arm : all)
    for (Eigen::Index k = 0; k < arm.x.size(); ++k)
      of_fits(arm.place[static_cast<std::size_t>(k)]) += arm.variance(k);
  const Eigen::VectorXd least = kLeastShare * (spread + of_fits).cwiseQuotient(told).cwiseSqrt();
  Eigen::VectorXd sd = spread.cwiseQuotient(told).cwiseSqrt().cwiseMax(least);
  for (Eigen::Index k = 0; k < count; ++k)
    for (const Typical& t : start)
      if (t.name == out[static_cast<std::size_t>(k)].name) {
        mu(k) = t.mean;
        sd(k) = t.sd;
      }
  Eigen::VectorXd shrinkage = Eigen::VectorXd::Zero(count);
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(count), square = sum, of_mean = sum;
    std::vector<Eigen::VectorXd> m, v;
    for (const Arm& arm : all) {
      const Eigen::VectorXd tau = sd(arm.place), center = mu(arm.place);
      const Cholesky llt(with_prior(arm.information, tau));
      const Eigen::MatrixXd V = llt.solve(Eigen::MatrixXd::Identity(tau.size(), tau.size()));
      m.push_back(center + V * (arm.information * (arm.x - center)));
      v.push_back(V.diagonal());
      for (std::size_t k = 0; k < arm.place.size(); ++k) {
        const auto i = static_cast<Eigen::Index>(k);
        sum(arm.place[k]) += m.back()(i);
        of_mean(arm.place[k]) += v.back()(i) / (tau(i) * tau(i));
      }
    }
    mu = sum.cwiseQuotient(told);
    shrinkage = of_mean.cwiseQuotient(told);
    for (std::size_t a = 0; a < all.size(); ++a)
      for (std::size_t k = 0; k < all[a].place.size(); ++k) {
        const auto i = static_cast<Eigen::Index>(k);
        square(all[a].place[k]) += std::pow(m[a](i) - mu(all[a].place[k]), 2) + v[a](i);
      }
    // One degree of freedom is the mean's.
    const Eigen::VectorXd next =
        square.cwiseQuotient((told.array() - 1.0).matrix()).cwiseSqrt().cwiseMax(least);
    const double change = ((next - sd).cwiseAbs().cwiseQuotient(sd)).maxCoeff();
    sd = next;
    if (change < kSettled) break;
  }
  for (Eigen::Index k = 0; k < count; ++k) {
    out[static_cast<std::size_t>(k)].mean = mu(k);
    out[static_cast<std::size_t>(k)].sd = sd(k);
    out[static_cast<std::size_t>(k)].shrinkage = std::clamp(shrinkage(k), 0.0, 1.0);
  }
  return out;
}

}  // namespace plumb::offline::fleet

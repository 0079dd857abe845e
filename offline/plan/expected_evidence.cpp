// SPDX-License-Identifier: Apache-2.0
#include "plan/expected_evidence.hpp"

#include <algorithm>
#include <cmath>

#include "numbers/gaussian.hpp"

namespace plumb::offline {
namespace {

using Law = Rivals::Law;

constexpr int kMostExchangeRounds = 3;
/// An exchange must raise the value of the plan by more [nats].
constexpr double kWorthExchanging = 0.05;
/// Weight of the sum of both leads beside the smaller one. It decides between plans whose smaller
/// leads are equal.
constexpr double kBothCount = 0.02;

/// Expected sum of squares of the residual: that without noise, and the variance of the noise in
/// every line that is still to be measured.
double expected_square(const Rivals& rivals, const Eigen::MatrixXd& S, Eigen::Index y,
                       double further) {
  return S(y, y) + further * rivals.scale.variance;
}

double quick_ln_bayes(const Eigen::MatrixXd& S, const Law::Variant& law, Eigen::Index y, double Q,
                      double lines, const EvidenceScale& scale) {
  const double ridge = scale.variance / (law.width * law.width);
  const Cholesky of_law(
      with_prior(S.block(law.first, law.first, law.count, law.count), law.width, scale.variance));
  const Eigen::VectorXd half = of_law.whitened(S.col(y).segment(law.first, law.count));
  return evidence_gain(of_law.ln_det() - static_cast<double>(law.count) * std::log(ridge),
                       scale.dof * scale.variance + Q, half.squaredNorm(), lines + scale.dof)
      .ln_bayes;
}

template <class LnBayes>
double lead_of(const Law& right, const Law& wrong, const LnBayes& ln_bayes) {
  double best = -INFINITY;
  for (const auto& variant : wrong.variants)
    best = std::max(best, ln_bayes(variant, right.expected));
  return ln_bayes(right.variants.front(), right.expected) - best;
}

double value_of_leads(const Leads& leads) {
  return leads.least() + kBothCount * (leads.if_a + leads.if_b);
}

}  // namespace

ClearedProducts::ClearedProducts(const Eigen::MatrixXd& G, const Eigen::MatrixXd& Z) {
  const Eigen::Index p = G.cols();
  const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(p, p);
  covariance_ = Cholesky(I + G.transpose() * G).solve(I);
  cross_ = G.transpose() * Z;
  products_ = Z.transpose() * Z - cross_.transpose() * covariance_ * cross_;
}

Eigen::MatrixXd ClearedProducts::with(const Eigen::MatrixXd& G, const Eigen::MatrixXd& Z) const {
  const Eigen::MatrixXd GC = G * covariance_;
  const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(G.rows(), G.rows());
  const Cholesky llt(I + GC * G.transpose());
  const Eigen::MatrixXd surprise = llt.whitened(Z - GC * cross_);
  return products_ + surprise.transpose() * surprise;
}

void ClearedProducts::add(const Eigen::MatrixXd& G, const Eigen::MatrixXd& Z) {
  products_ = with(G, Z);
  const Eigen::MatrixXd GC = G * covariance_;
  const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(G.rows(), G.rows());
  const Cholesky llt(I + GC * G.transpose());
  const Eigen::MatrixXd half = llt.whitened(GC);
  covariance_ -= half.transpose() * half;
  cross_ += G.transpose() * Z;
}

Leads quick_leads(const Rivals& rivals, const Eigen::MatrixXd& S, double further) {
  const double lines = rivals.scale.lines + further;
  const auto ln_bayes = [&](const Law::Variant& law, Eigen::Index y) {
    return quick_ln_bayes(S, law, y, expected_square(rivals, S, y, further), lines, rivals.scale);
  };
  return {lead_of(rivals.a, rivals.b, ln_bayes), lead_of(rivals.b, rivals.a, ln_bayes)};
}

Leads exact_leads(const Rivals& rivals, const Eigen::MatrixXd& S, double further) {
  EvidenceScale scale = rivals.scale;
  scale.lines += further;
  const auto ln_bayes = [&](const Law::Variant& law, Eigen::Index y) {
    return evidence(S.block(law.first, law.first, law.count, law.count),
                    S.block(law.first, y, law.count, 1), expected_square(rivals, S, y, further),
                    scale)
        .ln_bayes;
  };
  return {lead_of(rivals.a, rivals.b, ln_bayes), lead_of(rivals.b, rivals.a, ln_bayes)};
}

Choice choose_readings(const Rivals& rivals, const ClearedProducts& known,
                       const std::vector<Eigen::MatrixXd>& G, const std::vector<Eigen::MatrixXd>& Z,
                       int n) {
  std::vector<bool> taken(G.size(), false);
  const auto counted = [&](const Eigen::MatrixXd& lines) {
    return rivals.fit_share * static_cast<double>(lines.rows());
  };
  const auto best = [&](const ClearedProducts& now, double further) {
    std::pair<int, double> out{-1, -INFINITY};
    for (std::size_t i = 0; i < G.size(); ++i) {
      if (taken[i]) continue;
      const double value =
          value_of_leads(quick_leads(rivals, now.with(G[i], Z[i]), further + counted(G[i])));
      if (value > out.second) out = {static_cast<int>(i), value};
    }
    return out;
  };
  Choice out;
  ClearedProducts now = known;
  double further = 0.0;
  const auto take = [&](int i, ClearedProducts& at, double& lines) {
    const auto k = static_cast<std::size_t>(i);
    at.add(G[k], Z[k]);
    lines += counted(G[k]);
  };
  for (int k = 0; k < std::min(n, static_cast<int>(G.size())); ++k) {
    const int i = best(now, further).first;
    if (i < 0) break;
    out.chosen.push_back(i);
    taken[static_cast<std::size_t>(i)] = true;
    take(i, now, further);
  }
  bool improved = true;
  for (int round = 0; round < kMostExchangeRounds && improved; ++round) {
    improved = false;
    for (int& place : out.chosen) {
      ClearedProducts without = known;
      double lines = 0.0;
      for (const int i : out.chosen)
        if (i != place) take(i, without, lines);
      const double value = value_of_leads(quick_leads(rivals, now.products(), further));
      taken[static_cast<std::size_t>(place)] = false;
      const auto [other, with_other] = best(without, lines);
      if (other >= 0 && with_other > value + kWorthExchanging) place = other, improved = true;
      taken[static_cast<std::size_t>(place)] = true;
      now = std::move(without);
      further = lines;
      take(place, now, further);
    }
  }
  out.products = now.products();
  out.further = further;
  return out;
}

}  // namespace plumb::offline

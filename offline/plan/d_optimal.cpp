// SPDX-License-Identifier: Apache-2.0
#include "plan/d_optimal.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plumb::offline {
namespace {

/// Rounds of exchanges; they end where none gains more than the rounding of the criterion.
constexpr int kMostRounds = 20;
constexpr double kBetter = 1e-9;

/// One term of the criterion: its information, and its columns of every candidate.
struct Ledger {
  Information information;
  double weight;
  std::vector<Eigen::MatrixXd> candidates;
};

class Chooser {
 public:
  Chooser(const std::vector<Eigen::MatrixXd>& candidates, const Eigen::MatrixXd& known,
          const Eigen::VectorXd& prior, const DesignCriterion& criterion)
      : taken_(candidates.size(), false) {
    for (const auto& term : criterion.terms) {
      Ledger ledger{Information(prior(term.columns)), term.weight, {}};
      ledger.information.add(known(Eigen::all, term.columns));
      for (const auto& A : candidates) ledger.candidates.push_back(A(Eigen::all, term.columns));
      ledgers_.push_back(std::move(ledger));
    }
    start_ = value();
  }

  Design choose(int n) {
    Design out;
    const auto most = static_cast<int>(taken_.size());
    for (int k = 0; k < std::min(n, most); ++k) take(best().first, out.chosen);
    for (int round = 0; round < kMostRounds && exchange(out); ++round) {
    }
    std::sort(out.chosen.begin(), out.chosen.end());
    out.value = value() - start_;
    return out;
  }

 private:
  double value() const {
    double out = 0.0;
    for (const auto& ledger : ledgers_) out += ledger.weight * ledger.information.ln_det();
    return out;
  }

  std::pair<int, double> best() const {
    std::pair<int, double> out{-1, -INFINITY};
    for (std::size_t i = 0; i < taken_.size(); ++i) {
      if (taken_[i]) continue;
      double gain = 0.0;
      for (const auto& ledger : ledgers_)
        gain += ledger.weight * ledger.information.gain(ledger.candidates[i]);
      if (gain > out.second) out = {static_cast<int>(i), gain};
    }
    return out;
  }

  void take(int candidate, std::vector<int>& chosen) {
    const auto i = static_cast<std::size_t>(candidate);
    for (auto& ledger : ledgers_) ledger.information.add(ledger.candidates[i]);
    taken_[i] = true;
    chosen.push_back(candidate);
  }

  bool exchange(Design& out) {
    bool improved = false;
    for (int& place : out.chosen) {
      const auto i = static_cast<std::size_t>(place);
      const double before = value();
      for (auto& ledger : ledgers_) ledger.information.remove(ledger.candidates[i]);
      taken_[i] = false;
      const auto [other, gain] = best();
      const bool better = other != place && value() + gain > before + kBetter;
      const auto k = static_cast<std::size_t>(better ? other : place);
      for (auto& ledger : ledgers_) ledger.information.add(ledger.candidates[k]);
      taken_[k] = true;
      if (!better) continue;
      place = other;
      ++out.exchanges;
      improved = true;
    }
    return improved;
  }

  std::vector<Ledger> ledgers_;
  std::vector<bool> taken_;
  double start_ = 0.0;
};

}  // namespace

DesignCriterion DesignCriterion::all(Eigen::Index parameters) {
  std::vector<Eigen::Index> columns(static_cast<std::size_t>(parameters));
  std::iota(columns.begin(), columns.end(), 0);
  return {{{std::move(columns), 1.0}}};
}

Design d_optimal(const std::vector<Eigen::MatrixXd>& candidates, const Eigen::MatrixXd& known,
                 const Eigen::VectorXd& prior, int n, const DesignCriterion& criterion) {
  return Chooser(candidates, known, prior, criterion).choose(n);
}

}  // namespace plumb::offline

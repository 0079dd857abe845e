// SPDX-License-Identifier: Apache-2.0
#include "tree/oblique.hpp"

#include <algorithm>
#include <numeric>

#include "numbers/pivoted_qr.hpp"
#include "numbers/spectrum.hpp"

namespace plumb::offline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kFollowed = 3;          // number of iterations from each start
constexpr double kWorthIt = 0.95;     // share of the RSS of the best split along an axis
constexpr double kNegligible = 0.02;  // smaller components of a direction are set to zero

/// The centred inputs and the outputs of some rows.
struct Cell {
  MatrixXd u, y;
};

Cell cell_of(const TrainingRows& rows, std::span<const int> which) {
  Cell out{MatrixXd(which.size(), rows.inputs), MatrixXd(which.size(), rows.outputs)};
  for (std::size_t i = 0; i < which.size(); ++i) {
    for (int k = 0; k < rows.inputs; ++k) out.u(i, k) = rows.value(which[i], k);
    for (int k = 0; k < rows.outputs; ++k)
      out.y(i, k) = rows.value(which[i], rows.term_count() + k);
  }
  out.u.rowwise() -= out.u.colwise().mean().eval();
  return out;
}

/// The slopes of the least-squares plane, shape (inputs, outputs).
MatrixXd slopes(const Cell& cell) {
  MatrixXd A(cell.u.rows(), cell.u.cols() + 1);
  A << VectorXd::Ones(cell.u.rows()), cell.u;
  return PivotedQr(A).solve(cell.y).bottomRows(cell.u.cols());
}

/// The eigenvector with the largest eigenvalue of a symmetric matrix.
VectorXd leading(const MatrixXd& S) { return symmetric_eigen(S).vectors.rightCols<1>(); }

/// The direction of the strongest curvature; empty if there are too few rows.
VectorXd curved_most(const Cell& cell) {
  const Eigen::Index p = cell.u.cols(), terms = p * (p + 1) / 2;
  if (cell.u.rows() < 2 * (1 + p + terms)) return {};
  MatrixXd A(cell.u.rows(), 1 + p + terms);
  A.leftCols(p + 1) << VectorXd::Ones(cell.u.rows()), cell.u;
  for (Eigen::Index i = 0, next = p + 1; i < p; ++i)
    for (Eigen::Index k = i; k < p; ++k) A.col(next++) = cell.u.col(i).cwiseProduct(cell.u.col(k));
  const MatrixXd w = PivotedQr(A).solve(cell.y);
  MatrixXd S = MatrixXd::Zero(p, p);
  for (Eigen::Index output = 0; output < cell.y.cols(); ++output) {
    MatrixXd H(p, p);
    for (Eigen::Index i = 0, next = p + 1; i < p; ++i)
      for (Eigen::Index k = i; k < p; ++k)
        H(i, k) = H(k, i) = w(next++, output) * (i == k ? 2.0 : 1.0);
    S += H * H;
  }
  return leading(S);
}

/// The direction scaled to sum |.| = 1 with a positive largest component and negligible components
/// set to 0. Empty if d is zero.
std::vector<double> as_direction(VectorXd d) {
  const double largest = d.size() > 0 ? d.cwiseAbs().maxCoeff() : 0.0;
  if (!(largest > 0.0)) return {};
  d = (d.array().abs() < kNegligible * largest).select(0.0, d);
  Eigen::Index at = 0;
  d.cwiseAbs().maxCoeff(&at);
  d /= d.cwiseAbs().sum() * (d(at) < 0.0 ? -1.0 : 1.0);
  return {d.data(), d.data() + d.size()};
}

class Fold {
 public:
  Fold(const TrainingRows& rows, std::span<const int> which, int min_samples)
      : rows_(rows), which_(which), min_samples_(min_samples) {}

  SplitCandidate along(const std::vector<double>& direction) const {
    SplitCandidate probe;
    probe.direction = direction;
    std::vector<std::pair<double, int>> sorted;
    for (int row : which_) sorted.emplace_back(probe.value(rows_, row), row);
    std::sort(sorted.begin(), sorted.end());
    std::vector<double> value;
    std::vector<int> order;
    for (const auto& [x, row] : sorted) value.push_back(x), order.push_back(row);
    SplitCandidate out = best_split_along(rows_, order, value, min_samples_);
    out.direction = direction;
    return out;
  }

  /// The normal of the line where the planes of the two sides meet.
  std::vector<double> normal(const SplitCandidate& split) const {
    std::vector<int> low, high;
    for (int row : which_) (split.value(rows_, row) <= split.threshold ? low : high).push_back(row);
    const MatrixXd D = slopes(cell_of(rows_, low)) - slopes(cell_of(rows_, high));
    return as_direction(leading(D * D.transpose()));
  }

 private:
  const TrainingRows& rows_;
  std::span<const int> which_;
  int min_samples_;
};

}  // namespace

SplitCandidate oblique_split(const TrainingRows& rows, std::span<const int> which,
                             const SplitCandidate& along_axis, int min_samples) {
  if (!along_axis.found() || rows.inputs < 2) return along_axis;
  const Fold fold(rows, which, min_samples);
  SplitCandidate best = along_axis;
  best.rss *= kWorthIt;
  const auto follow = [&](std::vector<double> direction) {
    for (int i = 0; i < kFollowed && !direction.empty(); ++i) {
      SplitCandidate found = fold.along(direction);
      if (!(found.rss < along_axis.rss * 2.0)) return;
      direction = fold.normal(found);
      if (found.rss < best.rss) best = std::move(found);
    }
  };
  follow(fold.normal(along_axis));
  follow(as_direction(curved_most(cell_of(rows, which))));
  return best.direction.empty() ? along_axis : best;
}

}  // namespace plumb::offline

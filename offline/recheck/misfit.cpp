// SPDX-License-Identifier: Apache-2.0
#include "recheck/misfit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "numbers/cholesky.hpp"
#include "recheck/constants.hpp"
#include "recheck/elsewhere.hpp"

namespace plumb::offline::recheck {
namespace {

/// The fitted rows; if there are very many, only those nearest to each of the new ones.
std::vector<int> nearest(const Measurements& own, const std::vector<int>& known,
                         const Measurements& rows) {
  if (known.size() <= kMostNear) return known;
  const std::size_t each =
      std::max<std::size_t>(1, kMostNear / static_cast<std::size_t>(rows.size()));
  std::vector<int> out;
  std::vector<std::pair<double, int>> by_distance(known.size());
  for (int i = 0; i < rows.size(); ++i) {
    for (std::size_t k = 0; k < known.size(); ++k)
      by_distance[k] = {pose_distance(rows, i, own, known[k]), known[k]};
    std::partial_sort(by_distance.begin(), by_distance.begin() + static_cast<std::ptrdiff_t>(each),
                      by_distance.end());
    for (std::size_t k = 0; k < each; ++k) out.push_back(by_distance[k].second);
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

Eigen::MatrixXd distances(const Measurements& a, const std::vector<int>& rows_a,
                          const Measurements& b, const std::vector<int>& rows_b) {
  Eigen::MatrixXd out(static_cast<Eigen::Index>(rows_a.size()),
                      static_cast<Eigen::Index>(rows_b.size()));
  for (Eigen::Index i = 0; i < out.rows(); ++i)
    for (Eigen::Index j = 0; j < out.cols(); ++j)
      out(i, j) = pose_distance(a, rows_a[static_cast<std::size_t>(i)], b,
                                rows_b[static_cast<std::size_t>(j)]);
  return out;
}

Eigen::MatrixXd correlation(const Eigen::MatrixXd& distance, double length) {
  return (-distance / length).array().exp().matrix();
}

/// The likelihood of the residuals, without the terms that all correlation lengths share.
double ln_likelihood(const Cholesky& llt, const Eigen::MatrixXd& error, double lacks, int axes) {
  const Eigen::MatrixXd white = llt.whitened(error);
  return -0.5 * axes * llt.ln_det() - 0.5 * white.squaredNorm() / lacks;
}

}  // namespace

Misfit expected_misfit(const Measurements& own, const std::vector<int>& known, const Rows3& error_B,
                       const Measurements& rows, const MisfitSize& size) {
  Misfit out;
  out.near = nearest(own, known, rows);
  std::vector<int> all(static_cast<std::size_t>(rows.size()));
  std::iota(all.begin(), all.end(), 0);
  const Eigen::MatrixXd among = distances(own, out.near, own, out.near);
  const Eigen::MatrixXd across = distances(rows, all, own, out.near);
  const Eigen::MatrixXd error = error_B(out.near, Eigen::all);
  const double lacks = size.lacks_m * size.lacks_m;
  const double noise = size.noise_m * size.noise_m / lacks;
  double best = -std::numeric_limits<double>::infinity(), length = kLengths[0];
  Cholesky chosen;
  for (const double one : kLengths) {
    Eigen::MatrixXd K = correlation(among, one);
    K.diagonal().array() += noise;
    Cholesky llt(K);
    const double ln = ln_likelihood(llt, error, lacks, size.axes);
    if (ln <= best) continue;
    best = ln;
    length = one;
    chosen = std::move(llt);
  }
  const Eigen::MatrixXd K = correlation(across, length);
  out.weights = chosen.solve(K.transpose()).transpose();
  out.covariance =
      lacks * (correlation(distances(rows, all, rows, all), length) - out.weights * K.transpose());
  return out;
}

}  // namespace plumb::offline::recheck

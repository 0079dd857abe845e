// SPDX-License-Identifier: Apache-2.0
#include "fit/outliers.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace plumb::offline {
namespace {

constexpr double kFar = 6.0;            // times the usual scatter: no reading of this tracker
constexpr double kFarthestFirst = 0.3;  // of the farthest: the rest may only look far because of it
constexpr double kMostShare = 0.1;      // of the poses
constexpr double kMedianChi[] = {0.0,    0.6745, 1.1774, 1.5382,
                                 1.8321, 2.086,  2.3127};  // of the length of k unit normals

/// J L^-T, L L^T = J^T J of scaled columns: its rows are those of an orthonormal basis of J.
Eigen::MatrixXd orthonormal_rows(const Eigen::MatrixXd& J) {
  const Eigen::VectorXd scale = J.colwise().norm().cwiseMax(1e-300).cwiseInverse();
  const Eigen::MatrixXd scaled = J * scale.asDiagonal();
  const Eigen::LLT<Eigen::MatrixXd> llt(scaled.transpose() * scaled);
  return llt.matrixU().solve<Eigen::OnTheRight>(scaled);
}

int most_outliers(std::size_t poses) {
  return static_cast<int>(kMostShare * static_cast<double>(poses));
}

struct Far {
  std::vector<int> rows, rest;
};

Far far_from_the_rest(const FitData& data, const Eigen::VectorXd& distance) {
  const double limit = std::max(kFar * usual_scatter(distance, data.per_pose()),
                                kFarthestFirst * distance.maxCoeff());
  Far out;
  for (std::size_t i = 0; i < data.rows.size(); ++i)
    (distance(i) > limit ? out.rows : out.rest).push_back(data.rows[i]);
  return out;
}

/// Whitened distance of every row of `data` from the prediction.
Eigen::VectorXd plain_distances(const FitData& data, const Solution& at) {
  const Eigen::Index k = data.per_pose();
  Eigen::VectorXd out(static_cast<Eigen::Index>(data.rows.size()));
  for (Eigen::Index i = 0; i < out.size(); ++i) out(i) = at.residual.segment(k * i, k).norm();
  return out;
}

/// Those of `taken` that the fit without them agrees with after all.
std::vector<int> agreeing(const FitData& data, const std::vector<int>& taken, const Solution& fit,
                          double scatter) {
  FitData others = data;
  others.rows = taken;
  const Eigen::VectorXd distance = plain_distances(others, evaluate(others, fit.state, {}));
  std::vector<int> out;
  for (std::size_t i = 0; i < taken.size(); ++i)
    if (distance(i) <= kFar * scatter) out.push_back(taken[i]);
  return out;
}

std::vector<Outlier> described(const FitData& data, const std::vector<int>& taken,
                               const Solution& fit, double scatter) {
  FitData others = data;
  others.rows = taken;
  const Eigen::VectorXd distance = plain_distances(others, evaluate(others, fit.state, {}));
  const Measurements some = pick(*data.measured, taken);
  const Rows3 error = residuals(some, predict_points(fit.state, some));
  std::vector<Outlier> out;
  for (std::size_t i = 0; i < taken.size(); ++i)
    out.push_back({taken[i], error.row(i).norm(), distance(i) / scatter});
  std::sort(out.begin(), out.end(),
            [](const Outlier& a, const Outlier& b) { return a.times > b.times; });
  return out;
}

}  // namespace

std::vector<int> without_outliers(std::vector<int> rows, const std::vector<Outlier>& outliers) {
  for (const auto& outlier : outliers) std::erase(rows, outlier.row);
  return rows;
}

Eigen::VectorXd deletion_distances(const FitData& data, const Solution& solution) {
  const Eigen::Index k = data.per_pose();
  Eigen::VectorXd out = plain_distances(data, solution);
  if (solution.jacobian.cols() == 0) return out;
  const Eigen::MatrixXd Q = orthonormal_rows(solution.jacobian);
  for (Eigen::Index i = 0; i < out.size(); ++i) {
    const auto rows = Q.middleRows(k * i, k);
    const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(k, k) - rows * rows.transpose();
    const Eigen::VectorXd e = solution.residual.segment(k * i, k);
    // A pose that alone decides a parameter agrees with it always: nothing can be said of it.
    const Eigen::LDLT<Eigen::MatrixXd> ldlt(left);
    if (ldlt.vectorD().minCoeff() > 1e-6) out(i) = std::sqrt(std::max(0.0, e.dot(ldlt.solve(e))));
  }
  return out;
}

double usual_scatter(const Eigen::VectorXd& distances, int per_pose) {
  if (distances.size() == 0) return 1.0;
  std::vector<double> sorted(distances.data(), distances.data() + distances.size());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return std::max(1.0, *middle / kMedianChi[per_pose]);
}

std::vector<Outlier> solve_without_outliers(FitData& data, const std::vector<Parameter>& parameters,
                                            Solution& solution) {
  const std::vector<int> all = data.rows;
  const ArmState start = solution.state;
  solution = solve(data, start, parameters);
  std::vector<int> taken;
  bool came_back = false;
  double scatter = 1.0;
  for (;;) {
    const Eigen::VectorXd distance = deletion_distances(data, solution);
    scatter = usual_scatter(distance, data.per_pose());
    const Far far = far_from_the_rest(data, distance);
    if (!far.rows.empty()) {
      taken.insert(taken.end(), far.rows.begin(), far.rows.end());
      data.rows = far.rest;
      if (static_cast<int>(taken.size()) > most_outliers(all.size())) {
        data.rows = all;
        solution = solve(data, start, parameters);
        return {};
      }
    } else {
      const auto back = came_back ? std::vector<int>{} : agreeing(data, taken, solution, scatter);
      if (back.empty()) break;
      came_back = true;
      std::erase_if(
          taken, [&](int row) { return std::find(back.begin(), back.end(), row) != back.end(); });
      data.rows.insert(data.rows.end(), back.begin(), back.end());
      std::sort(data.rows.begin(), data.rows.end());
    }
    // What the outliers pulled aside may be far along a flat valley: begin again.
    solution = solve(data, start, parameters);
  }
  return described(data, taken, solution, scatter);
}

}  // namespace plumb::offline

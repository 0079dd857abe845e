// SPDX-License-Identifier: Apache-2.0
#include "recheck/readings.hpp"

#include <algorithm>
#include <cmath>

#include "fit/outliers.hpp"
#include "fit/series_solver.hpp"
#include "fit/weights.hpp"
#include "plumb/runtime/transform.hpp"

namespace plumb::offline::recheck {
namespace {

constexpr double kSamePose = 2e-3;  // [rad] or [m]

/// Rows of the cell's own measurements that the run was fitted to.
std::vector<int> fitted_rows(const Run& run, const Measurements& own) {
  std::vector<int> out;
  for (int i = 0; i < own.size(); ++i)
    if (run.fit.split.used[i] && !run.fit.split.held[i]) out.push_back(i);
  return without_outliers(std::move(out), run.fit.calibration.outliers);
}

/// 1 sigma of a coordinate of what the run leaves of its own readings.
double scatter_of(const Run& run, const Measurements& own, const Rows3& error,
                  const std::vector<int>& rows) {
  const int axes = static_cast<int>(std::count(own.has_axis.begin(), own.has_axis.end(), true));
  // A tree, or a series of waves, fits its own readings better than others.
  if ((run.fit.tree || has_series(run.fit.calibration.state)) && run.fit.held.n > 0)
    return run.fit.held.rms / std::sqrt(static_cast<double>(axes));
  double squares = 0.0;
  for (const int i : rows) squares += error.row(i).squaredNorm();
  const double used = static_cast<double>(rows.size()) * axes;
  const double numbers =
      static_cast<double>(run.fit.calibration.estimates.size()) + run.fit.calibration.series_dof;
  return std::sqrt(squares / std::max(1.0, used - numbers));
}

Eigen::VectorXd lines_of(const Rows3& values, const Measurements& rows, int axes) {
  Eigen::VectorXd out(values.rows() * axes);
  Eigen::Index line = 0;
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    for (int k = 0; k < 3; ++k)
      if (rows.has_axis[static_cast<std::size_t>(k)]) out(line++) = values(i, k);
  return out;
}

/// Numbers the poses of the readings; readings of one pose get one number.
std::vector<int> pose_numbers(const Measurements& rows, int& count) {
  std::vector<int> out, first;
  for (int i = 0; i < rows.size(); ++i) {
    const auto at = std::find_if(first.begin(), first.end(),
                                 [&](int other) { return same_pose(rows, i, rows, other); });
    out.push_back(static_cast<int>(at - first.begin()));
    if (at == first.end()) first.push_back(i);
  }
  count = static_cast<int>(first.size());
  return out;
}

/// Noise of each line, and `shared` [m^2] of what the model lacks at each pose.
Eigen::MatrixXd covariance_of(const Readings& r, const Rows3& noise_m, const std::vector<int>& pose,
                              const Eigen::VectorXd& shared) {
  const Eigen::VectorXd noise = lines_of(noise_m, r.rows, r.axes);
  Eigen::MatrixXd out = noise.array().square().matrix().asDiagonal();
  for (int a = 0; a < r.rows.size(); ++a)
    for (int b = 0; b < r.rows.size(); ++b)
      if (pose[static_cast<std::size_t>(a)] == pose[static_cast<std::size_t>(b)])
        out.block(a * r.axes, b * r.axes, r.axes, r.axes).diagonal().array() +=
            shared(pose[static_cast<std::size_t>(a)]);
  return out;
}

}  // namespace

double Readings::sigma_m() const { return std::hypot(noise_m, lacks_m); }

bool same_pose(const Measurements& a, int row_a, const Measurements& b, int row_b) {
  return (a.q.row(row_a) - b.q.row(row_b)).cwiseAbs().maxCoeff() < kSamePose;
}

Readings expect_readings(const Cell& cell, const Run& calibrated, const Measurements& own,
                         const ArmState& state, Measurements rows) {
  Readings out;
  out.axes = static_cast<int>(std::count(rows.has_axis.begin(), rows.has_axis.end(), true));
  const ArmState& fitted = calibrated.fit.calibration.state;
  const Rows3 error_M = residuals(own, predict_points(fitted, own));
  const auto known = fitted_rows(calibrated, own);
  const double scatter = scatter_of(calibrated, own, error_M, known);
  const bool floor_known = calibrated.fit.floor.source != NoiseFloor::Source::kNone;
  out.noise_m = floor_known ? std::min(calibrated.fit.floor.sigma_m, scatter) : scatter;
  out.noise_m = std::max(out.noise_m, 1e-7);
  out.lacks_m = std::sqrt(std::max(0.0, scatter * scatter - out.noise_m * out.noise_m));
  out.rows = std::move(rows);
  const std::vector<int> pose = pose_numbers(out.rows, out.poses);

  Rows3 noise_m = Rows3::Constant(out.rows.size(), 3, out.noise_m);
  if (out.rows.sigma_m.rows() > 0) noise_m = stated_sigma(cell, out.rows);
  const double lacks = out.lacks_m * out.lacks_m, noise = out.noise_m * out.noise_m;
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(out.lines());
  const Eigen::VectorXd anew = Eigen::VectorXd::Constant(out.poses, lacks);
  out.expected.push_back({zero, covariance_of(out, noise_m, pose, anew)});

  // Where a pose was measured before, what the model lacks there has been seen.
  const bool whole = out.axes == 3 && own.has_axis == out.rows.has_axis;
  if (!whole || lacks <= 0.0) return out;
  const Rows3 error_B = to_base(fitted, own, error_M);
  const Matrix3 R_MB = from_pose(state.X_MB).R;
  Rows3 mean = Rows3::Zero(out.rows.size(), 3);
  Eigen::VectorXd left = anew;
  bool repeats = false;
  for (int i = 0; i < out.rows.size(); ++i) {
    int times = 0;
    Vector3 sum = Vector3::Zero();
    for (const int other : known)
      if (same_pose(out.rows, i, own, other)) {
        sum += error_B.row(other).transpose();
        ++times;
      }
    if (times == 0) continue;
    repeats = true;
    const double variance = 1.0 / (1.0 / lacks + times / noise);
    left(pose[static_cast<std::size_t>(i)]) = variance;
    mean.row(i) = (R_MB * (variance / noise * sum)).transpose();
  }
  if (repeats)
    out.expected.push_back(
        {lines_of(mean, out.rows, out.axes), covariance_of(out, noise_m, pose, left)});
  return out;
}

}  // namespace plumb::offline::recheck

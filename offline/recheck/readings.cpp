// SPDX-License-Identifier: Apache-2.0
#include "recheck/readings.hpp"

#include <algorithm>
#include <cmath>

#include "arm/predicted_points.hpp"
#include "fit/verdict.hpp"
#include "noise/weights.hpp"
#include "recheck/constants.hpp"
#include "recheck/elsewhere.hpp"
#include "recheck/misfit.hpp"
#include "solve/outlier.hpp"
#include "solve/series_solver.hpp"

namespace plumb::offline::recheck {
namespace {

/// Standard deviation of a coordinate of the run's residuals on its own readings.
double scatter_of(const Run& run, const Measurements& own, const Rows3& error,
                  const std::vector<int>& rows) {
  const int axes = axes_of(own);
  // A tree or a series of waves fits its own readings better than others: their scatter is that of
  // the poses held out.
  if ((run.fit.tree || has_series(run.fit.calibration.state)) && run.fit.held.n > 0)
    return usual_held(run.fit).rms / std::sqrt(static_cast<double>(axes));
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

/// Whether two readings are of one pose: encoders differ by a little when it is driven to again.
bool same_pose(const Measurements& rows, int a, int b) {
  return (rows.q.row(a) - rows.q.row(b)).cwiseAbs().maxCoeff() < kSamePose;
}

/// Numbers the poses of the readings; readings of one pose get one number.
std::vector<int> pose_numbers(const Measurements& rows, int& count) {
  std::vector<int> out, first;
  for (int i = 0; i < rows.size(); ++i) {
    const auto at = std::find_if(first.begin(), first.end(),
                                 [&](int other) { return same_pose(rows, i, other); });
    out.push_back(static_cast<int>(at - first.begin()));
    if (at == first.end()) first.push_back(i);
  }
  count = static_cast<int>(first.size());
  return out;
}

/// Noise of each line, and what the model lacks, of one axis, shape (readings, readings) [m^2].
Eigen::MatrixXd covariance_of(const Readings& r, const Rows3& noise_m,
                              const Eigen::MatrixXd& lacks) {
  const Eigen::VectorXd noise = lines_of(noise_m, r.rows, r.axes);
  Eigen::MatrixXd out = noise.array().square().matrix().asDiagonal();
  for (int a = 0; a < r.rows.size(); ++a)
    for (int b = 0; b < r.rows.size(); ++b)
      out.block(a * r.axes, b * r.axes, r.axes, r.axes).diagonal().array() += lacks(a, b);
  return out;
}

/// Covariance of an error that is equal in all readings of one pose and independent between poses.
/// variance: of each reading [m^2].
Eigen::MatrixXd anew_at_each_pose(const std::vector<int>& pose, const Eigen::VectorXd& variance) {
  const auto n = static_cast<Eigen::Index>(pose.size());
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index a = 0; a < n; ++a)
    for (Eigen::Index b = 0; b < n; ++b)
      if (pose[static_cast<std::size_t>(a)] == pose[static_cast<std::size_t>(b)])
        out(a, b) = std::sqrt(variance(a) * variance(b));
  return out;
}

/// Residuals of the calibration on its own readings.
struct OldErrors {
  Rows3 error_M;          // of all rows [m]
  std::vector<int> rows;  // that were fitted or held out, without outliers
  double noise_m = 0.0, lacks_m = 0.0;
};

OldErrors old_errors(const Run& calibrated, const Measurements& own) {
  OldErrors out;
  out.error_M = residuals(own, predict_points(calibrated.fit.calibration.state, own));
  const double scatter = scatter_of(calibrated, own, out.error_M, fitted_rows(calibrated, own));
  for (int i = 0; i < own.size(); ++i)
    if (calibrated.fit.split.used[i]) out.rows.push_back(i);
  out.rows =
      without_outliers(without_outliers(std::move(out.rows), calibrated.fit.calibration.outliers),
                       calibrated.fit.held_outliers);
  const NoiseFloor& floor = calibrated.fit.floor;
  // Scatter of the joints that a diagnosis sees is expected of new readings as well.
  out.noise_m = floor.source != NoiseFloor::Source::kNone
                    ? std::min(floor.sigma_m * floor.inferred_times(), scatter)
                    : scatter;
  out.noise_m = std::max(out.noise_m, kSmallestSigma_m);
  out.lacks_m = std::sqrt(std::max(0.0, scatter * scatter - out.noise_m * out.noise_m));
  return out;
}

}  // namespace

double expected_sigma(const Run& calibrated, const Measurements& own) {
  const OldErrors old = old_errors(calibrated, own);
  return std::hypot(old.noise_m, old.lacks_m);
}

std::vector<int> fitted_rows(const Run& run, const Measurements& own) {
  std::vector<int> out;
  for (int i = 0; i < own.size(); ++i)
    if (run.fit.split.used[i] && !run.fit.split.held[i]) out.push_back(i);
  return without_outliers(std::move(out), run.fit.calibration.outliers);
}

double Readings::sigma_m() const { return std::hypot(noise_m, lacks_m); }

int axes_of(const Measurements& rows) {
  return static_cast<int>(std::count(rows.has_axis.begin(), rows.has_axis.end(), true));
}

Readings expect_readings(const Cell& cell, const Run& calibrated, const Measurements& own,
                         Measurements rows) {
  Readings out;
  out.axes = axes_of(rows);
  const OldErrors old = old_errors(calibrated, own);
  out.noise_m = old.noise_m;
  out.lacks_m = old.lacks_m;
  out.rows = std::move(rows);
  const std::vector<int> pose = pose_numbers(out.rows, out.poses);
  Eigen::VectorXd untried = Eigen::VectorXd::Zero(out.rows.size());
  const std::vector<bool> is_elsewhere = elsewhere(own, old.rows, out.rows);
  std::copy(is_elsewhere.begin(), is_elsewhere.end(), untried.begin());
  out.elsewhere = static_cast<int>(untried.sum());

  Rows3 noise_m = Rows3::Constant(out.rows.size(), 3, out.noise_m);
  if (out.rows.sigma_m.rows() > 0) noise_m = stated_sigma(cell, out.rows);
  const Rows3 nothing = Rows3::Zero(out.rows.size(), 3);
  const Eigen::VectorXd usual =
      Eigen::VectorXd::Constant(out.rows.size(), std::pow(out.lacks_m, 2));
  const Eigen::MatrixXd anew = anew_at_each_pose(pose, usual);
  out.expected.push_back({nothing, covariance_of(out, noise_m, anew)});
  if (out.elsewhere > 0)
    for (const double times : kLacksElsewhere) {
      const Eigen::VectorXd more = untried * std::pow(times * out.sigma_m(), 2);
      out.expected.push_back(
          {.mean_B = nothing,
           .covariance = covariance_of(out, noise_m, anew + anew_at_each_pose(pose, more)),
           .lacks_elsewhere = true});
    }
  const bool same_axes = own.has_axis == out.rows.has_axis;
  if (!same_axes || out.lacks_m <= kSmallShare * out.noise_m || old.rows.empty()) return out;
  const Rows3 error_B = to_base(calibrated.fit.calibration.state, own, old.error_M);
  const Misfit misfit =
      expected_misfit(own, old.rows, error_B, out.rows,
                      {.lacks_m = out.lacks_m, .noise_m = out.noise_m, .axes = out.axes});
  Measurements near = pick(own, misfit.near);
  near.setup.clear();
  out.expected.push_back({misfit.weights * error_B(misfit.near, Eigen::all),
                          covariance_of(out, noise_m, misfit.covariance), std::move(near),
                          misfit.weights});
  return out;
}

}  // namespace plumb::offline::recheck

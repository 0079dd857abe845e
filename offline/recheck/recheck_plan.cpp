// SPDX-License-Identifier: Apache-2.0
#include "recheck/recheck_plan.hpp"

#include <algorithm>
#include <cmath>

#include "numbers/cholesky.hpp"
#include "numbers/lu.hpp"
#include "recheck/constants.hpp"
#include "recheck/known_series.hpp"
#include "recheck/refit.hpp"
#include "solve/outlier.hpp"
#include "solve/thinned_rows.hpp"

namespace plumb::offline::recheck {
namespace {

/// One row for every pose that the calibration was fitted to or tested with; a sample if there are
/// very many.
std::vector<int> different_poses(const Run& calibrated, const Measurements& own) {
  std::vector<int> out;
  std::vector<bool> seen(static_cast<std::size_t>(own.size()), false);
  for (int i = 0; i < own.size(); ++i) {
    const auto group = static_cast<std::size_t>(own.replicate_group[i]);
    if (!calibrated.fit.split.used[i] || seen[group]) continue;
    seen[group] = true;
    out.push_back(i);
  }
  out = without_outliers(std::move(out), calibrated.fit.calibration.outliers);
  return thinned(own, out, kMostPoses);
}

/// Derivatives of each row by the numbers of all changes, in units of typical size and noise.
Eigen::MatrixXd all_columns(const std::vector<Change>& changes, const Measurements& rows,
                            const ArmState& state, double sigma_m) {
  std::vector<Parameter> parameters;
  std::vector<double> typical;
  for (const auto& change : changes)
    for (std::size_t k = 0; k < change.parameters.size(); ++k) {
      parameters.push_back(change.parameters[k]);
      typical.push_back(change.typical(static_cast<Eigen::Index>(k)) / sigma_m);
    }
  return derivatives(rows, state, parameters) *
         Eigen::Map<Eigen::VectorXd>(typical.data(), static_cast<Eigen::Index>(typical.size()))
             .asDiagonal();
}

/// Greedy choice: the rows that add most to ln det(information), one after the other.
std::vector<int> best_rows(const Eigen::MatrixXd& columns, int axes, int n) {
  const int rows = static_cast<int>(columns.rows()) / axes;
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(columns.cols(), columns.cols());
  std::vector<bool> taken(static_cast<std::size_t>(rows), false);
  std::vector<int> out;
  while (static_cast<int>(out.size()) < std::min(n, rows)) {
    int best = -1;
    double most = 0.0;
    for (int i = 0; i < rows; ++i) {
      if (taken[static_cast<std::size_t>(i)]) continue;
      const auto B = columns.middleRows(i * axes, axes);
      const double gain =
          determinant(Eigen::MatrixXd::Identity(axes, axes) + B * covariance * B.transpose());
      if (best < 0 || gain > most) best = i, most = gain;
    }
    const Eigen::MatrixXd B = columns.middleRows(best * axes, axes);
    const Eigen::MatrixXd CB = covariance * B.transpose();
    covariance -=
        CB * SymmetricSolver(Eigen::MatrixXd::Identity(axes, axes) + B * CB).solve(CB.transpose());
    taken[static_cast<std::size_t>(best)] = true;
    out.push_back(best);
  }
  return out;
}

}  // namespace

RecheckPlan plan_recheck(const Cell& cell, const Run& calibrated, const Run& run,
                         const Measurements& own, int n) {
  LastSetup setup = last_setup(run);
  const std::vector<int> known = different_poses(calibrated, own);
  Measurements poses = pick(own, known);
  poses.setup.clear();
  const ArmState extended = with_room_for_changes(cell, own, poses, setup.state);
  const auto changes = possible_changes(cell, extended, poses, n);
  RecheckPlan out;
  std::vector<int> chosen = best_rows(
      all_columns(changes, poses, extended, expected_sigma(calibrated, own)), axes_of(own), n);
  std::sort(chosen.begin(), chosen.end());
  for (const int i : chosen) out.rows.push_back(known[static_cast<std::size_t>(i)]);
  const Measurements few = pick(poses, chosen);
  const Readings readings = expect_readings(cell, calibrated, own, few);
  setup.known =
      with_series(std::move(setup.known), setup.state, calibrated, own, readings.sigma_m());
  const Judge judge(readings, extended, setup.known);
  out.visible = visibility(changes, few, poses, extended, judge.judge({}).S);
  return out;
}

}  // namespace plumb::offline::recheck

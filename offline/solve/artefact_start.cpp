// SPDX-License-Identifier: Apache-2.0
#include "solve/artefact_start.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "arm/predicted_points.hpp"

namespace plumb::offline {
namespace {

/// Predicted targets in the base frame.
Rows3 targets_B(const Measurements& measured, ArmState state, int setup) {
  state.frame(setup) = format::Pose{};
  return predict_targets(state, measured);
}

/// A frame whose z is `normal` and whose origin is `origin`, both in the base.
format::Pose frame_at(const Vector3& normal, const Vector3& origin) {
  const Matrix3 R = Eigen::Quaterniond::FromTwoVectors(normal, Vector3::UnitZ()).toRotationMatrix();
  return to_pose({R, -(R * origin)});
}

/// A plane across each axis of the points; heights say on which side of it the target is.
std::vector<ArmState> planes(const Measurements& measured, const Rows3& points,
                             const ArmState& state, int setup) {
  const Eigen::RowVector3d mean = points.colwise().mean();
  const Rows3 centred = points.rowwise() - mean;
  const Eigen::VectorXd height = measured.p_M.col(2);
  const double mean_height = height.mean();
  const Matrix3 scatter = centred.transpose() * centred;
  const Matrix3 axes = Eigen::SelfAdjointEigenSolver<Matrix3>(scatter).eigenvectors();
  std::vector<ArmState> out;
  for (int k = 0; k < 3; ++k)
    for (const double side : {1.0, -1.0}) {
      const Vector3 normal = side * axes.col(k);
      ArmState one = state;
      one.frame(setup) = frame_at(normal, Vector3(mean.transpose()) - normal * mean_height);
      out.push_back(std::move(one));
      if (height.isZero(0.0)) break;  // both sides of a touched plane are alike
    }
  return out;
}

/// The centre c and, where it is unknown, the length l of distances d by
///
///   |p|^2 - d^2 = 2 p c + 2 d l + (l^2 - |c|^2)
///
/// The last bracket is an unknown of its own. Of a sphere nothing was read, and d is what is known
/// of its radius.
ArmState centre(const Measurements& measured, const Rows3& points, const ArmState& state, int setup,
                bool fit_length) {
  const bool read = measured.kind_of(0) == ReadingKind::kDistance && fit_length;
  const Eigen::RowVector3d mean = points.colwise().mean();
  const Rows3 centred = points.rowwise() - mean;
  Eigen::VectorXd d = measured.p_M.col(0);
  d.array() += state.length(setup);
  Eigen::MatrixXd A(points.rows(), read ? 5 : 4);
  A.leftCols(3) = 2.0 * centred;
  A.col(3).setOnes();
  if (read) A.col(4) = 2.0 * d;
  const Eigen::VectorXd b = centred.rowwise().squaredNorm() - d.cwiseAbs2();
  const Eigen::VectorXd x = A.completeOrthogonalDecomposition().solve(b);
  const Vector3 c = x.head<3>();
  ArmState out = state;
  if (fit_length)
    out.length(setup) =
        read ? state.length(setup) + x(4) : std::sqrt(std::max(0.0, x(3) + c.squaredNorm()));
  out.frame(setup) = to_pose({Matrix3::Identity(), -(c + Vector3(mean.transpose()))});
  return out;
}

}  // namespace

std::vector<ArmState> artefact_starts(const Measurements& measured, const ArmState& state,
                                      int setup, bool fit_length) {
  const ReadingKind kind = measured.kind_of(0);
  if (is_of_plane(kind)) return planes(measured, targets_B(measured, state, setup), state, setup);
  if (descriptor_of(kind).radial)
    return {centre(measured, targets_B(measured, state, setup), state, setup, fit_length)};
  return {state};
}

Solution placed_artefact(const FitData& data, const ArmState& state, int setup, bool fit_length,
                         const std::function<Solution(const ArmState& start)>& fit) {
  std::optional<Solution> best;
  const Measurements some = pick(*data.measured, data.rows);
  for (const ArmState& start : artefact_starts(some, state, setup, fit_length)) {
    Solution one = fit(start);
    if (!best || one.cost < best->cost) best = std::move(one);
  }
  return *std::move(best);
}

}  // namespace plumb::offline

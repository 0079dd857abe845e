// SPDX-License-Identifier: Apache-2.0
#include "solve/pose_lines.hpp"

#include "arm/predicted_points.hpp"

namespace plumb::offline {
namespace {

/// Whether the number turns all of the arm behind its first joint.
bool turns_all(const Parameter& p) { return p.of_robot() && !p.of_effect() && p.joint == 0; }

/// Columns of a row that touches a fixed point, whose residual from target to point is `missed_M`.
/// The residual is seen from the first link: what turns all of the arm moves what is in the point
/// rather than the target beside it, which a shift of the point makes good exactly. The gradient is
/// the same, because a turn does not change how long the residual is. (Planes and distances are
/// seen so anyhow: what turns all of the arm is made good exactly by a turn of the plane or a shift
/// of the centre.)
void see_from_first_link(const std::vector<Parameter>& parameters, const Vector3& missed_M,
                         GeometryDerivative::Point& point) {
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    auto column = point.columns.col(static_cast<Eigen::Index>(k));
    if (turns_all(parameters[k]))
      column.head<3>() += cross<double>(Vector3(column.tail<3>()), missed_M);
  }
}

/// Columns of a touch, whose residual is divided by the size of the arm. times, slopes: of
/// TouchDensity.
void grow_with_arm(const Vector3& missed_M, double times, const Eigen::RowVectorXd& slopes,
                   GeometryDerivative::Point& point) {
  point.columns.topRows<3>() += missed_M * (slopes / times);
  point.columns.topRows<3>() /= times;
}

}  // namespace

/// Replaces point and columns by what the row reads of them.
void PoseLines::read_point(ReadingKind kind, const ArmState& state, int setup,
                           GeometryDerivative::Point& point) const {
  if (descriptor_of(kind).radial) {
    const Eigen::RowVector3d along = point.p_M.normalized().transpose();
    point.columns.row(0) = (along * point.columns.topRows<3>()).eval();
    for (Eigen::Index k = 0; k < point.columns.cols(); ++k)  // none without a Jacobian
      if (const Parameter& p = parameters_[static_cast<std::size_t>(k)];
          p.kind == Parameter::Kind::kArtefactLength && p.setup == setup)
        point.columns(0, k) = -1.0;
  }
  point.p_M = read_at(kind, point.p_M, state.length(setup));
}

PoseLines::Undefined PoseLines::evaluate(const GeometryDerivative& geometry, int first, int last,
                                         double* residual, double* jacobian) const {
  const auto count = static_cast<Eigen::Index>(parameters_.size());
  GeometryDerivative::Point point;
  Eigen::Index row = 0;
  const auto emit = [&](double error, double sigma, int column_row) {
    residual[row] = error / sigma;
    if (jacobian != nullptr)
      Eigen::Map<Eigen::RowVectorXd>(jacobian + row * count, count) =
          point.columns.row(column_row) * (-1.0 / sigma);
    ++row;
  };
  const auto& m = *data_.measured;
  const bool departed = m.departure_B.rows() > 0;
  const bool has_effects = !geometry.state().arm.effects.empty();
  const double times = data_.touches.times(geometry.state());
  for (int at = first; at < last; ++at) {
    const int i = data_.rows[static_cast<std::size_t>(at)];
    const int setup = setup_of(m, i);
    geometry.evaluate({m.q.row(i).data(), static_cast<std::size_t>(m.q.cols())},
                      has_effects ? context_of(m, i, geometry.sensors(), geometry.X_MB(setup))
                                  : MeasuredContext{},
                      point, departed ? Vector3(m.departure_B.row(i)) : Vector3::Zero(), setup);
    if (point.undefined >= 0) return {i, point.undefined};
    const Reading reading = data_.reading(i);
    const ReadingKind kind = m.kind_of(i);
    if (m.of_artefact(i)) read_point(kind, geometry.state(), setup, point);
    Vector3 missed = (m.p_M.row(i) - point.p_M.transpose()).transpose();
    if (is_touch(kind)) {
      if (jacobian != nullptr) {
        if (kind == ReadingKind::kPoint) see_from_first_link(parameters_, missed, point);
        grow_with_arm(missed, times, slopes_, point);
      }
      missed /= times;
    }
    Vector3 turn = Vector3::Zero();
    if (reading.turn_lines() > 0) {
      const auto quat = m.quat_M.row(i);
      const Matrix3 R_MG = from_pose({{}, {quat(0), quat(1), quat(2), quat(3)}}).R;
      turn = rotation_vector(R_MG * point.R_MG.transpose());
    }
    reading.components([&](int k) {
      if (k < 3)
        emit(missed(k), data_.sigma_m(i, k), k);
      else
        emit(turn(k - 3), data_.sigma_rad, k);
    });
  }
  return {};
}

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#include "simulate/visible.hpp"

#include <cmath>

#include "numbers/pivoted_qr.hpp"

namespace plumb::offline::sim {
namespace {

constexpr int kMostRows = 4000;
constexpr double kRankTolerance = 1e-9;
constexpr int kTwist = 6;

using Columns = Eigen::Matrix<double, 3, Eigen::Dynamic>;

// Fills six columns with the shift of the tip p by a twist (d, e) in the frame (R, o):
//   R d + (R e) x (p - o), turns e divided by the reach so that all columns have the same unit
void add_slot(const Isometry3d& slot, const Vector3d& tip, double reach, int column, Columns& out) {
  const Vector3d lever = tip - slot.translation();
  for (int k = 0; k < 3; ++k) {
    const Vector3d axis = slot.linear().col(k);
    out.col(column + k) = axis;
    out.col(column + 3 + k) = axis.cross(lever) / reach;
  }
}

Columns twist_columns(const World& world, int row) {
  const int n = world.arm.joints();
  const Frames frames = world.arm.frames(world.joints(world.visits[static_cast<std::size_t>(row)]));
  const Vector3d tip = frames.tool * world.X_TG.translation();
  const double reach = world.arm.reach();
  Columns out(3, kTwist * (n + 2));
  add_slot(Isometry3d::Identity(), tip, reach, 0, out);
  for (int j = 0; j < n; ++j) {
    add_slot(frames.joint[static_cast<std::size_t>(j)], tip, reach, kTwist * (j + 1), out);
  }
  add_slot(frames.tool, tip, reach, kTwist * (n + 1), out);
  return world.X_MB.linear() * out;
}

double per_axis_rms(const Eigen::VectorXd& values) {
  return values.size() == 0 ? 0.0 : values.norm() / std::sqrt(static_cast<double>(values.size()));
}

}  // namespace

Visible::Visible(const World& world, const std::array<bool, 3>& measured_axes) {
  const int rows = static_cast<int>(world.visits.size());
  const int stride = 1 + (rows - 1) / kMostRows;
  for (int row = 0; row < rows; row += stride) picked_.push_back(row);
  for (int k = 0; k < 3; ++k) {
    if (measured_axes[static_cast<std::size_t>(k)]) axes_.push_back(k);
  }
  const auto values = static_cast<Eigen::Index>(picked_.size() * axes_.size());
  Eigen::MatrixXd all(values, kTwist * (world.arm.joints() + 2));
  Eigen::Index line = 0;
  for (const int row : picked_) {
    const Columns columns = twist_columns(world, row);
    for (const int axis : axes_) all.row(line++) = columns.row(axis);
  }
  const PivotedQr qr(all, kRankTolerance);
  basis_ = qr.basis(qr.rank());
}

Eigen::VectorXd Visible::stacked(const Rows3& shift_M) const {
  Eigen::VectorXd out(basis_.rows());
  Eigen::Index line = 0;
  for (const int row : picked_) {
    for (const int axis : axes_) out(line++) = shift_M(row, axis);
  }
  return out;
}

EffectSize Visible::size_of(const Rows3& shift_M) const {
  const Eigen::VectorXd shift = stacked(shift_M);
  const Eigen::VectorXd left = shift - basis_ * (basis_.transpose() * shift);
  return {per_axis_rms(shift), per_axis_rms(left)};
}

}  // namespace plumb::offline::sim

// SPDX-License-Identifier: Apache-2.0
#include "simulate/arm.hpp"

#include <cmath>

namespace plumb::offline::sim {
namespace {

using Eigen::AngleAxisd;
using Eigen::Translation3d;

Isometry3d link(const format::JointRow& row) {
  return Translation3d(row.a, 0.0, 0.0) * AngleAxisd(row.alpha, Vector3d::UnitX()) *
         AngleAxisd(row.beta, Vector3d::UnitY()) * Isometry3d::Identity();
}

Isometry3d moved_by(const format::Twist& twist) {
  return sim::exp(Vector3d(twist.d.data()), Vector3d(twist.e.data()));
}

}  // namespace

Arm::Arm(const format::Chain& chain)
    : chain_(chain),
      base_(to_isometry(chain.base) * moved_by(chain.base_twist)),
      tool_(moved_by(chain.tool_twist) * to_isometry(chain.tool)),
      between_(chain.joints.size() + 1, Isometry3d::Identity()) {
  const bool modified = chain_.convention == format::Convention::kModified;
  for (int i = 0; i < joints(); ++i) {
    const auto& row = chain_.joints[i];
    if (modified) between_[i] = between_[i] * link(row);
    between_[i] = between_[i] * moved_by(row.pre);
    between_[i + 1] = moved_by(row.post);
    if (!modified) between_[i + 1] = between_[i + 1] * link(row);
  }
}

Isometry3d Arm::motion(int i, double q) const {
  const auto& row = chain_.joints[i];
  const double moved = row.scale * q + row.offset;
  const double turn = row.theta + (slides(i) ? 0.0 : moved);
  const double slide = row.d + (slides(i) ? moved : 0.0);
  return Translation3d(0.0, 0.0, slide) * AngleAxisd(turn, Vector3d::UnitZ()) *
         Isometry3d::Identity();
}

Frames Arm::frames(const VectorXd& q, const Deflection& deflection) const {
  Frames out;
  Isometry3d X = deflection.base * base_;
  for (int i = 0; i < joints(); ++i) {
    X = X * between_[i] * motion(i, q(i) + deflection.dq(i));
    out.joint.push_back(X);
    X = X * deflection.link[i];
  }
  out.flange = X * between_[joints()];
  out.tool = out.flange * tool_ * deflection.tool;
  return out;
}

Vector3d Arm::link_vector(int i, const VectorXd& q) const {
  const Isometry3d& behind = between_[i + 1];
  if (i + 1 == joints()) return behind.translation();
  return behind * motion(i + 1, slides(i + 1) ? q(i + 1) : 0.0).translation();
}

double Arm::reach() const {
  double sum = tool_.translation().norm();
  for (int i = 0; i < joints(); ++i) sum += link_vector(i, VectorXd::Zero(joints())).norm();
  return sum;
}

Isometry3d exp(const Vector3d& d, const Vector3d& e) {
  // V = 1 + (1 - cos t)/t^2 [e]x + (t - sin t)/t^3 [e]x^2, series near t = 0.
  const double t = e.norm();
  const double b = t < 1e-4 ? 0.5 - t * t / 24.0 : (1.0 - std::cos(t)) / (t * t);
  const double c = t < 1e-4 ? 1.0 / 6.0 - t * t / 120.0 : (t - std::sin(t)) / (t * t * t);
  Isometry3d X = Isometry3d::Identity();
  X.translation() = d + b * e.cross(d) + c * e.cross(e.cross(d));
  if (t > 0.0) X.linear() = AngleAxisd(t, e / t).toRotationMatrix();
  return X;
}

Isometry3d to_isometry(const format::Pose& pose) {
  const Eigen::Quaterniond turn(pose.q[0], pose.q[1], pose.q[2], pose.q[3]);
  return Translation3d(Vector3d(pose.p.data())) * turn.normalized() * Isometry3d::Identity();
}

format::Pose to_pose(const Isometry3d& X) {
  Eigen::Quaterniond turn(X.linear());
  if (turn.w() < 0.0) turn.coeffs() = -turn.coeffs();
  const Vector3d& p = X.translation();
  return {{p.x(), p.y(), p.z()}, {turn.w(), turn.x(), turn.y(), turn.z()}};
}

}  // namespace plumb::offline::sim

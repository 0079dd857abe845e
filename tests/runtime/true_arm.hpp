// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>

#include "plumb/runtime/transform.hpp"
#include "tests/runtime/kdl_arm.hpp"
#include "tests/runtime/random_arm.hpp"

/// The arm and its controller in the outside world: KDL for the chains, a plain walk for the trees.
namespace plumb::test {

using Joints = std::vector<double>;

inline Transformd transform(const KDL::Frame& X) {
  Transformd out;
  for (int i = 0; i < 3; ++i) {
    out.p(i) = X.p(i);
    for (int j = 0; j < 3; ++j) out.R(i, j) = X.M(i, j);
  }
  return out;
}

/// Sine of the angle times the axis of R; the rotation vector as far as small angles go.
inline Eigen::Vector3d small_rotation(const Eigen::Matrix3d& R) {
  return 0.5 * Eigen::Vector3d(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
}

/// Leaf by leaf as the format's header says; the domain must contain q.
inline double tree_value(const format::Tree& tree, const std::vector<double>& u) {
  int at = tree.nodes.empty() ? -1 : 0;
  while (at >= 0) {
    const auto& node = tree.nodes[static_cast<std::size_t>(at)];
    at = u[node.input] <= node.threshold ? node.low : node.high;
  }
  const std::size_t leaf = static_cast<std::size_t>(~at), width = u.size() + 1;
  double y = tree.coefficients[leaf * width];
  for (std::size_t i = 0; i < u.size(); ++i) y += tree.coefficients[leaf * width + i + 1] * u[i];
  return std::min(std::max(y, tree.bounds[2 * leaf]), tree.bounds[2 * leaf + 1]);
}

/// T(q).
class TrueArm {
 public:
  explicit TrueArm(const format::Model& model) : model_(model), chain_(model.calibrated) {}

  Transformd pose(const Joints& q) const {
    Transformd X = transform(chain_.forward(q));
    const auto& [low, high, fade, context] = model_.domain;
    std::vector<double> u;
    for (std::size_t i = 0; i < low.size(); ++i)
      u.push_back((2 * q[i] - low[i] - high[i]) / (high[i] - low[i]));
    for (int axis = 0; axis < format::kTreeAxes; ++axis)
      if (!model_.trees[axis].bounds.empty()) X.p(axis) += tree_value(model_.trees[axis], u);
    return X;
  }

 private:
  format::Model model_;
  KdlArm chain_;
};

/// N(q) and N^-1: what the robot controller does with a target.
class NominalController {
 public:
  explicit NominalController(const format::Chain& nominal) : chain_(nominal) {}

  Transformd pose(const Joints& q) const { return transform(chain_.forward(q)); }

  /// Singular values and determinant with lengths divided by `length`.
  Eigen::MatrixXd scaled_jacobian(const Joints& q, const format::Chain& nominal,
                                  double length) const {
    Eigen::MatrixXd J = chain_.jacobian(q);
    J.topRows(3) /= length;
    for (std::size_t i = 0; i < q.size(); ++i)
      if (nominal.joints[i].type == format::JointType::kPrismatic) J.col(i) *= length;
    return J;
  }

  /// Joint positions with N(q) = X to rounding, by Newton's method near `q`. A redundant controller
  /// is told its redundancy with the target: the joint that can move most on the spot is held.
  bool invert(const Transformd& X, Joints& q) const {
    const int n = static_cast<int>(q.size());
    int held = -1;
    if (n == 7) {
      const Eigen::MatrixXd still = chain_.jacobian(q).fullPivLu().kernel();
      still.col(0).cwiseAbs().maxCoeff(&held);
    }
    for (int step = 0; step < 30; ++step) {
      const Transformd at = pose(q);
      Eigen::VectorXd r(6);
      r << X.p - at.p, small_rotation(X.R * at.R.transpose());
      if (r.norm() < 2e-14) return true;
      Eigen::MatrixXd J = chain_.jacobian(q);
      if (held >= 0) J.col(held).setZero();
      const Eigen::VectorXd dq = J.completeOrthogonalDecomposition().solve(r);
      for (int i = 0; i < n; ++i) q[static_cast<std::size_t>(i)] += dq(i);
      if (dq.norm() < 1e-14) return true;
    }
    return false;
  }

 private:
  KdlArm chain_;
};

/// A kind of arm and the generic ranks of its Jacobian, known from its drawing.
struct ArmKind {
  const char* name;
  format::Chain nominal;
  int position_rank;
  int pose_rank;
};

inline std::vector<ArmKind> arm_kinds() {
  return {{"UR10-like", ur10(), 3, 6},     {"TX200-like", tx200(), 3, 6},
          {"iiwa-like", iiwa(), 3, 6},     {"SCARA", scara(), 3, 4},
          {"planar 2R", planar(2), 2, 2},  {"planar 3R", planar(3), 2, 3},
          {"five axes", five_axes(), 3, 5}};
}

/// A model of the arm as built: millimetres and milliradians off, one in three with trees.
inline format::Model random_model(RandomArm& random, const format::Chain& nominal) {
  format::Model model;
  model.nominal = nominal;
  model.calibrated = random.as_built(nominal);
  model.guard.corrects = random.coin() ? format::Corrects::kPose : format::Corrects::kPosition;
  if (!random.coin(0.33)) return model;
  for (const auto& joint : nominal.joints) {
    model.domain.q_min.push_back(joint.q_min - 0.5);
    model.domain.q_max.push_back(joint.q_max + 0.5);
  }
  // With fewer than six joints no jump: it could offer the controllable part of a target twice.
  const std::size_t leaves = nominal.joints.size() < 6 ? 1 : 2;
  for (auto& tree : model.trees) {
    if (leaves == 2) {
      tree.depth = 1;
      tree.nodes = {{.threshold = random.uniform(-0.5, 0.5), .low = -1, .high = -2}};
    }
    for (std::size_t i = 0; i < leaves; ++i) tree.bounds.insert(tree.bounds.end(), {-5e-4, 5e-4});
    for (std::size_t i = 0; i < leaves * (nominal.joints.size() + 1); ++i)
      tree.coefficients.push_back(random.uniform(-2e-4, 2e-4));
  }
  return model;
}

/// Six turning joints of any kind.
inline format::Chain random_6r(RandomArm& random) {
  std::vector<format::JointRow> joints;
  for (int i = 0; i < 6; ++i) {
    const double alpha = i % 2 == 0 ? kPi / 2 : random.uniform(-kPi, kPi);
    joints.push_back(row(alpha, random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4),
                         random.uniform(-kPi, kPi)));
  }
  return chain_of(random.coin() ? format::Convention::kStandard : format::Convention::kModified,
                  joints);
}

}  // namespace plumb::test

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>
#include <memory>
#include <span>
#include <stdexcept>

#include "plumb/format/model.hpp"

/// The chain of a model in Orocos KDL: independent evidence, sharing no line with the runtime.
namespace plumb::test {

using Matrix4l = Eigen::Matrix<long double, 4, 4>;

/// e^A by scaling, Taylor series and squaring in long double.
inline Matrix4l matrix_exponential(Matrix4l A) {
  A /= 1024.0L;
  Matrix4l sum = Matrix4l::Identity(), term = sum;
  for (int k = 1; k <= 12; ++k) {
    term = term * A / static_cast<long double>(k);
    sum += term;
  }
  for (int k = 0; k < 10; ++k) sum *= Matrix4l(sum);
  return sum;
}

inline KDL::Frame kdl_exp(const format::Twist& xi) {
  const auto& [x, y, z] = xi.e;
  Matrix4l A;
  A << 0, -z, y, xi.d[0], z, 0, -x, xi.d[1], -y, x, 0, xi.d[2], 0, 0, 0, 0;
  const Eigen::Matrix4d X = matrix_exponential(A).cast<double>();
  return {KDL::Rotation(X(0, 0), X(0, 1), X(0, 2), X(1, 0), X(1, 1), X(1, 2), X(2, 0), X(2, 1),
                        X(2, 2)),
          KDL::Vector(X(0, 3), X(1, 3), X(2, 3))};
}

inline KDL::Frame kdl_pose(const format::Pose& pose) {
  return {KDL::Rotation::Quaternion(pose.q[1], pose.q[2], pose.q[3], pose.q[0]),
          KDL::Vector(pose.p[0], pose.p[1], pose.p[2])};
}

class KdlArm {
 public:
  explicit KdlArm(const format::Chain& chain) {
    fixed(kdl_pose(chain.base));
    fixed(chain.base_twist);
    for (const auto& row : chain.joints) {
      const bool modified = chain.convention == format::Convention::kModified;
      if (modified) {
        fixed(KDL::Frame::DH_Craig1989(row.a, row.alpha, 0.0, 0.0));
        if (row.beta != 0.0) fixed(KDL::Rotation::RotY(row.beta));
      }
      fixed(row.pre);
      // A segment's tip is where it stands at q = 0, so the offset belongs to the tip.
      const bool turns = row.type == format::JointType::kRevolute;
      const auto type = turns ? KDL::Joint::RotZ : KDL::Joint::TransZ;
      const auto tip = KDL::Frame::DH(0.0, 0.0, row.d + (turns ? 0.0 : row.offset),
                                      row.theta + (turns ? row.offset : 0.0));
      chain_.addSegment(KDL::Segment(KDL::Joint(type, row.scale), tip));
      fixed(row.post);
      if (!modified) {
        fixed(KDL::Frame::DH(row.a, row.alpha, 0.0, 0.0));
        if (row.beta != 0.0) fixed(KDL::Rotation::RotY(row.beta));
      }
    }
    fixed(chain.tool_twist);
    fixed(kdl_pose(chain.tool));
    forward_ = std::make_unique<KDL::ChainFkSolverPos_recursive>(chain_);
    jacobian_ = std::make_unique<KDL::ChainJntToJacSolver>(chain_);
  }

  KDL::Frame forward(std::span<const double> q) const {
    KDL::Frame X;
    if (forward_->JntToCart(array(q), X) < 0) throw std::runtime_error("KDL forward");
    return X;
  }

  /// Shape (6, n), translation above rotation, base frame, at the tip.
  Eigen::MatrixXd jacobian(std::span<const double> q) const {
    KDL::Jacobian J(chain_.getNrOfJoints());
    if (jacobian_->JntToJac(array(q), J) < 0) throw std::runtime_error("KDL jacobian");
    return J.data;
  }

 private:
  void fixed(const KDL::Frame& X) {
    chain_.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::Fixed), X));
  }
  void fixed(const KDL::Rotation& R) { fixed(KDL::Frame(R)); }
  void fixed(const format::Twist& xi) {
    if (xi != format::Twist{}) fixed(kdl_exp(xi));
  }

  KDL::JntArray array(std::span<const double> q) const {
    KDL::JntArray out(chain_.getNrOfJoints());
    for (unsigned i = 0; i < out.rows(); ++i) out(i) = q[i];
    return out;
  }

  KDL::Chain chain_;
  std::unique_ptr<KDL::ChainFkSolverPos_recursive> forward_;
  std::unique_ptr<KDL::ChainJntToJacSolver> jacobian_;
};

}  // namespace plumb::test

// SPDX-License-Identifier: Apache-2.0
#include "twin/nominal_arm.hpp"

#include <algorithm>

#include "numbers/cholesky.hpp"
#include "numbers/lu.hpp"
#include "numbers/spectrum.hpp"

namespace plumb::offline::twin {
namespace {

constexpr int kMostSteps = 30;
constexpr double kReached = 1e-9;   // error of the pose, with lengths divided by the reach
constexpr double kDamping = 1e-12;  // added to the squared singular values
constexpr double kFarthest = 0.5;   // [rad] or [m]; a solution farther away is another branch

using Vector6d = Eigen::Matrix<double, 6, 1>;

Vector3d rotation_vector(const Eigen::Matrix3d& R) {
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

}  // namespace

Eigen::MatrixXd NominalArm::jacobian(const VectorXd& q) const {
  const sim::Frames frames = arm_.frames(q);
  const Vector3d tip = frames.tool.translation();
  Eigen::MatrixXd J(6, joints());
  for (int i = 0; i < joints(); ++i) {
    const Isometry3d& X_BP = frames.joint[static_cast<std::size_t>(i)];
    const Vector3d axis = X_BP.linear().col(2);
    const Vector3d arm = tip - X_BP.translation();
    J.col(i).head<3>() = (arm_.slides(i) ? axis : axis.cross(arm)) / reach_m_;
    J.col(i).tail<3>() = arm_.slides(i) ? Vector3d::Zero() : axis;
  }
  return J;
}

bool NominalArm::inverse(const Isometry3d& X_BT, VectorXd& q) const {
  VectorXd now = q;
  for (int step = 0; step < kMostSteps; ++step) {
    const Isometry3d here = forward(now);
    Vector6d miss;
    miss.head<3>() = (X_BT.translation() - here.translation()) / reach_m_;
    miss.tail<3>() = rotation_vector(X_BT.linear() * here.linear().transpose());
    if (!miss.allFinite()) return false;
    if (miss.norm() < kReached) {
      if ((now - q).cwiseAbs().maxCoeff() > kFarthest) return false;
      q = now;
      return true;
    }
    const Eigen::MatrixXd J = jacobian(now);
    Eigen::MatrixXd H = J.transpose() * J;
    H.diagonal().array() += kDamping;
    now += SymmetricSolver(H).solve(J.transpose() * miss);
  }
  return false;
}

double NominalArm::dexterity(const VectorXd& q) const {
  return jacobi_singular_values(jacobian(q))(std::min(6, joints()) - 1);
}

int NominalArm::configuration(const VectorXd& q) const {
  if (joints() != 6) return 0;
  return determinant(jacobian(q)) > 0.0 ? 1 : -1;
}

}  // namespace plumb::offline::twin

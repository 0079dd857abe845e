// SPDX-License-Identifier: Apache-2.0
#include "fit/calibration_covariance.hpp"

#include <algorithm>

#include "numbers/spectrum.hpp"
#include "numbers/triangle.hpp"

namespace plumb::offline {

Eigen::MatrixXd inverse_information(const Eigen::MatrixXd& J) {
  const Eigen::VectorXd scale = per_norm(J);
  const Eigen::MatrixXd R_inverse = upper_solved(householder_triangle(J * scale.asDiagonal()),
                                                 Eigen::MatrixXd::Identity(J.cols(), J.cols()));
  const Eigen::MatrixXd half = scale.asDiagonal() * R_inverse;
  return (half * half.transpose()).selfadjointView<Eigen::Lower>();
}

double calibrability(const Eigen::MatrixXd& information, const std::vector<Parameter>& parameters) {
  std::vector<Eigen::Index> robot;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (parameters[i].of_robot()) robot.push_back(static_cast<Eigen::Index>(i));
  if (robot.empty()) return 0.0;
  const Eigen::MatrixXd part = information(robot, robot);
  const Eigen::VectorXd w = jacobi_singular_values(part);
  return w(w.size() - 1) > 0 ? w(0) / w(w.size() - 1) : 0.0;
}

Eigen::MatrixXd covariance_with(const KnownArm& arm, const Eigen::MatrixXd& J,
                                const std::vector<Parameter>& parameters) {
  std::vector<Eigen::Index> known, in_arm, others;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto at = std::find(arm.names.begin(), arm.names.end(), parameters[i].name);
    const auto place = static_cast<Eigen::Index>(i);
    if (at == arm.names.end()) {
      others.push_back(place);
    } else {
      known.push_back(place);
      in_arm.push_back(at - arm.names.begin());
    }
  }
  const auto count = static_cast<Eigen::Index>(parameters.size());
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(count, count);
  out(known, known) = arm.covariance(in_arm, in_arm);
  if (others.empty()) return out;
  const Eigen::MatrixXd free = J(Eigen::all, others);
  const Eigen::MatrixXd inverse = inverse_information(free);
  const Eigen::MatrixXd follows = -inverse * (free.transpose() * J(Eigen::all, known));
  const Eigen::MatrixXd cross = follows * out(known, known);
  out(others, known) = cross;
  out(known, others) = cross.transpose();
  out(others, others) = inverse + cross * follows.transpose();
  return out;
}

}  // namespace plumb::offline

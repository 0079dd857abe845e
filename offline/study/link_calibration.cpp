// SPDX-License-Identifier: Apache-2.0
#include "study/link_calibration.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace plumb::offline::study {
namespace {

constexpr int kMostIterations = 20;
constexpr double kDecrease = 1e-9;  // relative decrease of the deviations that counts as none

}  // namespace

LinkCalibration calibrate_links(const PlanarPoses& measured) {
  LinkCalibration out;
  Eigen::Matrix4d JtJ = Eigen::Matrix4d::Zero();
  for (Eigen::Index i = 0; i < measured.q.rows(); ++i) {
    const auto J = links_jacobian(measured.q(i, 0), measured.q(i, 1));
    JtJ += J.transpose() * J;
  }
  const auto spectrum = Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(JtJ).eigenvalues();
  out.calibrability = spectrum(3) / spectrum(0);
  double before = (measured.p_AC_A - rigid_points(out.d, measured.q)).norm();
  while (out.iterations < kMostIterations) {
    const Samples deviation = measured.p_AC_A - rigid_points(out.d, measured.q);
    Eigen::Vector4d Jtr = Eigen::Vector4d::Zero();
    for (Eigen::Index i = 0; i < measured.q.rows(); ++i)
      Jtr += links_jacobian(measured.q(i, 0), measured.q(i, 1)).transpose() *
             deviation.row(i).transpose();
    const Links better = out.d + JtJ.ldlt().solve(Jtr);
    const double after = (measured.p_AC_A - rigid_points(better, measured.q)).norm();
    ++out.iterations;
    if (!(after < before * (1.0 - kDecrease))) break;
    out.d = better;
    before = after;
  }
  return out;
}

}  // namespace plumb::offline::study

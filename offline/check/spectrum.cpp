// SPDX-License-Identifier: Apache-2.0
#include "check/spectrum.hpp"

#include "check/constants.hpp"
#include "numbers/spectrum.hpp"
#include "numbers/triangle.hpp"

namespace plumb::offline {

Eigen::VectorXd singular_values(const Eigen::MatrixXd& J) {
  if (J.size() == 0) return {};
  // R of J = Q R has the same ones and is small.
  return jacobi_singular_values(householder_triangle(J));
}

Spectrum spectrum(const Eigen::MatrixXd& J) {
  Eigen::MatrixXd scaled = J;
  for (Eigen::Index k = 0; k < J.cols(); ++k) {
    const double length = J.col(k).norm();
    if (length > 0.0) scaled.col(k) /= length;
  }
  Spectrum out;
  out.values = singular_values(scaled);
  if (out.values.size() == 0 || !(out.values(0) > 0.0)) return out;
  out.rank = static_cast<int>((out.values.array() > check::kSingular * out.values(0)).count());
  out.condition = out.values(0) / out.values(out.rank - 1);
  return out;
}

}  // namespace plumb::offline

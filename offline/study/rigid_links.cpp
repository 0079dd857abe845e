// SPDX-License-Identifier: Apache-2.0
#include "study/rigid_links.hpp"

#include <cmath>

namespace plumb::offline::study {

Eigen::Matrix<double, 2, 4> links_jacobian(double phi12, double phi23) {
  const double p2 = phi12, p3 = phi12 + phi23;  // directions of link 2 and link 3
  Eigen::Matrix<double, 2, 4> J;
  // cos(p + 3 pi / 2) = sin p, sin(p + 3 pi / 2) = -cos p
  J << std::cos(p2), std::cos(p3), std::sin(p2), std::sin(p3),  //
      std::sin(p2), std::sin(p3), -std::cos(p2), -std::cos(p3);
  return J;
}

Samples rigid_points(const Links& d, const RowsN& q) {
  Samples out(q.rows(), 2);
  for (Eigen::Index i = 0; i < q.rows(); ++i)
    out.row(i) = (links_jacobian(q(i, 0), q(i, 1)) * d).transpose();
  return out;
}

}  // namespace plumb::offline::study

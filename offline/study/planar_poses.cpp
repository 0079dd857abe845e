// SPDX-License-Identifier: Apache-2.0
#include "study/planar_poses.hpp"

#include "cell/random.hpp"
#include "study/rigid_links.hpp"
#include "study/white_noise.hpp"

namespace plumb::offline::study {
PlanarPoses true_poses(PlanarVariant variant, const RowsN& q) {
  PlanarPoses out{q, rigid_points(kNominalLinks, q)};
  for (Eigen::Index i = 0; i < q.rows(); ++i)
    out.p_AC_A.row(i) += planar_deflection(variant, q(i, 0), q(i, 1)).transpose();
  return out;
}

PlanarPoses measured_poses(PlanarVariant variant, const RowsN& q, double sigma_m,
                           std::uint64_t seed) {
  PlanarPoses out = true_poses(variant, q);
  Random random(seed);
  for (Eigen::Index i = 0; i < q.rows(); ++i)
    for (Eigen::Index k = 0; k < 2; ++k) out.p_AC_A(i, k) += sigma_m * normal(random);
  return out;
}

RowsN random_angles(const RowsN& around, int n, std::uint64_t seed) {
  Random random(seed);
  RowsN out(n, 2);
  for (int i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < 2; ++k) {
      const double low = around.col(k).minCoeff(), high = around.col(k).maxCoeff();
      out(i, k) = low + (high - low) * random.unit();
    }
  return out;
}

TotalError total_error(const Samples& predicted, const Samples& truth) {
  const Eigen::VectorXd e = (predicted - truth).rowwise().norm();
  return {e.mean(), e.maxCoeff()};
}

}  // namespace plumb::offline::study

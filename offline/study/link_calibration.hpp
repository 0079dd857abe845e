// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "study/planar_poses.hpp"

namespace plumb::offline::study {

/// The parameters that the study calibrates: lengths and lateral offsets of both links, d = (L2,
/// L3, v2, v3) [m].
using Links = Eigen::Vector4d;
inline const Links kNominalLinks{kPlanarLink_m, kPlanarLink_m, 0.0, 0.0};

/// Point C of rigid links, eqs. (12) and (13), without (X_A, Y_A). q: (n, 2); shape (n, 2) [m].
Samples rigid_points(const Links& d, const RowsN& q);

/// The calibration method of the study, which is the modified Newton method of its eqs. (6) to (9):
/// d <- d + (J^T J)^-1 J^T (measured - model(d)), as long as the deviations decrease.
struct LinkCalibration {
  Links d = kNominalLinks;
  int iterations = 0;          // including the last one, which finds no decrease
  double calibrability = 0.0;  // cond_2(J^T J), unscaled
};
LinkCalibration calibrate_links(const PlanarPoses& measured);

}  // namespace plumb::offline::study

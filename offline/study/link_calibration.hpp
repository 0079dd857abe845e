// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "study/planar_poses.hpp"
#include "study/rigid_links.hpp"

namespace plumb::offline::study {

/// The calibration method of the study, which is the modified Newton method of its eqs. (6) to (9):
/// d <- d + (J^T J)^-1 J^T (measured - model(d)), as long as the deviations decrease. Because the
/// model is linear in d, the first step already is the solution; the second finds no decrease.
struct LinkCalibration {
  Links d = kNominalLinks;
  int iterations = 0;          // including the last one, which finds no decrease
  double calibrability = 0.0;  // cond_2(J^T J), unscaled
};
LinkCalibration calibrate_links(const PlanarPoses& measured);

}  // namespace plumb::offline::study

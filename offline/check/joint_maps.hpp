// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// How the readings of each joint may become the positions that the DH table means:
/// q = factor * reading + zero; and where the arm then stands.
struct JointMap {
  std::vector<double> zero;                         // [rad], 0 for most joints
  std::vector<double> factor;                       // 1 for all joints but at most one
  double factor_std = 0.0;                          // of the one that is not 1, relative
  double rms_m = 0.0;                               // with the nominal arm, frame and target fitted
  Eigen::Matrix3d M = Eigen::Matrix3d::Identity();  // turns measured into base coordinates
  Eigen::Vector3d target_T = Eigen::Vector3d::Zero();
};

/// The maps that fit best, best first, each of another kind: zeros of some joints that turn, or the
/// factor of one joint, with its zero. Zeros of the first and the last joint are none: the frame
/// and the target take them up. Nor are numbers that these poses do not tell to 1 deg or 1 %.
/// Deterministic. Cost: about 20 us for each of up to 20,000 maps of 40 poses.
std::vector<JointMap> joint_maps(const format::Chain& chain, const Measurements& few, long& tried);

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "noise/step_motions.hpp"

namespace plumb::offline::compare {

/// How much of the squared error a correction of one joint angle would remove that is a function of
/// this angle alone, with one value per bin.
struct JointShare {
  int joint = 0;
  int bins = 0;          // of the angle, each with its own correction
  double share = 0.0;    // of the squared error, less what so many bins explain by chance
  double rms_rad = 0.0;  // RMS of the correction
  double ln_p = 0.0;     // ln of its probability if the errors were independent
  bool matters = false;  // beyond chance, corrected for the number of joints
};

/// One for each turning joint that moves. q: shape (all rows, joints); motions: of the rows used.
std::vector<JointShare> joint_shares(const StepMotions& motions, const RowsN& q);

}  // namespace plumb::offline::compare

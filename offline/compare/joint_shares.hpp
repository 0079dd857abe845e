// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "fit/step_motions.hpp"

namespace plumb::offline::compare {

/// How much of the squared error a turn of one joint would take away that depends on nothing but
/// the joint's own angle.
struct JointShare {
  int joint = 0;
  int bins = 0;          // of the angle, one turn each
  double share = 0.0;    // of the squared error, less what so many numbers explain by chance
  double rms_rad = 0.0;  // of that turn
  double ln_p = 0.0;     // chance of it with independent errors
  bool matters = false;  // beyond chance, all joints counted
};

/// One for each turning joint that moves. q: shape (all rows, joints); motions: rows used.
std::vector<JointShare> joint_shares(const StepMotions& motions, const RowsN& q);

}  // namespace plumb::offline::compare

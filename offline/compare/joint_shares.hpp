// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
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

/// The same of the squared error of orientations, over these rows: what each joint would have to
/// turn by. about: as turns_about_joints returns it; turned: the whole turns [rad]; all of all
/// rows.
std::vector<JointShare> turn_shares(const RowsN& about, const Rows3& turned, const RowsN& q,
                                    const std::vector<int>& rows);

/// The joint about whose axis most of the squared turns goes, if that is more than turns in any
/// direction would by chance; and that share.
struct AxisShare {
  int joint = 0;
  double share = 0.0;  // 1/3 of turns in any direction
};
std::optional<AxisShare> main_axis(const RowsN& about, const Rows3& turned,
                                   const std::vector<int>& rows);

/// One for each turning joint that moves. q: shape (all rows, joints); motions: of the rows used.
std::vector<JointShare> joint_shares(const StepMotions& motions, const RowsN& q);

}  // namespace plumb::offline::compare

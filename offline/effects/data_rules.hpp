// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "effects/data_sense.hpp"
#include "effects/testability.hpp"

/// What the laws' rules about testable data have in common.
namespace plumb::offline {

Testability can_show(std::string why);
Testability can_show_weakly(std::string why);
Testability cannot_show(std::string why);

/// Numbers of poses from which on the laws ask for them: a law with few numbers, one with several,
/// and one with many for each joint. Chosen.
inline constexpr int kFewPoses = 40, kManyPoses = 150, kDensePoses = 500;
inline constexpr double kLever_m = 0.02;  // least DataSense::lever_m that counts as a varying load
inline constexpr double kLongTravel_m = 0.1;                  // of a joint that slides
inline constexpr double kWideRange_rad = 1.0471975511965976;  // 60 deg

/// Names of the turning joints for which holds(joint) is true: "J2, J3".
template <class Holds>
std::string joint_list(const DataSense& data, Holds holds) {
  std::string out;
  for (int j = 0; j < data.joints(); ++j)
    if (data.turns[j] && holds(j)) out += (out.empty() ? "" : ", ") + data.names[j];
  return out;
}

/// The same of all joints, whether they turn or slide.
template <class Holds>
std::string all_joint_list(const DataSense& data, Holds holds) {
  std::string out;
  for (int j = 0; j < data.joints(); ++j)
    if (holds(j)) out += (out.empty() ? "" : ", ") + data.names[j];
  return out;
}

/// Joints whose gravity torque varies with the pose, and those where it does not.
std::string loaded_joints(const DataSense& data);
std::string unloaded_joints(const DataSense& data);

/// Joints that use a range smaller than that [rad].
std::string joints_within(const DataSense& data, double range_rad);

/// Joints that slide by kLongTravel_m or more.
std::string long_slides(const DataSense& data);

/// "; not at J1: gravity never turns it", or nothing if there are no joints.
std::string except_joints(const std::string& joints, const char* why);

std::string poses_text(const DataSense& data);  // "38 poses"

/// Rules that several laws share: one that needs loads on the joints, and one whose error repeats
/// with the turn of its joint.
Testability compliance_testable(const DataSense& data);
Testability harmonics_testable(const DataSense& data);

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#include "effects/data_rules.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace plumb::offline {

Testability can_show(std::string why) { return {Testability::Answer::kYes, std::move(why)}; }
Testability can_show_weakly(std::string why) {
  return {Testability::Answer::kWeakly, std::move(why)};
}
Testability cannot_show(std::string why) { return {Testability::Answer::kNo, std::move(why)}; }

std::string loaded_joints(const DataSense& data) {
  return joint_list(data, [&](int j) { return data.lever_m[j] > kLever_m; });
}

std::string unloaded_joints(const DataSense& data) {
  return joint_list(data, [&](int j) { return data.lever_m[j] <= kLever_m; });
}

std::string joints_within(const DataSense& data, double range_rad) {
  return joint_list(data, [&](int j) { return data.range[j] < range_rad; });
}

std::string long_slides(const DataSense& data) {
  return all_joint_list(data,
                        [&](int j) { return !data.turns[j] && data.range[j] >= kLongTravel_m; });
}

std::string except_joints(const std::string& joints, const char* why) {
  return joints.empty() ? "" : fmt::format("; not at {}: {}", joints, why);
}

std::string poses_text(const DataSense& data) { return fmt::format("{} poses", data.poses); }

Testability compliance_testable(const DataSense& data) {
  const std::string loaded = loaded_joints(data);
  if (loaded.empty()) return cannot_show("gravity turns no joint differently from pose to pose");
  const std::string why = fmt::format("the load of {} varies with the pose", loaded) +
                          except_joints(unloaded_joints(data), "gravity never turns it");
  if (data.poses < kFewPoses) return can_show_weakly(why + "; " + poses_text(data));
  return data.has_masses || data.payload_span_kg > 0.0
             ? can_show(why)
             : can_show_weakly(why + "; masses unknown, so only as free combinations");
}

Testability harmonics_testable(const DataSense& data) {
  const std::string narrow = joints_within(data, M_PI);
  if (data.poses < kFewPoses) return cannot_show(poses_text(data));
  const std::string wide = joint_list(data, [&](int j) { return data.range[j] >= M_PI; });
  if (wide.empty()) return cannot_show("no joint moves over half a turn");
  const std::string why = fmt::format("{} move over half a turn or more", wide) +
                          except_joints(narrow, "too small a range");
  return narrow.empty() ? can_show(why) : can_show_weakly(why);
}

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#include "cell/cell.hpp"

namespace plumb::offline {

const std::vector<std::string>& known_effects() {
  static const std::vector<std::string> names{"geometry", "local_tree"};
  return names;
}

const std::vector<std::string>& planned_effects() {
  static const std::vector<std::string> names{"joint_compliance",
                                              "joint_compliance_soft",
                                              "gravity_free",
                                              "link_flexure",
                                              "gear_harmonics",
                                              "gear_ripple",
                                              "joint_table",
                                              "encoder_scale",
                                              "encoder_eccentricity",
                                              "reversal",
                                              "backlash_load",
                                              "settling_lag",
                                              "axis_wobble",
                                              "wrist_coupling",
                                              "cross_compliance",
                                              "thermal_growth",
                                              "base_compliance",
                                              "tool_sag",
                                              "gravity_compensator",
                                              "payload_compliance",
                                              "wrench_compliance",
                                              "drift",
                                              "step",
                                              "tracker",
                                              "formula"};
  return names;
}

}  // namespace plumb::offline

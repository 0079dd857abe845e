// SPDX-License-Identifier: Apache-2.0
#include "arm/arm_state.hpp"

namespace plumb::offline {

format::Pose& ArmState::frame(int setup) {
  const int k = frame_of(setup);
  return k == 0 ? X_MB : more[k - 1].X_MB;
}
format::Pose& ArmState::target(int setup) {
  const int k = target_of(setup);
  return k == 0 ? X_TG : more[k - 1].X_TG;
}
const format::Pose& ArmState::frame(int setup) const {
  const int k = frame_of(setup);
  return k == 0 ? X_MB : more[k - 1].X_MB;
}
const format::Pose& ArmState::target(int setup) const {
  const int k = target_of(setup);
  return k == 0 ? X_TG : more[k - 1].X_TG;
}
double& ArmState::length(int setup) { return setup == 0 ? length_m : more[setup - 1].length_m; }
double ArmState::length(int setup) const {
  return setup == 0 ? length_m : more[setup - 1].length_m;
}

}  // namespace plumb::offline

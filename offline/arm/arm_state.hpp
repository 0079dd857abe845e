// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cell/measurements.hpp"
#include "plumb/format/model.hpp"

namespace plumb::offline {

/// Everything that turns joint positions into a measured point: the arm, and the measurement's own
/// frame and target, which belong to the measurement and are never compiled.
///
/// With several set-ups (cell/setups.hpp), X_MB and X_TG are those of the first, and `more` holds
/// those of the others. A set-up may share the frame or the reflector of an earlier one.
struct ArmState {
  format::Model arm;      // calibrated chain, trees, domain; the rest may be empty
  format::Pose X_MB;      // base in the measurement frame
  format::Pose X_TG;      // reflector (gauge) in the tool frame
  double length_m = 0.0;  // of an artefact of the first set-up: observe/reading.hpp

  struct Placing {
    int frame_of = 0;   // index of the set-up whose frame it uses: its own, or an earlier one
    int target_of = 0;  // the same for the reflector
    format::Pose X_MB;  // used if frame_of is this set-up
    format::Pose X_TG;  // used if target_of is this set-up
    double length_m = 0.0;
    bool operator==(const Placing&) const = default;
  };
  std::vector<Placing> more = {};  // of the second set-up and those after it

  int setups() const { return 1 + static_cast<int>(more.size()); }
  int frame_of(int setup) const { return setup == 0 ? 0 : more[setup - 1].frame_of; }
  int target_of(int setup) const { return setup == 0 ? 0 : more[setup - 1].target_of; }
  format::Pose& frame(int setup);
  format::Pose& target(int setup);
  const format::Pose& frame(int setup) const;
  const format::Pose& target(int setup) const;
  double& length(int setup);
  double length(int setup) const;
};

/// The set-up in which row `row` was measured.
inline int setup_of(const Measurements& at, Eigen::Index row) {
  return at.setup.empty() ? 0 : at.setup[static_cast<std::size_t>(row)];
}

}  // namespace plumb::offline

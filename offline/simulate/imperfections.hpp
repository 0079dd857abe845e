// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

namespace plumb::offline {

/// Properties of a real arm, its mounting and its record that are no effects of their own but make
/// effects harder to find. None by default. SI units.
struct Imperfections {
  /// 1 sigma of an error of each joint that is drawn anew at every stop [rad], of a sliding joint
  /// [m]. All readings that are taken in place at one stop share it; when the pose is visited
  /// again, another one is drawn. A single value is that of every joint.
  std::vector<double> joint_scatter;
  /// The recorded joint positions are rounded to multiples of it [rad], of a sliding joint [m];
  /// 0: not rounded. The arm itself stands where it stood.
  double encoder_step = 0.0;
  /// The true gravity in the base frame [m/s^2], if it is not the one that the cell states.
  std::optional<std::array<double, 3>> gravity;
  /// Zero-based joints that a parallelogram turns, as in palletisers: see sim::Drives.
  std::vector<int> coupled;

  bool any() const {
    return !joint_scatter.empty() || encoder_step != 0.0 || gravity || !coupled.empty();
  }
};

}  // namespace plumb::offline

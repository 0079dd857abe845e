// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace plumb::offline {

/// Three turns about named axes, one after the other: "xyz-fixed" (about the axes of the frame,
/// R = Rz Ry Rx) or "xyz-moving" (about the axes that have already turned, R = Rx Ry Rz). All
/// twelve orders, "zyz-moving" among them.
struct EulerConvention {
  std::array<int, 3> axes{0, 1, 2};
  bool moving = false;
};

/// Throws Failure (kUsage, E-IMPORT-ROT) for a name it does not know.
EulerConvention euler_convention(std::string_view name);

/// Unit quaternion (w, x, y, z), w >= 0, of turns [rad] in the convention's order.
std::array<double, 4> quaternion(const EulerConvention& convention,
                                 const std::array<double, 3>& turns);

}  // namespace plumb::offline

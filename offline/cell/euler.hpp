// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace plumb::offline {

/// What the numbers of the columns rx, ry, rz mean. Three turns about named axes, one after the
/// other: "xyz-fixed" (about the axes of the frame, R = Rz Ry Rx) or "xyz-moving" (about the axes
/// that have already turned, R = Rx Ry Rz). All twelve orders, "zyz-moving" among them. Or
/// "rotation-vector": one turn about the vector's direction by its length.
struct EulerConvention {
  std::array<int, 3> axes{0, 1, 2};
  bool moving = false;
  bool is_vector = false;
  bool operator==(const EulerConvention&) const = default;
};

/// Nothing for a name that is none of these.
std::optional<EulerConvention> find_euler_convention(std::string_view name);

std::string name_of(const EulerConvention& convention);

/// Unit quaternion (w, x, y, z), w >= 0, of turns [rad] in the convention's order.
std::array<double, 4> quaternion(const EulerConvention& convention,
                                 const std::array<double, 3>& turns);

}  // namespace plumb::offline

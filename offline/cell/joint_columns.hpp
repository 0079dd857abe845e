// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <span>
#include <utility>
#include <vector>

#include "plumb/runtime/coupling.hpp"

namespace plumb::offline {

/// What the columns q1 ... qn of an arm's files hold: the controller's joint values. In memory
/// stand the joint angles that follow from them.
struct JointColumns {
  std::vector<bool> is_angle;  // or a length: the joint slides
  Coupling coupling;           // of values and angles

  JointColumns(std::vector<bool> kinds) : is_angle(std::move(kinds)) {}  // NOLINT
  JointColumns(std::initializer_list<bool> kinds) : is_angle(kinds) {}   // NOLINT
  JointColumns(const format::Chain& arm) : coupling(arm.coupling) {      // NOLINT
    for (const auto& row : arm.joints) is_angle.push_back(row.type == format::JointType::kRevolute);
  }
};

/// The rows of a matrix, one joint a column, turned from values into angles or back.
template <class Rows>
void to_angles(const Coupling& coupling, Rows& q) {
  for (Eigen::Index i = 0; i < q.rows() && !coupling.empty(); ++i)
    coupling.to_angles(std::span(q.row(i).data(), static_cast<std::size_t>(q.cols())));
}
template <class Rows>
void to_values(const Coupling& coupling, Rows& q) {
  for (Eigen::Index i = 0; i < q.rows() && !coupling.empty(); ++i)
    coupling.to_values(std::span(q.row(i).data(), static_cast<std::size_t>(q.cols())));
}

/// The controller's values at these joint angles, to be written or shown.
inline std::vector<double> values_at(std::span<const double> angles, const format::Chain& arm) {
  std::vector<double> out(angles.begin(), angles.end());
  Coupling(arm.coupling).to_values(out);
  return out;
}

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cell/euler.hpp"
#include "cell/needed_columns.hpp"
#include "cell/table.hpp"
#include "program/problem_list.hpp"

namespace plumb::offline {

/// Three columns by axis; null where the file has none.
using AxisColumns = std::array<const Column*, 3>;

/// The columns of a table that speak of the arm and of the measured point. They live as long as
/// the table.
struct ArmColumns {
  std::vector<const Column*> q;         // one per joint; null if missing
  AxisColumns p{};                      // x, y, z
  AxisColumns sigma{};                  // sx, sy, sz: for every measured axis, or none
  AxisColumns nominal{};                // nx, ny, nz: for every measured axis, or none
  std::array<const Column*, 4> quat{};  // qw, qx, qy, qz: all or none
  AxisColumns turns{};                  // rx, ry, rz: all or none
  EulerConvention rotation;             // what these mean
  const Column* pose = nullptr;
  const Column* set = nullptr;

  bool has_orientation() const { return quat[0] != nullptr || turns[0] != nullptr; }
};

/// Joint columns PREFIX1 … PREFIXn of the right kind; all of them. Too many are an error as well.
std::vector<const Column*> find_joints(const Table& table, const std::string& prefix,
                                       const std::vector<bool>& joint_is_angle,
                                       ProblemList& problems);

/// What `# rot:` says of the columns rx, ry, rz; nothing if it says nothing that is known.
std::optional<EulerConvention> stated_rotation(const Table& table);

/// Columns qw … qz, or rx, ry, rz with a line such as `# rot: xyz-fixed`.
void find_orientation(const Table& table, ArmColumns& out, ProblemList& problems);

/// Finds and checks them; what is missing or of the wrong kind goes to `problems`.
ArmColumns find_arm_columns(const Table& table, const std::vector<bool>& joint_is_angle,
                            Needs needs, ProblemList& problems);

/// Unit quaternion (w, x, y, z) of a row; from rx, ry, rz as `# rot:` says.
/// A norm off by more than 1e-3 is an error.
std::array<double, 4> orientation(const Table& table, const ArmColumns& columns, int row,
                                  ProblemList& problems);

}  // namespace plumb::offline

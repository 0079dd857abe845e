// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "import/column_guess.hpp"

namespace plumb::offline {

/// The columns of a homogeneous matrix: its first three rows, and the fourth if the file has it.
struct PoseMatrix {
  std::array<std::array<std::size_t, 4>, 3> at{};
  std::vector<std::size_t> last_row;
};

/// Columns T00 to T33, or T11 to T44, "m_0_3", "R[1][4]", whose numbers are a rotation and a
/// position in every row; nothing if there are none, or several.
std::optional<PoseMatrix> matrix_in(const std::vector<ColumnPlan>& plans,
                                    const std::vector<ColumnContent>& contents);

/// Unit quaternion (w, x, y, z), w >= 0, of a rotation matrix, row by row.
std::array<double, 4> quaternion_of(const std::array<double, 9>& rotation);

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "import/column_plan.hpp"
#include "import/content.hpp"
#include "import/imported.hpp"

namespace plumb::offline {

/// The columns of a homogeneous matrix: its first three rows, and the fourth if the file has it.
struct PoseMatrix {
  std::array<std::array<std::size_t, 4>, 3> at{};
  std::vector<std::size_t> last_row;
  bool turns = true;  // no other column tells the orientation
};

/// Columns T00 to T33, or T11 to T44, "m_0_3", "R[1][4]", whose numbers are a rotation and a
/// position in every row: if nothing else is x, y or z, the position is (N-IMPORT-MATRIX).
std::optional<PoseMatrix> take_matrix(std::vector<ColumnPlan>& plans,
                                      const std::vector<ColumnContent>& contents,
                                      std::vector<Problem>& remarks);

/// Columns qw, qx, qy, qz of the rotations.
std::vector<ImportedColumn> orientation_of(const PoseMatrix& matrix, const CellTable& cells,
                                           char decimal);

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "cell/cell.hpp"
#include "import/imported.hpp"

namespace plumb::offline {

/// What makes a row of one file and a row of the other belong together.
enum class JoinBy { kPose, kTime, kOrder };

struct JoinWishes {
  JoinBy by = JoinBy::kPose;
  double max_gap_s = 1.0;      // kTime: largest time between two rows that belong together
  const Cell* cell = nullptr;  // kOrder: the arm by which a shift of rows is found, or null
};

/// Joins two files row by row; rows without a partner are dropped and counted in a warning.
/// kOrder: if the counts differ, or if it fits the arm of `cell` clearly better, the second file is
/// shifted by up to five rows, and both residuals are reported.
/// Throws Failure (kInput, E-IMPORT-JOIN) if they cannot be joined.
Imported join(const Imported& first, const Imported& second, const JoinWishes& wishes);

}  // namespace plumb::offline

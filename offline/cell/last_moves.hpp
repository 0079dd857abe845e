// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "cell/context_rows.hpp"
#include "cell/table.hpp"

namespace plumb::offline {

/// What a row may be compared with if its file does not say from where the arm came.
enum class Neighbours {
  kTheRowBefore,  // of the same file: the rows are consecutive, as measured
  kNone           // a list of poses in any order
};

/// Last move of each joint with its sign, as a share of the largest move of all joints, shape (all
/// rows, joints). From the columns dir_jN and travel_jN if a file has them for every joint; else,
/// or where dir_jN is 0 (unknown), from the row before. Such values are 0 in the first row of a
/// file, and unknown (NaN) without neighbours.
RowsN last_moves(std::span<const Table> tables, const RowsN& q, Neighbours neighbours);

/// For rows of a list in any order: makes their order unknown, and the moves that were computed
/// from the row before.
void forget_order(std::span<const Table> tables, const RowsN& q, ContextRows& rows);

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "cell/contexts.hpp"

namespace plumb::offline {

/// What a row may be compared with where its file does not say how the arm came.
enum class Neighbours {
  kTheRowBefore,  // of the same file: the rows are consecutive, as measured
  kNone           // a list of poses in any order
};

/// Last move of each joint as a share of the largest joint's, shape (all rows, joints), with sign.
/// From the columns dir_jN and travel_jN of a file that has them for every joint; else from the row
/// before. The first row of each file has none before it: 0, nothing moved. Without columns and
/// neighbours unknown (NaN), as is a joint that moved in an unknown direction (dir_jN = 0); the row
/// before tells that too.
ContextRows::RowsN last_moves(std::span<const Table> tables, const ContextRows::RowsN& q,
                              Neighbours neighbours);

/// Rows of a list in any order: their place in it says nothing. Forgets the order, and the moves
/// that came from neighbours.
void forget_order(std::span<const Table> tables, const ContextRows::RowsN& q, ContextRows& rows);

}  // namespace plumb::offline

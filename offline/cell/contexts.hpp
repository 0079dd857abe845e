// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "cell/context_rows.hpp"
#include "cell/table.hpp"

namespace plumb::offline {

/// Joins the context columns of the tables. q: shape (all rows, joints).
ContextRows read_contexts(std::span<const Table> tables, const RowsN& q);

}  // namespace plumb::offline

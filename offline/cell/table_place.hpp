// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cell/table.hpp"

namespace plumb::offline {

/// The header cell of a column; the whole file if the table was not read from one.
Place place_in_header(const Table& table, const Column& column, std::string label);

/// Behind the last header cell: where a missing column would stand.
Place place_of_missing(const Table& table, std::string label);

/// The cell of a column in a row.
Place place_in_row(const Table& table, int row, const Column& column, std::string label);

}  // namespace plumb::offline

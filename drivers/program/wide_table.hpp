// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace plumb {

/// A table that is wider than the screen, as several tables one below the other: each has the first
/// column and as many of the others as there is room for.
///
/// `rows`: lines whose cells stand in columns with at least two blanks between, the heads first.
/// `last_room`: columns of the screen that are enough for the last cell of a row, because that cell
/// is broken into lines later.
/// Returns the rows as they are if there are no columns to part.
std::vector<std::string> parted(const std::vector<std::string>& rows, std::size_t columns,
                                std::size_t last_room);

}  // namespace plumb

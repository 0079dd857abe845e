// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "cell/table.hpp"

namespace plumb::offline {

/// Reads a CSV file strictly: UTF-8, header with units, no ragged rows, only finite numbers.
/// Throws Failure with all problems (exit 3).
Table read_table(const std::filesystem::path& file);
Table parse_table(std::string_view text, const std::string& file_name);

}  // namespace plumb::offline

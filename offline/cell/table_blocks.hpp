// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "cell/table.hpp"

namespace plumb::offline {

/// Reads a table as strictly as read_table, a block of rows at a time, so that it need not fit into
/// the memory; what `take` got of a file that is refused in the end is void. Returns the SHA-256
/// sum of the file.
std::string read_blocks(const std::filesystem::path& file,
                        const std::function<void(const Table&)>& take);

}  // namespace plumb::offline

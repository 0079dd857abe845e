// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace plumb::drivers::rt {

/// Whether a new file could be made here, without making it: 0, or the errno with which it would
/// fail, for example EEXIST, ENOENT (no such folder) or EACCES.
int creation_error(const std::filesystem::path& file);

}  // namespace plumb::drivers::rt

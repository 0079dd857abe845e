// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace plumb::drivers::rt {

/// Tests without creating it whether this file could be created: 0, or the errno of the failure,
/// for example EEXIST, ENOENT (no such folder) or EACCES.
int creation_error(const std::filesystem::path& file);

}  // namespace plumb::drivers::rt

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace plumb::offline::workbench {

/// What tells whether a file is still the same: its number, size and time of change; "-" if there
/// is none.
std::string stamp_of(const std::filesystem::path& file);

/// Stamps of several files, and of every run below `folder`/runs. A run that was replaced, cut off,
/// deleted or diagnosed changes them. Cost: a system call a file.
std::string stamps_of(const std::vector<std::filesystem::path>& files);
std::string stamps_of_runs(const std::filesystem::path& folder);

/// Names and stamps of the files that lie directly in the folder, the first thousand of them.
std::string stamps_inside(const std::filesystem::path& folder);

}  // namespace plumb::offline::workbench

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace plumb::offline::workbench {

/// Whether a text names a file or folder directly inside a folder and can be mistaken neither for
/// an option nor for a hidden file: "tracker B.csv", never "../x", "-o" or ".ssh".
bool is_plain_name(const std::string& name);

/// Whether a word of a command line can lead out of the folder in which the command runs: an
/// absolute path or "..", alone or behind "=", ":" or ",", or a symbolic link to somewhere else.
bool leads_outside(const std::string& word, const std::filesystem::path& folder);

/// Whether `path` lies in `folder` once every link is followed.
bool lies_inside(const std::filesystem::path& path, const std::filesystem::path& folder);

}  // namespace plumb::offline::workbench

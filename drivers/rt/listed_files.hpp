// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace plumb::drivers::rt {

/// The names that the text of a SHA256SUMS lists, without reading the files. Throws Failure
/// (kInput): E-RT-SUMS as `sum_lines` does, E-RT-FOLDER if a name could lie outside of
/// the folder or is one of the signature's own files. `folder` is only named in messages.
std::vector<std::string> listed_files(const std::filesystem::path& folder, const std::string& sums);

}  // namespace plumb::drivers::rt

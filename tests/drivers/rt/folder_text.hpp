// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <string>

namespace plumb::tests {

inline std::string whole_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// What stands in a folder: names relative to it, and the content of regular files, the target of
/// links or "a folder". Two folders with the same text are the same for whoever reads them.
inline std::map<std::string, std::string> folder_text(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::map<std::string, std::string> out;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).string();
    if (entry.is_symlink())
      out[name] = "to " + fs::read_symlink(entry.path()).string();
    else if (entry.is_directory())
      out[name] = "a folder";
    else
      out[name] = entry.is_regular_file() ? "holds " + whole_text(entry.path()) : "no file";
  }
  return out;
}

}  // namespace plumb::tests

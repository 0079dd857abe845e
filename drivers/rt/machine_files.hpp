// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace plumb::drivers::rt {

/// The files in which a machine describes itself: /proc and /sys below `root`.
class MachineFiles {
 public:
  explicit MachineFiles(std::filesystem::path root) : root_(std::move(root)) {}

  /// The whole file without white space at its end; nothing if it cannot be read.
  std::optional<std::string> read(const std::string& file) const;

  /// The first line that begins with `key`, without it and the white space and colon that follow.
  std::optional<std::string> line(const std::string& file, const std::string& key) const;

  /// Names in a folder, sorted; none if there is no such folder.
  std::vector<std::string> names(const std::string& folder) const;

 private:
  std::filesystem::path path_of(const std::string& file) const { return root_ / file; }

  std::filesystem::path root_;
};

}  // namespace plumb::drivers::rt

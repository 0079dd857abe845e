// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace plumb {

/// A new folder among the system's temporary files, gone with all that is in it at the end.
class ScratchFolder {
 public:
  /// Its name starts with `begins`. Throws std::system_error if it cannot be made.
  explicit ScratchFolder(const std::string& begins);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace plumb

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace plumb::offline::workbench {

/// Keeps every other plumb process from changing a cell while this object lives; the same advisory
/// lock on the folder that the verbs take. Waits up to five seconds for the other one, then throws
/// Failure (kEnvironment, E-CELL-BUSY). A file system without locks is worked in without one.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int fd_ = -1;
};

}  // namespace plumb::offline::workbench

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "plumb/drivers/descriptor.hpp"

namespace plumb::drivers::rt {

/// Holds a deploy folder for the life of the process, so that no second plumb-rt runs it: flock on
/// the folder itself. It needs no right to write and no file, holds while the process is stopped,
/// and ends with the process, however that ends.
class FolderLock {
 public:
  /// Throws Failure (kEnvironment): E-RT-RUNNING if another process holds the folder, E-RT-LOCK if
  /// it cannot be locked.
  explicit FolderLock(const std::filesystem::path& folder);

 private:
  Descriptor folder_;
};

}  // namespace plumb::drivers::rt

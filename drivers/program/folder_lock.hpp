// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>

namespace plumb {

/// An exclusive, advisory lock (flock) on a folder itself. It needs no right to write and no file,
/// holds while the process is stopped, and ends with this object or the process, however that ends.
class FolderLock {
 public:
  enum class State {
    kHeld,
    kBusy,       // another process or object has it
    kImpossible  // there is no such folder, or its file system has no locks: error() says why
  };

  /// Tries once.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&&) = delete;

  State state() const { return state_; }
  int error() const { return error_; }  // errno of kImpossible

  /// While it is busy, tries until it is not, for no longer than `longest`.
  State wait(std::chrono::milliseconds longest);

 private:
  void try_once();

  int folder_ = -1;
  int error_ = 0;
  State state_ = State::kImpossible;
};

}  // namespace plumb

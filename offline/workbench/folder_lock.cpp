// SPDX-License-Identifier: Apache-2.0
#include "workbench/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <thread>

#include "program/problem.hpp"

namespace plumb::offline::workbench {

using namespace std::chrono_literals;

FolderLock::FolderLock(const std::filesystem::path& folder)
    : fd_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  const auto end = std::chrono::steady_clock::now() + 5s;
  while (fd_ >= 0 && ::flock(fd_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    if (std::chrono::steady_clock::now() > end) {
      ::close(fd_);
      throw Failure(Exit::kEnvironment, {.code = "E-CELL-BUSY",
                                         .message = "another plumb is changing the cell",
                                         .help = "wait until it has ended, and save again"});
    }
    std::this_thread::sleep_for(50ms);
  }
}

FolderLock::~FolderLock() {
  if (fd_ >= 0) ::close(fd_);
}

}  // namespace plumb::offline::workbench

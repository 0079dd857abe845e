// SPDX-License-Identifier: Apache-2.0
#include "program/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <thread>
#include <utility>

namespace plumb {
namespace {

constexpr std::chrono::milliseconds kBetweenLooks{20};

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder)
    : folder_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (folder_ < 0)
    error_ = errno;
  else
    try_once();
}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : folder_(std::exchange(other.folder_, -1)), error_(other.error_), state_(other.state_) {}

FolderLock::~FolderLock() {
  if (folder_ >= 0) ::close(folder_);
}

void FolderLock::try_once() {
  if (::flock(folder_, LOCK_EX | LOCK_NB) == 0) {
    state_ = State::kHeld;
  } else {
    error_ = errno;
    state_ = error_ == EWOULDBLOCK || error_ == EINTR ? State::kBusy : State::kImpossible;
  }
}

FolderLock::State FolderLock::wait(std::chrono::milliseconds longest) {
  const auto begin = std::chrono::steady_clock::now();
  while (state_ == State::kBusy && std::chrono::steady_clock::now() - begin <= longest) {
    std::this_thread::sleep_for(kBetweenLooks);
    try_once();
  }
  return state_;
}

}  // namespace plumb

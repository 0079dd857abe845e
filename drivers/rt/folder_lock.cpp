// SPDX-License-Identifier: Apache-2.0
#include "rt/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>

#include <cerrno>
#include <cstring>

#include "program/file.hpp"
#include "program/problem.hpp"
#include "program/shell_word.hpp"

namespace plumb::drivers::rt {

FolderLock::FolderLock(const std::filesystem::path& folder)
    : folder_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (folder_.open() && ::flock(folder_.get(), LOCK_EX | LOCK_NB) == 0) return;
  const int error = errno;
  if (folder_.open() && error == EWOULDBLOCK)
    throw Failure(Exit::kEnvironment,
                  {.code = "E-RT-RUNNING",
                   .message = fmt::format("another plumb-rt runs {}, or is stopped in it",
                                          display_name(folder)),
                   .help = "plumb-rt status " + shell_word(display_name(folder))});
  throw Failure(Exit::kEnvironment,
                {.code = "E-RT-LOCK",
                 .message = fmt::format("{} cannot be locked: {}", display_name(folder),
                                        std::strerror(error)),
                 .help = "keep the folder on a local file system, readable by plumb-rt"});
}

}  // namespace plumb::drivers::rt

// SPDX-License-Identifier: Apache-2.0
#include "rt/creatable.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

namespace plumb::drivers::rt {

int creation_error(const std::filesystem::path& file) {
  struct stat found {};
  if (::lstat(file.c_str(), &found) == 0) return EEXIST;
  if (errno != ENOENT) return errno;
  // The empty name at the end makes the test fail with ENOTDIR if the "folder" is a file.
  const auto folder = std::filesystem::absolute(file).parent_path() / "";
  return ::faccessat(AT_FDCWD, folder.c_str(), W_OK | X_OK, AT_EACCESS) == 0 ? 0 : errno;
}

}  // namespace plumb::drivers::rt

// SPDX-License-Identifier: Apache-2.0
#include "program/byte_output.hpp"

#include <unistd.h>

#include <cerrno>

namespace plumb {

int write_all(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return 0;
}

int sync_to_disk(int fd) {
  int result = 0;
  do result = ::fsync(fd);
  while (result != 0 && errno == EINTR);
  return result == 0 || errno == EINVAL || errno == ENOTSUP ? 0 : errno;
}

int write_and_sync(int fd, std::string_view bytes) {
  const int error = write_all(fd, bytes);
  return error != 0 ? error : sync_to_disk(fd);
}

bool is_stream(const std::filesystem::path& file) {
  std::error_code ignored;
  const auto status = std::filesystem::status(file, ignored);
  return std::filesystem::is_fifo(status) || std::filesystem::is_character_file(status);
}

}  // namespace plumb

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

/// Output of bytes to an open file descriptor. Interrupted system calls are repeated.
namespace plumb {

/// Writes all bytes. Returns 0 or an errno.
int write_all(int fd, std::string_view bytes);

/// Waits until the bytes are on the disk; not for a pipe or a device. Returns 0 or an errno.
int sync_to_disk(int fd);

/// Writes all bytes and waits. Returns 0 or an errno.
int write_and_sync(int fd, std::string_view bytes);

/// True if the name is that of a pipe or a device, which cannot be replaced by a new file.
bool is_stream(const std::filesystem::path& file);

}  // namespace plumb

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

/// Bytes into an open file descriptor. Every call goes on after an interrupted system call.
namespace plumb {

/// Writes all of them. 0 or errno.
int write_all(int fd, std::string_view bytes);

/// Waits until they are on the disk; a pipe or a device has nothing to wait for. 0 or errno.
int sync_to_disk(int fd);

/// Both. 0 or errno.
int write_and_sync(int fd, std::string_view bytes);

/// Whether the name stands for a pipe or a device, which cannot be replaced by a new file.
bool is_stream(const std::filesystem::path& file);

}  // namespace plumb

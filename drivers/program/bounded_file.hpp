// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace plumb {

/// Largest sizes [bytes] of files that are read as a whole. A larger file cannot be of the expected
/// kind, and would fill the memory before it could be reported.
inline constexpr std::uintmax_t kMostCellBytes = 16u << 20;
inline constexpr std::uintmax_t kMostUrdfBytes = 64u << 20;
inline constexpr std::uintmax_t kMostStreamBytes = 512u << 20;  // of a pipe or a device
inline constexpr std::uintmax_t kMostFileBytes = 2048ull << 20;

/// Whole file as text. Throws Failure (kInput) if missing, a directory, unreadable, or larger than
/// `most` bytes; a pipe or a device is read up to the smaller of `most` and kMostStreamBytes.
std::string read_file_up_to(const std::filesystem::path& file, std::uintmax_t most);

/// The same of a regular file only: anything else, such as a pipe or a device, is refused before a
/// byte of it is read or waited for.
std::string read_regular_file(const std::filesystem::path& file, std::uintmax_t most);

}  // namespace plumb

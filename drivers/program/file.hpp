// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace plumb {

/// A file as messages name it: relative if it lies in the working directory or below.
std::string display_name(const std::filesystem::path& file);

/// Whole file as text. Throws Failure (kInput) if missing, a directory or unreadable.
std::string read_file(const std::filesystem::path& file);

/// Writes all or nothing: a temporary file beside the target, fsync, rename, fsync of the folder.
/// If the file system allows it, the temporary file has no name until it is complete, so that a
/// killed program leaves nothing behind. Otherwise the next writer of the same target removes the
/// temporary files of killed programs.
/// A pipe, a terminal or another device is not replaced but written to, because its readers would
/// otherwise be cut off. Throws Failure (kEnvironment) with the system's reason; the temporary file
/// is removed.
void write_file_atomically(const std::filesystem::path& file, std::string_view bytes);

/// True if writing to this name would replace content. False if there is no such file, or if it is
/// a pipe or a character device such as /dev/null.
bool would_replace(const std::filesystem::path& file);

/// The same, but refuses (kUsage, E-EXISTS) to replace a file unless `force`.
enum class Overwrite { kNo, kForce };
void write_new_file(const std::filesystem::path& file, std::string_view bytes, Overwrite overwrite);

/// 64 lower-case hex digits.
std::string sha256(std::string_view bytes);

}  // namespace plumb

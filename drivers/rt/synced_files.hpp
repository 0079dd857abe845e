// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace plumb::drivers::rt {

/// Throws Failure (kEnvironment, E-WRITE) with the system's reason.
[[noreturn]] void refuse_file_write(const std::filesystem::path& file, int error);

/// Waits until the names in a folder are on the disk. Throws Failure (kEnvironment, E-WRITE).
void sync_folder(const std::filesystem::path& folder);

/// Appends one line, on a line of its own even if a killed program left a part of one, and waits
/// until it is on the disk. What a full disk took of it is cut off again. Throws Failure
/// (kEnvironment, E-WRITE).
void append_synced(const std::filesystem::path& file, const std::string& line);

/// Copies these files of one folder into another one, which is made and may be read by its owner
/// only until all is there: files of mode 0444, folders of mode 0555, all of it on the disk. Each
/// must be a regular file of 256 MB at most with a single name. Throws Failure: kInput, E-RT-FOLDER
/// or E-READ for what is read; kEnvironment, E-WRITE for what is written, and then the copy is
/// removed.
void copy_synced(const std::filesystem::path& from, const std::vector<std::string>& names,
                 const std::filesystem::path& to);

/// Removes a folder with all in it, even if it may not be written to. False if that failed.
bool remove_folder(const std::filesystem::path& folder) noexcept;

}  // namespace plumb::drivers::rt

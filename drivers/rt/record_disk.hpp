// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace plumb::drivers::rt {

/// What a record asks the system for besides its files; tests put their own functions here.
struct RecordDisk {
  std::function<std::int64_t()> wall_s;  // seconds since 1970
  /// Bytes that are free for this program in the file system of a folder; all bits set: not known.
  std::function<std::uint64_t(const std::filesystem::path& folder)> free_bytes;
};
RecordDisk real_disk();

/// Why `what` ("the record") is not written to a file any more: a disk that is full is named, with
/// what is free on it and what to do; else the words of the system for `error`.
std::string why_not_written(const std::filesystem::path& file, int error, const std::string& what,
                            const RecordDisk& disk);

/// One of the files of a record: FILE itself has number 0, FILE.1 number 1, and so on.
struct RecordPart {
  std::filesystem::path file;
  std::uint64_t number = 0;
  std::uint64_t bytes = 0;
  std::int64_t written_s = 0;  // last change, seconds since 1970
};

/// The existing files of the record `file`, in the order in which they were written.
std::vector<RecordPart> record_parts(const std::filesystem::path& file);

/// The name of the file that follows the existing ones: a number is never used again as long as a
/// later one exists.
std::filesystem::path next_part(const std::filesystem::path& file);

}  // namespace plumb::drivers::rt

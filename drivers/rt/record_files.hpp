// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace plumb::drivers::rt {

/// The files of a record that `given` names, in the order in which they were written.
///
/// A file is itself. A folder that plumb-rt runs stands for the record that its rt.toml names,
/// `record`; any other folder for all records and snapshots that lie in it. Files of one record
/// are ordered by their number, snapshots by their time.
/// Throws Failure (kInput): E-READ... if a file is missing, E-RT-REPLAY if a folder has no record.
std::vector<std::filesystem::path> record_files(const std::vector<std::string>& given,
                                                const std::filesystem::path& record);

/// Calls `take` for each whole line of a file, until it returns false. What stands behind the last
/// end of a line is the rest of a line that a killed program did not finish: its size is returned.
template <class Take>
std::size_t each_whole_line(std::istream& in, Take take) {
  std::string line;
  while (std::getline(in, line)) {
    if (in.eof()) return line.size();
    if (!take(line)) break;
  }
  return 0;
}

}  // namespace plumb::drivers::rt

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "program/digest.hpp"

namespace plumb::offline {

/// The lines of a file or pipe, a block at a time, so that a file need not fit into the memory.
class LineSource {
 public:
  static constexpr std::size_t kLongestLine = 1 << 20;  // bytes
  static constexpr std::size_t kBlock = 1 << 20;        // bytes of a block, or one line more

  /// Throws Failure (kInput, E-READ) if missing, a directory or unreadable.
  explicit LineSource(const std::filesystem::path& file);
  ~LineSource();
  LineSource(const LineSource&) = delete;
  LineSource& operator=(const LineSource&) = delete;

  /// The next whole lines; only the last of the file may lack its line break. False at the end.
  /// Throws Failure (kInput): E-READ, or E-CSV-LINE with the number of a line that is too long.
  bool next(std::string& block);

  /// Number of the first line of the last block, from 1 on.
  int first_line() const { return first_line_; }

  /// Of a regular file [bytes]; 0 of a pipe or device, which may never end.
  std::uintmax_t size() const { return size_; }

  /// Of all that was read.
  std::string sha256() { return digest_.text(); }

 private:
  bool read_more();
  void check_length(std::size_t old_size) const;

  std::filesystem::path file_;
  int fd_ = -1;
  std::uintmax_t size_ = 0;
  std::string rest_;  // read, not yet given
  bool ended_ = false;
  int first_line_ = 1;
  int next_line_ = 1;
  Digest digest_;
};

}  // namespace plumb::offline

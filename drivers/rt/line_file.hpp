// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace plumb::drivers::rt {

/// A new text file that is written line by line and always ends with a whole line, also when the
/// disk is full. A program that is killed while it writes may leave a part of its last line.
///
/// Slow, for a thread without real-time priority.
class LineFile {
 public:
  /// Creates the file; if it exists or cannot be created, error() tells why.
  explicit LineFile(std::filesystem::path file);
  ~LineFile();  // writes what is left; an empty file is removed
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;

  /// Whole lines. After a failure they are dropped.
  void add(const std::string& lines);
  void flush();

  /// Asks the system to begin to write its buffered pages to the disk, and does not wait for it, so
  /// that sync() never finds many of them.
  void begin_sync() noexcept;

  /// Waits until all of it has reached the disk.
  void sync();

  /// True if somebody removed the file while it is written.
  bool removed() const noexcept;

  int error() const noexcept { return error_; }  // errno of the first failure; 0: none
  std::uint64_t bytes() const noexcept { return end_ + text_.size(); }
  const std::filesystem::path& file() const noexcept { return file_; }

 private:
  std::filesystem::path file_;
  int fd_ = -1;
  int error_ = 0;
  std::string text_;          // not written yet
  std::uint64_t end_ = 0;     // bytes written to the file
  std::uint64_t length_ = 0;  // bytes up to the end of the last whole line
};

}  // namespace plumb::drivers::rt

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "plumb/drivers/can_codec.hpp"
#include "plumb/drivers/record_ring.hpp"

namespace plumb::drivers::rt {

/// Writes what the cycle did as candump would, outside the cycle's thread.
///
/// When the disk says no (full, gone), or the record would grow beyond its limit, it ends there,
/// for good: failure() says why, the last line that is whole stays whole, and the cycle never
/// notices.
class RecordWriter {
 public:
  /// An existing file is kept: the new one gets a number behind its name. `most_mb`: 0: no limit.
  /// Throws Failure (kEnvironment, E-RT-RECORD) if it cannot be made.
  RecordWriter(const std::filesystem::path& file, const BusLayout& layout, std::string bus,
               int most_mb);
  /// Throws as the constructor would, and makes no file.
  static void check(const std::filesystem::path& file);
  ~RecordWriter();
  RecordWriter(const RecordWriter&) = delete;
  RecordWriter& operator=(const RecordWriter&) = delete;

  void add(const RecordEntry& entry);
  void note_lost(std::uint64_t lost);  // entries that the ring had no room for, so far
  void flush();

  const std::string& failure() const noexcept { return failure_; }  // empty: none
  const std::filesystem::path& file() const noexcept { return file_; }

 private:
  void add_line(const std::string& interface, const CanFrame& frame);
  bool fits(std::size_t bytes) const noexcept;

  std::filesystem::path file_;
  int fd_ = -1;
  CanCodec codec_;
  std::string bus_;
  int most_mb_;
  std::string text_;  // not written yet
  std::uint64_t lost_ = 0;
  std::int64_t last_ns_ = 0;
  std::uint64_t end_ = 0;     // of the file
  std::uint64_t length_ = 0;  // of its whole lines
  std::string failure_;
};

}  // namespace plumb::drivers::rt

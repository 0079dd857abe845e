// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "plumb/drivers/can_codec.hpp"
#include "plumb/drivers/record_ring.hpp"

namespace plumb::drivers::rt {

/// Writes what the cycle received and sent in candump's format, outside the cycle's thread.
///
/// If a write fails (disk full or removed) or the record would exceed its size limit, the record
/// ends for good after its last whole line. failure() tells why; the cycle is not affected.
class RecordWriter {
 public:
  /// An existing file is kept: the new one gets a number after its name. most_mb: size limit
  /// [1e6 bytes]; 0: none. Throws Failure (kEnvironment, E-RT-RECORD) if it cannot be created.
  RecordWriter(const std::filesystem::path& file, const BusLayout& layout, std::string bus,
               int most_mb);
  /// Throws what the constructor would throw, without creating a file.
  static void check(const std::filesystem::path& file);
  ~RecordWriter();
  RecordWriter(const RecordWriter&) = delete;
  RecordWriter& operator=(const RecordWriter&) = delete;

  void begin(const SessionStart& start);  // the first line; not needed if nothing was left
  void add(const RecordEntry& entry);
  void note_lost(std::uint64_t lost);  // entries lost so far because the ring was full
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
  std::uint64_t end_ = 0;     // bytes written to the file
  std::uint64_t length_ = 0;  // bytes up to the end of the last whole line
  std::string failure_;
};

}  // namespace plumb::drivers::rt

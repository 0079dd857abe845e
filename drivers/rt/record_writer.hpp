// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "rt/line_file.hpp"
#include "rt/record_disk.hpp"
#include "rt/record_settings.hpp"

namespace plumb::drivers::rt {

/// Writes the record of a run into a row of files, FILE, FILE.1, FILE.2 and so on, and removes the
/// oldest of them when all would exceed their size or age, or the disk runs full.
///
/// Every file begins where a replay can begin: at the start of a run or with a copy of the session.
/// The writer therefore asks for such a beginning when the next file is due, and goes on with the
/// present one until it comes.
///
/// What cannot be written (disk full, less than the floor free, folder gone or not writable) makes
/// a pause, and failure() tells why. It is tried again every second, later every minute if the
/// trouble comes back at once; what came meanwhile is missing from the record. The cycle is not
/// affected. Existing files are never written to.
///
/// Slow, for a thread without real-time priority.
class RecordWriter {
 public:
  RecordWriter(const RecordSettings& settings, RecordDisk disk);
  ~RecordWriter();
  RecordWriter(const RecordWriter&) = delete;
  RecordWriter& operator=(const RecordWriter&) = delete;

  /// Throws Failure (kEnvironment, E-RT-RECORD) if a record could not even be made if the disk had
  /// space: there is no such folder, or it may not be written to. Creates nothing.
  static void check(const std::filesystem::path& file);

  /// Lines from which a replay can begin. If the next file is due, they are its first.
  void begin(const std::string& lines, std::int64_t now_ns);

  /// Lines that follow what was written before; dropped during a pause.
  void add(const std::string& lines);

  /// True if begin() is wanted: a file is full, or a pause may end.
  bool wants_beginning() const noexcept;

  /// To be called often. Writes what came, removes what is too old, looks after the disk.
  void tend(std::int64_t now_ns);

  /// Ends the record of the run: all of it has then reached the disk, if the disk can.
  void close();

  const std::string& failure() const noexcept { return failure_; }      // empty: it is written
  const std::filesystem::path& file() const noexcept { return name_; }  // the present or last one
  std::size_t files() const noexcept { return files_; }                 // at the last look
  std::uint64_t bytes() const noexcept { return bytes_; }

 private:
  void open(std::int64_t now_ns);
  void pause(const std::string& why, std::int64_t now_ns);
  void pause_on_error(std::int64_t now_ns);
  bool is_open(const RecordPart& part) const;
  bool has_space();
  std::string full_text(const std::filesystem::path& folder, std::uint64_t free) const;
  void remove_old(std::uint64_t coming);
  void look(std::int64_t now_ns);

  RecordSettings settings_;
  RecordDisk disk_;
  std::unique_ptr<LineFile> out_;  // none: before the first beginning, and during a pause
  std::filesystem::path name_;
  std::int64_t opened_s_ = 0;   // wall time
  std::int64_t opened_ns_ = 0;  // monotonic
  std::int64_t looked_ns_ = 0;
  std::int64_t retry_ns_ = 0;
  std::int64_t patience_ns_ = 0;  // from a pause to the next attempt
  bool may_open_ = true;
  std::string failure_;
  std::size_t files_ = 0;
  std::uint64_t bytes_ = 0;
};

}  // namespace plumb::drivers::rt

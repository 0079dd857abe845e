// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "plumb/drivers/bus_layout.hpp"
#include "plumb/drivers/run_shared.hpp"
#include "program/json.hpp"
#include "rt/answer_file.hpp"
#include "rt/record_text.hpp"
#include "rt/record_writer.hpp"
#include "rt/snapshots.hpp"

namespace plumb::drivers::rt {

/// How record and snapshots stand, for the status.
struct RecordFacts {
  std::string file;     // the present or last one; empty: no record
  std::string failure;  // why there is a pause; empty: there is none
  std::uint64_t lost = 0;
  std::uint64_t files = 0, bytes = 0;
  std::string snapshot_folder;  // empty: no snapshots
  std::string snapshot;         // the last of this run; empty: none
  std::string snapshot_failure;
  std::uint64_t snapshots = 0;  // made in this run
};

/// An event for the journal.
struct RecordNotice {
  const char* event;
  Json details;
};

/// Takes what the cycle recorded and writes record, snapshots and the file of answers, on a thread
/// of its own, so that a slow disk holds up nothing else: neither the cycle nor status, watchdog
/// and control socket.
class Recorder {
 public:
  struct Files {
    RecordSettings record;
    std::filesystem::path snapshots;  // folder; empty: none
    std::filesystem::path answers;    // empty: none
  };

  /// Opens the file of answers and looks whether a record could be made; throws Failure
  /// (kEnvironment, E-RT-SINK, E-RT-RECORD). start: how the session begins.
  Recorder(const Files& files, const BusLayout& layout, const std::string& bus, RunShared& shared,
           const SessionStart& start, RecordDisk disk = real_disk());
  /// Throws what the constructor would throw, without creating a file.
  static void check(const Files& files);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  void start();

  /// Writes what is left, if it was started. Waits for the disk.
  void stop();

  /// One round of the thread; for tests, which do not start() it.
  void pass(std::int64_t now_ns);

  RecordFacts facts() const;
  std::vector<RecordNotice> take_notices();

 private:
  void take(const RecordEntry& entry, std::int64_t now_ns);
  void take_copy(const RecordEntry& entry, std::int64_t now_ns);
  void begin(const std::string& lines, std::int64_t now_ns);
  void add(const std::string& lines);
  void watch(const RecordEntry& step, std::int64_t now_ns);
  void note_gap(const RecordEntry& next);
  void ask(std::int64_t now_ns);
  void tell();

  RunShared& shared_;
  RecordText text_;
  std::unique_ptr<RecordWriter> record_;  // none: not asked for
  Snapshots snapshots_;
  std::unique_ptr<AnswerFile> answers_;
  bool answers_stopped_ = false;  // a line of them was lost, and that was said
  SessionStart session_;
  bool begun_ = false;
  bool asked_ = false;         // for a copy of the session that has not come yet
  bool gap_ = false;           // entries are missing since the last copy
  std::int64_t begun_ns_ = 0;  // when the last copy came
  std::uint64_t lost_ = 0;
  std::optional<SessionState> state_;  // after the last step; none: there was none yet

  mutable std::mutex mutex_;  // facts_, notices_
  RecordFacts facts_;
  std::vector<RecordNotice> notices_;

  std::atomic<bool> ended_{false};
  std::thread thread_;
};

}  // namespace plumb::drivers::rt

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "plumb/drivers/record_ring.hpp"
#include "rt/line_file.hpp"
#include "rt/record_settings.hpp"

namespace plumb::drivers::rt {

/// Why a snapshot is made after the step `now`, "fault-pose-mismatch" or "hold-target"; empty: none
/// is. `before`: the state after the step before.
///
/// Every FAULT has one. So has a HOLD that began because an input was lost that nobody switches off
/// on purpose: target, joints, controller, robot, comparison, motion, arm-away, arm-still, stall,
/// restart, answers.
/// Its cause lies in the seconds before, and the input may be back before somebody looks. A HOLD by
/// drives, manual, stop, disabled, tool, frame or payload, by the mode or by the end of the run is
/// an operator's doing, and the journal says all about it.
std::string snapshot_reason(SessionState before, const RecordEntry& now);

/// Keeps the last seconds of the record in memory and writes them, with the seconds that follow,
/// to a file of their own when something happens. These files are not part of the rotation of the
/// record; the newest `snapshots` of faults are kept, and as many of holds, so that frequent holds
/// never remove a fault.
///
/// A file is named by wall time and reason: 20261125T093012.123Z-fault-pose-mismatch.log.
///
/// Slow, for a thread without real-time priority. Memory: the text of before_s, and of the time
/// between two copies of the session.
class Snapshots {
 public:
  /// folder: is created with the first snapshot; empty: none are made.
  Snapshots(const RecordSettings& settings, std::filesystem::path folder);
  ~Snapshots();

  bool on() const noexcept { return settings_.snapshots > 0 && !folder_.empty(); }
  const std::filesystem::path& folder() const noexcept { return folder_; }  // if on()

  /// Lines from which a replay can begin.
  void begin(const std::string& lines, std::int64_t now_ns);

  /// Lines that follow.
  void add(const std::string& lines);

  /// Writes the last seconds, and goes on until after_s have passed. While a snapshot for the same
  /// reason is being written, that one is made longer instead, to a minute at most. `wall_ms`:
  /// since 1970. Returns the new file; empty if there is none.
  std::filesystem::path make(const std::string& reason, std::int64_t now_ns, std::int64_t wall_ms);

  /// To be called often: ends what is complete.
  void tend(std::int64_t now_ns);
  void close();

  const std::string& failure() const noexcept { return failure_; }  // of the last one; empty: none
  const std::filesystem::path& last() const noexcept { return last_; }
  std::uint64_t made() const noexcept { return made_; }

 private:
  struct Stretch {
    std::int64_t begun_ns;
    std::string text;
  };
  struct Open {
    std::unique_ptr<LineFile> file;
    std::string reason;
    std::int64_t begun_ns, end_ns;
  };

  void note_error(const LineFile& file);
  void remove_oldest(const std::string& kind) const;

  RecordSettings settings_;
  std::filesystem::path folder_;
  std::deque<Stretch> kept_;
  std::vector<Open> open_;
  std::string failure_;
  std::filesystem::path last_;
  std::uint64_t made_ = 0;
};

/// Where the snapshots of a folder stand: beside its journal; empty if that has no file.
std::filesystem::path snapshot_folder(const std::filesystem::path& journal);

/// True for a name that Snapshots gives.
bool is_snapshot(const std::string& name);

}  // namespace plumb::drivers::rt

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "plumb/drivers/event_ring.hpp"
#include "program/json.hpp"

namespace plumb::drivers::rt {

/// The event journal of a run: every change of state, fault with its cause, lost input, refusal,
/// swap, start and end, with wall time and monotonic time. Each event is a line of JSON in a file
/// of bounded size and a short line on stderr, which systemd passes to journald.
///
/// When the file would exceed kMostBytes, it is renamed to NAME.1, whose content before is lost; so
/// at most twice as many bytes are kept. Of each kind of event kMostPerMinute are written in a
/// minute, which begins with the first; the others are counted, and at its end "left-out" says how
/// many. "state" and "fault" are always written. What led to a fault is copied to NAME.fault, so
/// that whatever follows cannot push it out: the last kMostOfFault bytes, unless an earlier fault's
/// were copied in the last ten minutes.
///
/// Nobody who reads stderr, or has stopped reading it, can hold the journal up. While the file
/// cannot be written the lines on stderr go on. Where a killed program left a part of a line, the
/// next event begins on a line of its own.
///
/// Thread: one, without real-time priority. System calls: yes.
class Journal {
 public:
  static constexpr std::uint64_t kMostBytes = 1'000'000;
  static constexpr std::uint64_t kMostOfFault = 200'000;
  static constexpr int kMostPerMinute = 20;

  enum class Echo { kStderr, kNone };

  /// file: is appended to; empty: no file.
  explicit Journal(std::filesystem::path file, Echo echo = Echo::kStderr);

  /// Writes an event now. `details` is an object; its keys follow time, monotonic_s and event.
  void note(const char* event, const Json& details);

  /// Writes what has changed since the moment before: events "state", "fault", "lost", "model",
  /// "link", "refused" (the inverse refuses a target) and "solved" (it does so no more). The first
  /// moment is compared with a session that has not begun.
  void note_change(const SessionMoment& now);

  /// Says what was left out in minutes that are over.
  void tend(std::int64_t monotonic_ns);

  const std::filesystem::path& file() const noexcept { return file_; }
  const std::string& failure() const noexcept { return failure_; }  // of the file; empty: none

 private:
  void write(std::int64_t monotonic_ns, const char* event, const Json& details);
  bool room(std::int64_t monotonic_ns, const char* event);
  void append(const std::string& line);
  void keep_what_led_to_fault(std::int64_t monotonic_ns);

  /// Events of one kind in the minute that began with the first of them.
  struct Minute {
    std::int64_t begin_ns = 0;
    int written = 0;
    std::uint64_t left_out = 0;
  };

  std::filesystem::path file_;
  Echo echo_;
  std::string failure_;
  SessionMoment before_;
  std::map<std::string, Minute> minutes_;  // by kind of event
  std::optional<std::int64_t> fault_ns_;   // when NAME.fault was written
};

/// Where the journal of a folder stands: `configured` if it is not empty, else events.jsonl in the
/// folder if that may be written, else in $STATE_DIRECTORY, which systemd provides. Empty if there
/// is no such place.
std::filesystem::path journal_file(const std::filesystem::path& folder,
                                   const std::filesystem::path& configured);

/// Where journal_file() may have put the journal of a folder, best first: in the folder, in
/// $STATE_DIRECTORY, and in /var/lib/plumb-rt/NAME, the state directory of the systemd unit.
std::vector<std::filesystem::path> journal_places(const std::filesystem::path& folder);

struct ReadEvents {
  std::vector<Json> events;   // oldest first
  std::uint64_t damaged = 0;  // lines that are no event
};

/// The events of a journal, those of NAME.fault and NAME.1 included, at most `most` of them, the
/// newest. A line that is no event is left out and counted; the last line of a program that was
/// killed while it wrote may be one. Of a longer file than a journal can be only the end is read.
ReadEvents read_events(const std::filesystem::path& file, std::size_t most);

/// "2026-11-25 03:50:46.123  fault  pose-mismatch" for people.
std::string event_text(const Json& event);

}  // namespace plumb::drivers::rt

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "program/json.hpp"
#include "rt/place.hpp"

namespace plumb::drivers::rt {

/// One line of installs.jsonl. It is written before `current` is changed, so a line whose version
/// did not become current was cut off; the next install or rollback then adds "refused" to say so.
struct HistoryLine {
  std::string time;      // UTC
  std::string what;      // "install", "rollback", or "refused": the line before did not take effect
  std::string version;   // that was to become current
  std::string previous;  // that was current; empty: none
  std::string by;        // user who did it
  std::string host;      // and the machine on which
  std::string key;       // that signed it, by its name here; empty: none that is trusted
  std::string key_id;    // of the key that the signature names; empty: unsigned
  std::string made;      // when plumb deploy made it; empty: not known
  std::string from;      // the folder that it came from, of an install
  std::string how;       // "swapped", "at-restart", "stopped"; of "refused": why
  std::int64_t model = 0;  // number of the model on the bus
};

/// {time, what, version, previous, by, host, key, key_id, made, from, how, model}
Json to_json(const HistoryLine& line);

/// Reads what took effect in a place.
struct History {
  std::vector<HistoryLine> lines;  // oldest first, without those that did not take effect
  std::vector<std::string> path;   // versions on the way to the current one, which is the last
  std::string newest_made;         // of all that was installed; empty: none says when
  std::string cut_off;             // version of a last line that did not take effect; else empty
  std::uint64_t damaged = 0;       // lines that are none, as a killed program may leave one

  /// The line by which this version became current last; null if there is none.
  const HistoryLine* last_of(const std::string& version) const;

  /// The version before the current one; empty: there is none.
  std::string previous() const { return path.size() < 2 ? "" : path[path.size() - 2]; }
};

/// `current`: the version that is current, or empty. A file that is missing is an empty history.
/// Of a file of more than 16 MB only the end is read. Slow.
History read_history(const InstallPlace& place, const std::string& current);

/// Appends a line and waits for the disk. Throws Failure (kEnvironment, E-WRITE).
void append_history(const InstallPlace& place, const HistoryLine& line);

/// A line with time, user and host of now; of a user who became root by sudo also who that was.
HistoryLine history_line(std::string what, std::string version, std::string previous);

/// The name of a user, else his number.
std::string user_name(unsigned uid);

}  // namespace plumb::drivers::rt

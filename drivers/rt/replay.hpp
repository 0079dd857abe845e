// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rt/deployment.hpp"

namespace plumb::drivers::rt {

/// Comparison of a record with what the session computes now from the same input.
struct Replayed {
  std::uint64_t files = 0;
  std::uint64_t lines = 0;
  std::uint64_t unreadable = 0;
  std::uint64_t torn = 0;        // files that end in the middle of a line
  std::uint64_t gaps = 0;        // places where the record says that it lacks entries
  std::uint64_t beginnings = 0;  // of runs, and after gaps, pauses and removed files
  std::uint64_t unchecked = 0;   // cycles between a gap and the next beginning
  std::uint64_t cycles = 0;
  std::uint64_t messages = 0;  // received messages in the record
  std::uint64_t frames = 0;    // frames that the session sent now
  std::uint64_t different = 0;
  std::string first_difference;                // file, line number, recorded frame, frame sent now
  std::uint64_t swaps = 0;                     // changes to another model
  std::optional<std::uint32_t> unknown_model;  // number of the model that ended the replay
  bool foreign = false;  // a copy of the session by another version of plumb-rt was passed over
  SessionReport report;

  bool same() const {
    return different == 0 && unchecked == 0 && unreadable == 0 && !unknown_model;
  }
};

/// Runs a record's input through the session of the deployment, offline, and compares its output
/// with the record frame by frame. Where the record changes to another model, the session does so
/// in the same cycle; the model is found by its number, among that of the deployment and `others`.
/// The replay ends at a model that is not among them.
///
/// `files` are played one after the other, in this order. A session begins at the start of a run,
/// and with a copy of a session where the record does not go on from what was played before:
/// because older files were removed, the record paused, or entries are missing. A copy has the
/// settings of its run with it. What a killed program left of its last line is passed over.
///
/// Deterministic. Throws Failure (kInput, E-RT-REPLAY) if the files hold no cycle that can be
/// played.
Replayed replay(const std::vector<std::filesystem::path>& files, const Deployment& deployment,
                const std::vector<RunningModel>& others);

}  // namespace plumb::drivers::rt

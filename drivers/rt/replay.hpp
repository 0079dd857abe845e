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
  std::uint64_t lines = 0;
  std::uint64_t unreadable = 0;
  std::uint64_t gaps = 0;
  std::uint64_t cycles = 0;
  std::uint64_t messages = 0;  // received messages in the record
  std::uint64_t frames = 0;    // frames that the session sent now
  std::uint64_t different = 0;
  std::string first_difference;                // line number, recorded frame, frame sent now
  std::uint64_t swaps = 0;                     // changes to another model
  std::optional<std::uint32_t> unknown_model;  // number of the model that ended the replay
  SessionReport report;

  bool same() const { return different == 0 && gaps == 0 && unreadable == 0 && !unknown_model; }
};

/// Runs a record's input through the session of the deployment, offline, and compares its output
/// with the record frame by frame. Where the record changes to another model, the session does so
/// in the same cycle; the model is found by its number, among that of the deployment and `others`.
/// The replay ends at a model that is not among them. Deterministic. Throws Failure (kInput,
/// E-RT-REPLAY) if the file holds no cycle.
Replayed replay(const std::filesystem::path& record, const Deployment& deployment,
                const std::vector<RunningModel>& others);

}  // namespace plumb::drivers::rt

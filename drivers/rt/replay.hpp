// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rt/deployment.hpp"

namespace plumb::drivers::rt {

/// What a record said and what the same session makes of it now.
struct Replayed {
  std::uint64_t lines = 0;
  std::uint64_t unreadable = 0;
  std::uint64_t gaps = 0;
  std::uint64_t cycles = 0;
  std::uint64_t messages = 0;  // received
  std::uint64_t frames = 0;    // that the session said now
  std::uint64_t different = 0;
  std::string first_difference;                // of line N: what was recorded, what is said now
  std::uint64_t swaps = 0;                     // to another model
  std::optional<std::uint32_t> unknown_model;  // number of one that the record goes on with
  SessionReport report;

  bool same() const { return different == 0 && gaps == 0 && unreadable == 0 && !unknown_model; }
};

/// Runs a record's input through the session of the deployment, offline, and compares frame by
/// frame what it says with what was recorded. Where the record goes on with another model, so does
/// the session, in the same cycle: with that of the deployment or one of `others`, by their
/// numbers; it ends at one that is neither. Deterministic. Throws Failure (kInput, E-RT-REPLAY) if
/// the file holds no cycle.
Replayed replay(const std::filesystem::path& record, const Deployment& deployment,
                const std::vector<RunningModel>& others);

}  // namespace plumb::drivers::rt

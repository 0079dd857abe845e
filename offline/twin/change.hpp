// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include "simulate/simulate.hpp"

namespace plumb::offline::twin {

/// What has happened to an arm since it was calibrated.
struct Change {
  enum class Of { kEncoder, kStiffness, kTool, kBase } of = Of::kEncoder;
  int joint = 0;      // of encoder and stiffness
  double size = 0.0;  // of the encoder: offset [rad]; of the stiffness: relative change
  std::array<double, 3> shift_m{};  // of the tool in its frame, of the base in the base frame
};

/// Reads "encoder:J2=120urad", "stiffness:J3=-15%", "tool=0.2mm" or "base=0.3,0,-0.1mm". A single
/// length is a shift by so much in a direction that `seed` decides. Throws Failure (kUsage).
Change parse_change(const std::string& text, const Cell& cell, std::uint64_t seed);

/// The truth of the arm after the change. `truth` states the places of tracker and reflector, as
/// truth_of does. Throws Failure (kUsage) if the arm has no stiffness that could change.
void apply(const Change& change, const Cell& cell, HiddenTruth& truth);

}  // namespace plumb::offline::twin

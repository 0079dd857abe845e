// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "arm/known_inputs.hpp"
#include "cell/targets.hpp"
#include "plumb/runtime/single_poses.hpp"

namespace plumb::offline::cli {

/// What to command for one target.
struct CorrectedRow {
  Transformd X_BD;       // the target; without a quaternion it has the orientation at its seed
  format::Pose command;  // base frame; the target itself where refused
  Correction correction;
  double moved_m = 0.0;  // of a correction that was not refused
  double moved_rad = 0.0;
  bool limited = false;  // cut to the largest size that the guard lets through
  bool faded = false;    // so far outside what was fitted that nothing of the correction is left
};

/// Corrects target `row` from `seed` [rad] or [m], cut to the guard's size. `sensors` are the
/// temperatures the model reads; `inputs` records what is solved. May be called by any thread, with
/// `inputs` of its own.
CorrectedRow corrected_row(const SinglePoses& poses, const Targets& targets, int row,
                           std::span<const double> seed, SeedKind kind,
                           const std::vector<std::string>& sensors, KnownInputs& inputs);

}  // namespace plumb::offline::cli

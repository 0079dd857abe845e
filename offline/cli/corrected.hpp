// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cell/targets.hpp"
#include "plumb/runtime/corrector.hpp"

namespace plumb::offline::cli {

/// What to command for a list of targets; row i of each.
struct Corrected {
  std::vector<format::Pose> command;  // base frame; the target itself where refused
  std::vector<Status> status;
  double largest_m = 0.0;  // of the corrections that were not refused
  double largest_rad = 0.0;
};

/// Each target is solved from its own joint state, or else from the last solution, `start` [rad] or
/// [m] being the first; `sensors` are the temperatures the model reads. A target without quaternion
/// has the nominal orientation at its seed.
Corrected correct_targets(const Corrector& corrector, const Targets& targets,
                          const std::vector<double>& start,
                          const std::vector<std::string>& sensors = {});

}  // namespace plumb::offline::cli

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "fit/arm_state.hpp"
#include "fit/outliers.hpp"

namespace plumb::offline {

/// Neighbouring readings that all lie off by one and the same vector. Seen from the tool, that is a
/// reflector which sat in another place; seen from the base, a tracker or base which stood there.
struct DisplacedRun {
  int first = 0, last = 0;  // rows of the measurements, both included
  Vector3 by;               // mean error [m], in the tool frame or the measurement frame
  bool of_tool = true;
};

/// The runs of at least three of these outliers. `state`: the arm as fitted without them. Cost: one
/// prediction per outlier.
std::vector<DisplacedRun> displaced_runs(const ArmState& state, const MeasurementFiles& measured,
                                         const std::vector<Outlier>& outliers);

/// "lines 40 to 47 are all off by some (12.1, -3.0, 39.4) mm, seen from the tool: the reflector
/// probably sat in another place".
std::string in_words(const MeasurementFiles& measured, const DisplacedRun& run);

}  // namespace plumb::offline

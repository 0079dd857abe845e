// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "arm/arm_state.hpp"
#include "plumb/runtime/transform.hpp"
#include "solve/outlier.hpp"

namespace plumb::offline {

/// Neighbouring readings with one common error vector. If it is constant in the tool frame, the
/// reflector sat in another place; if in the measurement frame, the tracker or the base stood in
/// another place.
struct DisplacedRun {
  int first = 0, last = 0;  // rows of the measurements, both included
  Vector3 by;               // mean of measured - predicted [m], in the frame that `of_tool` says
  bool of_tool = true;      // tool frame; false: measurement frame
};

/// The runs of at least three of these outliers; one row in between may be missing. `state`: the
/// arm as fitted without the outliers. Cost: one prediction per outlier.
std::vector<DisplacedRun> displaced_runs(const ArmState& state, const MeasurementFiles& measured,
                                         const std::vector<Outlier>& outliers);

/// "lines 40 to 47 are all off by some (12.1, -3.0, 39.4) mm, seen from the tool: the reflector
/// probably sat in another place".
std::string in_words(const MeasurementFiles& measured, const DisplacedRun& run);

}  // namespace plumb::offline

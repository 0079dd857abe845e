// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "arm/arm_state.hpp"
#include "study/planar_poses.hpp"

/// The planar arm as an ordinary cell, so that the missing physics can be fitted instead of a tree.
namespace plumb::offline::study {

struct PlanarMeasuring {
  PlanarVariant variant = PlanarVariant::kPublished;
  RowsN q;               // (n, 2)
  double noise_m = 0.0;  // 1 sigma per axis
  std::uint64_t seed = 1;
};

/// The cell and the measurements that `plumb study planar --write-cell` writes.
struct PlanarCell {
  Cell cell;
  MeasurementFiles measured;
  std::string csv, truth_json;
};
PlanarCell measured_cell(const PlanarMeasuring& measuring);

/// The calibration with the bending of both links, by the law that is also evaluated in the cycle.
ArmState with_link_flexure(const PlanarCell& planar);

/// The result of `plumb diagnose --apply`.
struct PlanarDiagnosis {
  ArmState state;
  std::string verdict;  // at the end, in words
  std::string added;    // "link_flexure J1, J2", or "nothing"
};
PlanarDiagnosis diagnosed(const PlanarCell& planar);

/// Point C as the state predicts it, in the frame of point A. Shape (n, 2) [m].
Samples points(const ArmState& state, const RowsN& q);

}  // namespace plumb::offline::study

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "arm/arm_state.hpp"
#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "noise/noise_floor.hpp"

namespace plumb::offline {

/// Joint readings that were rounded: all of them are multiples of one power of ten of their unit.
struct Rounding {
  double step = 0.0;        // [rad] or [m], the coarsest of all joints
  std::string unit;         // of that column
  double step_in_unit = 0;  // 0.01
  double at_tool_m = 0.0;   // RMS 3-D error at the reflector if every reading is off by up to half
};

/// Nothing if the files do not say how they were written. A uniform error of +-step/2 has sigma =
/// step / sqrt(12); at the tool it is sqrt(sum_j |J_j|^2) of that, RMS over the poses.
std::optional<Rounding> joint_rounding(const Cell& cell, const MeasurementFiles& measured,
                                       const std::vector<int>& rows, const ArmState& placed);

/// Rounded joint readings that are no longer small beside the noise (W-CHECK-ROUNDED). left_m: RMS
/// error [m] that the fit leaves, if there was one. Rounded readings leave at least about their own
/// error: if less is left, the arm was commanded to round values. If the noise is unknown, the two
/// must be of similar size.
std::vector<Problem> rounding_findings(const Rounding& rounding, const NoiseFloor& floor,
                                       std::optional<double> left_m);

/// The steps of the measured x, y, z [m], the coarsest of all files: all values are multiples of 1,
/// 2, 2.5 or 5 times a power of ten of their unit. 0 where there is none, or too few values to
/// tell.
std::array<double, 3> point_steps(const MeasurementFiles& measured);

/// Measured coordinates that were rounded (W-CHECK-COARSE, once a file): a uniform error of
/// +-step/2, whose sigma is step / sqrt(12), is no longer small beside the noise.
std::vector<Problem> coarse_points(const MeasurementFiles& measured, const NoiseFloor& floor);

}  // namespace plumb::offline

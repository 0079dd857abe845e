// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "check/convention_search.hpp"
#include "fit/calibration.hpp"

namespace plumb::offline {

/// The lengths of the fitted arm are all longer, or all shorter, than the nominal ones by one
/// factor (W-CHECK-SCALE). Said only if the two longest lengths ask for the same factor, the others
/// do not contradict, and it is far beyond its own standard deviation (12.5 times it with five
/// lengths, 8 with eleven), which is taken from how far the fitted lengths scatter about it: an arm
/// built to 0.3 mm hides 3000 ppm, one built to 0.03 mm hides 300 ppm.
std::vector<Problem> scale_findings(const Measurements& measured, const std::vector<int>& rows,
                                    const Calibration& fitted);

struct GrossScale {
  Problem finding;
  bool is_unit = false;  // a unit of length explains the factor
};

/// For files that no interpretation fits: the factor that all measured points would have to be
/// multiplied by so that the nominal arm fits them (W-CHECK-SCALE), with the unit that would do so
/// if there is one. Nothing if they would not fit then either. The rows: those that are used.
std::optional<GrossScale> gross_scale(const Cell& cell, const Measurements& measured,
                                      const std::vector<int>& rows, const Detection& detection);

}  // namespace plumb::offline

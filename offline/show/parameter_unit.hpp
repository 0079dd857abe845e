// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "fit/calibration.hpp"

namespace plumb::offline::show {

/// How a parameter is shown: lengths of the arm in mm and its angles in deg, those of effects in um
/// and urad, everything else in SI.
struct ParameterUnit {
  std::string name;
  double per_si = 1.0;
  bool plain = true;  // shown with four decimals, else with four digits

  std::string text(double si) const;
};

ParameterUnit unit_of(const Estimate& parameter);

}  // namespace plumb::offline::show

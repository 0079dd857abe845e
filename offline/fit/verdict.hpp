// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "fit/fit.hpp"

namespace plumb::offline {

/// "Is my calibration good?" in one sentence. Good is what is within tolerance at 95 % of the
/// held-out poses and nowhere three times beyond it.
std::string verdict(const Fit& fit, double tolerance_m);

/// Whether these held-out figures keep a tolerance.
bool keeps(const ErrorStats& held, double tolerance_m);

}  // namespace plumb::offline

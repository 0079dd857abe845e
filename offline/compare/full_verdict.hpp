// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "fit/fit.hpp"

namespace plumb::offline::compare {

/// The verdict on a fit of these readings, as every screen shows it. If it says that something is
/// missing and no joint's own angle explains a clear part of the error, it adds the scatter of the
/// joints that would also explain the error; only a diagnosis can tell which it is. Cost: one
/// linear model of the readings; less than a tenth of a second at 1,500 poses.
std::string full_verdict(const Cell& cell, const Measurements& measured, const Fit& fit);

}  // namespace plumb::offline::compare

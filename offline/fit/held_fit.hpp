// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "fit/calibration.hpp"
#include "solve/fit_data.hpp"

namespace plumb::offline {

/// Which numbers of the arm a fit holds near nominal: those that the poses hardly show; or all,
/// where the fit is lost otherwise.
enum class HeldNear { kWeakDirections, kAllDirections };

/// A calibration made in one of these ways.
using HeldFit = std::function<Calibration(HeldNear)>;

/// The calibration of `fit` with its weak directions held; if it is lost, or a series of waves ends
/// far from nominal, made once more with all numbers held, which counts if it explains the readings
/// of `data` as well. Throws what the first one threw if both are lost (E-FIT-CONVERGE, E-FIT-FAR).
Calibration held_if_it_wanders(const FitData& data, const HeldFit& fit);

/// The same for a fit near another one: made once more only if it throws E-FIT-CONVERGE or
/// E-FIT-FAR, and what that throws is thrown.
Calibration held_if_it_is_lost(const HeldFit& fit);

}  // namespace plumb::offline

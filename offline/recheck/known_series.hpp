// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "recheck/evidence.hpp"

namespace plumb::offline::recheck {

/// What a run knows of its numbers, and behind them of the amplitudes of its series of waves, which
/// a run does not list. Where the calibration had no pose, an amplitude is known by its prior
/// alone, so a reading there is expected less exactly. For given numbers the amplitudes follow by
/// linear least squares from the run's own readings and their prior; with these conditional means
/// and covariances the covariance of both together is that of the numbers, propagated.
///
/// @param known       In the set-up of the new readings.
/// @param state       In that set-up alone.
/// @param calibrated  The run that was fitted to `own`.
/// @param sigma_m     1 sigma of a coordinate of its readings, as expected_sigma.
/// Cost: as one step of its fit; nothing for a model without series.
KnownNumbers with_series(KnownNumbers known, const ArmState& state, const Run& calibrated,
                         const Measurements& own, double sigma_m);

}  // namespace plumb::offline::recheck

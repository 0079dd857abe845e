// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "fit/fit.hpp"
#include "fit/mean_interval.hpp"
#include "show/block.hpp"
#include "show/json.hpp"
#include "show/table.hpp"

namespace plumb::offline::show {

/// How the held-out poses were chosen, for below a table: "held-out: 5 folds, ..."; nothing without
/// folds.
Blocks folds_note(int folds, int readings);

/// Errors of the measured positions [mm]: before and after on the held-out readings, on the fitted
/// ones, and the noise floor; a note on the folds, and the errors of fitted orientations [deg].
Blocks error_blocks(const Measurements& measured, const Fit& fit);

/// "0.141 .. 0.187"; empty if it is not known.
std::string text_of(const MeanInterval& interval);

/// mean_low_mm and mean_high_mm; null with reason if they are not known.
void add_interval(const MeanInterval& interval, Json& out);

/// held_out_orientation: in deg; null with reason if orientations are not fitted.
void add_turns(const Fit& fit, Json& out);

/// orientation: what the measured orientations are, `meant` their readings in words; nothing if
/// there are none.
void add_orientation(const MeasuredOrientations& judged, const std::vector<std::string>& meant,
                     Json& out);

/// noise_floor: {measured_mm, inferred_mm, source}; and the same as noise_floor_mm (mean) and
/// noise_floor_rms_mm, null with reason if nothing is known; inferred_floor_mm where a diagnosis
/// takes what is left for scatter of the joints.
void add_floor(const NoiseFloor& floor, Json& out);

}  // namespace plumb::offline::show

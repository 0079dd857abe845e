// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "fit/fit.hpp"
#include "fit/mean_interval.hpp"
#include "show/json.hpp"

namespace plumb::offline::show {

/// How the held-out poses were chosen, a line for below the table: "  held-out: 5 folds; ...".
/// Empty without folds.
std::string folds_text(int folds, int readings);

/// Before and after on the held-out poses, the fit poses, and the noise floor [mm]; of orientations
/// [deg], if they are fitted.
std::string error_table(const Measurements& measured, const Fit& fit);

/// The name of the row of the fitted readings, which says so if it counts outliers.
const char* fit_row_name(const Fit& fit);

/// "0.141 .. 0.187"; empty if it is not known.
std::string text_of(const MeanInterval& interval);

/// mean_low_mm and mean_high_mm; null with reason if they are not known.
void add_interval(const MeanInterval& interval, Json& out);

/// held_out_orientation: in deg; null with reason if orientations are not fitted.
void add_turns(const ErrorStats& turn_held, Json& out);

/// orientation: what the measured orientations are, `meant` their readings in words; nothing if
/// there are none.
void add_orientation(const MeasuredOrientations& judged, const std::vector<std::string>& meant,
                     Json& out);

/// Rows for below the errors: the noise floor with its source, and what is only inferred.
std::vector<std::vector<std::string>> floor_rows(const NoiseFloor& floor);

/// noise_floor_mm (mean) and noise_floor_rms_mm, null with reason if nothing is known;
/// inferred_floor_mm where a diagnosis takes what is left for scatter of the joints.
void add_floor(const NoiseFloor& floor, Json& out);

}  // namespace plumb::offline::show

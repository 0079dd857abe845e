// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "noise/change_points.hpp"

namespace plumb::offline {

/// The largest share of the squared error that a jump can cause. The fit absorbs its mean: a jump
/// of size s after a share b of the rows leaves the mean square b (1 - b) s^2. rms_m: RMS error of
/// the fit [m]; rows: number of the rows in which the jump was found.
double share_of_error(const StepFound& step, double rms_m, double rows);

/// Whether chance makes such a jump less than once in a thousand.
bool is_clear(const StepFound& step);

/// Whether there is so much to explain. A jump that would cause more than the whole squared error
/// is none: the poses of one side hardly show that part, so that its size is a guess.
bool is_possible(double share);

/// Whether a possible jump with this share of the squared error counts as the cause of the error. A
/// smaller jump may be another missing effect that shows where the series comes to other poses.
bool is_cause(double share);

/// The jump with the largest share of the residual of `fitted` on these rows, among those that are
/// clear and a cause. Jumps of base or joint at a change of payload do not count. rows: numbers of
/// rows in `measured`, ascending, without outliers. The rows of the result are numbered like them.
/// Cost: 30 us a row.
std::optional<StepFound> main_jump(const ArmState& fitted, const Measurements& measured,
                                   const std::vector<int>& rows);

/// Where there are more rows, those who only want to know of a jump search so many, evenly spread.
inline constexpr int kRowsSearchedForJump = 1500;

/// How far the measured points jump, in mm: "0.29", "16", "156".
std::string size_in_mm(const StepFound& step);

}  // namespace plumb::offline

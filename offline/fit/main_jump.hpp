// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/change_points.hpp"

namespace plumb::offline {

/// Share of the squared error that a jump can cause at most, given the RMS error [m]: a fit takes
/// the mean of the jump away. `rows`: of the measurements, in which it happened.
double share_of_error(const StepFound& step, double rms_m, double rows);

/// Whether chance makes such a jump less than once in a thousand.
bool is_clear(const StepFound& step);

/// Whether a jump with such a share of the error is its cause. One with less may be what something
/// else that is missing looks like where the poses change.
bool is_cause(double share);

/// The jump that causes most of what `fitted` leaves on these rows: clear, and a cause. Nothing if
/// there is none, or if the payload changes at that moment. rows: of the measurements, ascending,
/// outliers left out; so are those of the answer. Cost: 30 us a row.
std::optional<StepFound> main_jump(const ArmState& fitted, const Measurements& measured,
                                   const std::vector<int>& rows);

/// How far the measured points jump, in mm: "0.29", "16", "156".
std::string size_in_mm(const StepFound& step);

}  // namespace plumb::offline

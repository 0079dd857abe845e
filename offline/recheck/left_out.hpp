// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "noise/error_stats.hpp"
#include "recheck/evidence.hpp"

namespace plumb::offline::recheck {

/// The lines of all readings as one row for each reading, shape (readings, 3), zero where an axis
/// is not measured.
Rows3 errors_of(const Readings& readings, const Eigen::VectorXd& lines);

/// Errors of the readings [m], shape (readings, 3), each predicted by a refit of `changes` without
/// it. The shift that was estimated for a single wrong reading is not taken off its error.
Rows3 left_out_errors(const Readings& readings, const std::vector<Change>& changes,
                      const Judged& judged);

/// Statistics of the errors of all rows but these.
ErrorStats stats_of(const Rows3& errors, const std::vector<int>& leave_out);

}  // namespace plumb::offline::recheck

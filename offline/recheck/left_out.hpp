// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "noise/error_stats.hpp"
#include "recheck/evidence.hpp"

namespace plumb::offline::recheck {

/// Lines (readings.lines()) as one row a reading, shape (readings, 3), zero where an axis is
/// missing.
Rows3 errors_of(const Readings& readings, const Eigen::VectorXd& lines);

/// Errors of the readings [m], shape (readings, 3), each predicted by a refit of `changes` without
/// it. A reading that was found to be off is judged as it is.
Rows3 left_out_errors(const Readings& readings, const std::vector<Change>& changes,
                      const Judged& judged);

/// Of all rows but these.
ErrorStats stats_of(const Rows3& errors, const std::vector<int>& leave_out);

}  // namespace plumb::offline::recheck

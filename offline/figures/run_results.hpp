// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "arm/parameter.hpp"
#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "runs/run.hpp"

namespace plumb::offline::figures {

/// What the figures of one run are drawn from. The cell, the measurements and the run must live
/// longer. Errors are measured - predicted, in the measurement frame [m], shape (all rows, 3).
struct RunResults {
  const Cell& cell;
  const Measurements& measured;
  const Run& run;
  Rows3 before_M;         // of the nominal arm, with only tracker frame and target fitted
  Rows3 after_M;          // of the run; where a pose was held out, by a model that never saw it
  std::vector<int> held;  // rows with a held-out error, ascending
  std::vector<int> fit;   // rows in use that have none
  std::vector<Run> rechecks = {};  // of this run, and of its rechecks, oldest first

  const std::string& pose(int row) const { return measured.pose[static_cast<std::size_t>(row)]; }
  double before(int row) const { return before_M.row(row).norm(); }
  double after(int row) const { return after_M.row(row).norm(); }

  /// Rows by which the model is judged: the held-out ones, or all if none was held out.
  const std::vector<int>& judged() const { return held.empty() ? fit : held; }
};

/// Those of the rows that no headline leaves out because they are listed as standing out.
std::vector<int> usual_rows(const RunResults& results, std::vector<int> rows);

/// Cost: one small fit of tracker frame and target; later runs are read. Throws as `place_nominal`.
/// `measured` must stand on the base of the run.
RunResults results_of(const Cell& cell, const Measurements& measured, const Run& run);

/// What each row of the covariance of the run is a number of; nothing for frame and target, which
/// are not of the arm. Empty for a run of another arm than the present cell.
std::vector<std::optional<Parameter>> fitted_parameters(const Run& run);

}  // namespace plumb::offline::figures

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "cell/measurements.hpp"

namespace plumb::offline {

/// Where the rows of another file belong in the series of the cell's own measurements, on which
/// drifts and steps depend. A row is placed by the first of these rules that applies:
///   as in the cell, if the file is bit for bit one of the cell's own;
///   by time, if both have time stamps of the same kind: t_s in both, or ISO times in both;
///   by the name of its pose (and its `repeat`), if the cell has a row of that name at the same
///   joint positions; the first of several repeats is matched with the first, and so on.
/// Times before the first or after the last row are set to that row's time, so that no drift is
/// extrapolated. Rows farther outside than a tenth of the series have no place in it. Rows without
/// a place are treated as if measured right after the cell's own last row: steps have happened, and
/// drifts have reached their last value. That is the best estimate for what is measured next.
class SeriesPlace {
 public:
  /// Keeps a reference to `own`.
  explicit SeriesPlace(const MeasurementFiles& own);

  /// Sets order and time of `rows`, which must be all rows of one or several files; for rows of the
  /// cell's own files also their last moves. Returns which of the rows have a place in the series.
  std::vector<bool> place(MeasurementFiles& rows) const;

 private:
  enum class Clock { kNone, kSeconds, kIso };
  static Clock clock_of(const std::vector<Table>& tables);
  static std::vector<std::string> names_of(const MeasurementFiles& rows);
  double order_at(double time_s) const;
  int named(const std::string& name, const MeasurementFiles& rows, int row, int times) const;

  const MeasurementFiles& own_;
  Clock clock_;
  double last_s_ = kUnknown;                            // time of the end of the series
  std::vector<std::pair<double, double>> by_time_;      // time [s] and order, sorted
  std::map<std::string, std::vector<int>> rows_named_;  // own rows
};

}  // namespace plumb::offline

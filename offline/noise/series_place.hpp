// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "cell/measurements.hpp"

namespace plumb::offline {

/// Where the rows of another file stand in the series of the cell's own measurements: what drift
/// and step depend on. A row is placed, in this order,
///   as in the cell, if the file is one of the cell's own, bit by bit;
///   by time, if both have time stamps of one clock: t_s in both, or ISO times in both;
///   by the name of its pose (and its `repeat`), if the cell has one of that name at its joints; of
///   repeats the first belongs to the first, and so on.
/// Before the first and after the last row time stands still: no drift is extrapolated, and rows
/// farther away than a tenth of the series have no place in it. Other rows are taken as if measured
/// right after the cell's own last one: what has moved stays moved, and a drift has come to its
/// end. That is the best guess for what is measured next.
class SeriesPlace {
 public:
  /// Keeps a reference to `own`.
  explicit SeriesPlace(const MeasurementFiles& own);

  /// Sets order and time of `rows`, all of one or several whole files; in one of the cell's own
  /// files the last moves too. Which of the rows have a place of their own.
  std::vector<bool> place(MeasurementFiles& rows) const;

 private:
  enum class Clock { kNone, kSeconds, kIso };
  static Clock clock_of(const std::vector<Table>& tables);
  static std::vector<std::string> names_of(const MeasurementFiles& rows);
  double order_at(double time_s) const;
  int named(const std::string& name, const MeasurementFiles& rows, int row, int times) const;

  const MeasurementFiles& own_;
  Clock clock_;
  double last_s_ = kUnknown;                            // the end of the series
  std::vector<std::pair<double, double>> by_time_;      // time [s] and order, sorted
  std::map<std::string, std::vector<int>> rows_named_;  // own rows
};

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "draw/panel.hpp"
#include "figures/run_results.hpp"
#include "figures/words.hpp"

namespace plumb::offline::figures {

/// Times the usual error: beyond it an axis of errors is logarithmic.
inline constexpr double kLogBeyond = 15.0;

/// The axis on which errors before and after are both seen: linear, or logarithmic if the largest
/// is more than 15 times the median after. It is made for the usual readings: those that stand out
/// may lie beyond its end.
struct ErrorAxis {
  LengthUnit unit;
  draw::Axis axis;
  bool is_log() const { return axis.scale == draw::Axis::Scale::kLog; }
  bool ends_before(double error_m) const { return error_m * unit.per_m > axis.high; }
  double of(double error_m) const;  // its end where it ends before; never below a logarithmic axis
};
ErrorAxis error_axis(const RunResults& results);

/// What a figure says of the readings beyond its axis: an entry of the legend with their number,
/// and a note that names the worst. `rows`: those that are drawn. Nothing if there are none.
void add_beyond(const RunResults& results, const ErrorAxis& axis, const std::vector<int>& rows,
                draw::SheetText& text);

/// An axis of mean errors between these: linear, or logarithmic if they differ by more than 15
/// times.
ErrorAxis mean_error_axis(double least_m, double most_m);

/// Lines of a panel for tolerance and noise floor, if they lie on the axis.
enum class Along { kX, kY };
void draw_limits(const RunResults& results, const ErrorAxis& axis, Along along, draw::Panel& panel);

}  // namespace plumb::offline::figures

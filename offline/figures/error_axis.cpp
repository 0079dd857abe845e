// SPDX-License-Identifier: Apache-2.0
#include "figures/error_axis.hpp"

#include <algorithm>
#include <cmath>

namespace plumb::offline::figures {
namespace {

constexpr double kSmallestShown_m = 1e-9;

}  // namespace

double ErrorAxis::of(double error_m) const {
  const double value = error_m * unit.per_m;
  return is_log() ? std::max(value, axis.low) : value;
}

ErrorAxis error_axis(const RunResults& results) {
  std::vector<int> rows = results.held;
  rows.insert(rows.end(), results.fit.begin(), results.fit.end());
  const auto before = sorted_errors(results, rows, Which::kBefore);
  const auto after = sorted_errors(results, rows, Which::kAfter);
  const double largest = std::max({quantile_of(before, 1.0), quantile_of(after, 1.0),
                                   results.cell.tolerance_m, results.run.fit.floor.mean_m});
  const double usual = quantile_of(after, 0.5);
  ErrorAxis out{.unit = unit_for(largest), .axis = {}};
  out.axis.title = "error [" + out.unit.name + "]";
  out.axis.high = largest * out.unit.per_m;
  if (usual > kSmallestShown_m && largest > kLogBeyond * usual) {
    out.axis.scale = draw::Axis::Scale::kLog;
    const double least = std::max(quantile_of(after, 0.02), 1e-3 * usual);
    const auto ticks = draw::log_ticks(least * out.unit.per_m, out.axis.high, draw::kMostTicks);
    out.axis.low = ticks.front().value;
    out.axis.high = ticks.back().value;
  }
  return out;
}

ErrorAxis mean_error_axis(double least_m, double most_m) {
  ErrorAxis out{.unit = unit_for(most_m), .axis = {}};
  out.axis.title = "mean error [" + out.unit.name + "]";
  out.axis.high = 1.1 * most_m * out.unit.per_m;
  if (most_m > kLogBeyond * least_m && least_m > 0.0) {  // a tracker at another station: metres
    out.axis.scale = draw::Axis::Scale::kLog;
    out.axis.low = 0.5 * least_m * out.unit.per_m;
  }
  return out;
}

void draw_limits(const RunResults& results, const ErrorAxis& axis, Along along,
                 draw::Panel& panel) {
  std::vector<draw::Panel::Level> levels;
  const auto level = [&](double value_m, const char* name, draw::Tone tone, const char* dashes) {
    levels.push_back({.at = value_m * axis.unit.per_m,
                      .words = std::string(name) + " " + length_text(value_m),
                      .style = {.paint = tone, .width = 1.4, .dashes = dashes}});
  };
  level(results.cell.tolerance_m, "tolerance", draw::Tone::kPurple, "6 3");
  if (results.run.fit.floor.mean_m > 0.0)
    level(results.run.fit.floor.mean_m, "noise floor", draw::Tone::kGreen, "2 2");
  if (along == Along::kX)
    panel.levels_x(levels);
  else
    panel.levels_y(levels);
}

}  // namespace plumb::offline::figures

// SPDX-License-Identifier: Apache-2.0
#include "figures/error_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "program/counted_words.hpp"

namespace plumb::offline::figures {
namespace {

constexpr double kSmallestShown_m = 1e-9;

}  // namespace

double ErrorAxis::of(double error_m) const {
  const double value = std::min(error_m * unit.per_m, axis.high);
  return is_log() ? std::max(value, axis.low) : value;
}

ErrorAxis error_axis(const RunResults& results) {
  std::vector<int> rows = results.held;
  rows.insert(rows.end(), results.fit.begin(), results.fit.end());
  rows = usual_rows(results, std::move(rows));
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
    out.axis.low = least * out.unit.per_m;
  }
  const auto ticks = (out.is_log() ? draw::log_ticks : draw::round_ticks)(
      out.axis.low, out.axis.high, draw::kMostTicks);
  out.axis.low = ticks.front().value;
  out.axis.high = ticks.back().value;
  out.axis.ends = draw::Axis::Ends::kExact;
  return out;
}

void add_beyond(const RunResults& results, const ErrorAxis& axis, const std::vector<int>& rows,
                draw::SheetText& text) {
  std::vector<int> beyond;
  for (const int row : rows)
    if (axis.ends_before(results.before(row)) || axis.ends_before(results.after(row)))
      beyond.push_back(row);
  if (beyond.empty()) return;
  std::stable_sort(beyond.begin(), beyond.end(),
                   [&](int a, int b) { return results.after(a) > results.after(b); });
  const auto n = static_cast<long long>(beyond.size());
  text.legend.push_back(
      {.words = std::to_string(n) + " beyond the axis",
       .mark = draw::Mark{.shape = draw::Shape::kTriangleRight, .paint = draw::Tone::kInk}});
  text.notes.push_back(
      fmt::format("{} and {} beyond the axis, drawn as {} at its edge: {}{}, {} after "
                  "calibration.",
                  counted_words(n, "reading stands out", "readings stand out"),
                  n == 1 ? "lies" : "lie", n == 1 ? "a triangle" : "triangles",
                  n == 1 ? "" : "the worst is ", pose_list(results, std::span(beyond).first(1), 1),
                  length_text(results.after(beyond.front()))));
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

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "compare/autocorrelation.hpp"
#include "draw/panel.hpp"
#include "draw/sheet.hpp"
#include "draw/text_width.hpp"
#include "figures/run_figures.hpp"
#include "figures/words.hpp"
#include "noise/change_points.hpp"

namespace plumb::offline::figures {
namespace {

using draw::Mark;
using draw::Tone;

constexpr int kMostVisits = 400;  // are drawn
constexpr int kWindows = 20;      // moving means along the series

struct InOrder {
  Series series;
  Changes changes;
  compare::Autocorrelation memory;
};

InOrder in_order(const RunResults& results) {
  std::vector<int> rows = results.held;
  rows.insert(rows.end(), results.fit.begin(), results.fit.end());
  std::sort(rows.begin(), rows.end());
  const Fit& fit = results.run.fit;
  rows = without_outliers(without_outliers(rows, fit.calibration.outliers), fit.held_outliers);
  InOrder out;
  if (rows.empty()) return out;
  out.series = series(results.measured, results.after_M, rows);
  out.changes = change_points(StepMotions(fit.calibration.state, results.measured, out.series));
  out.memory = compare::autocorrelation(out.series, results.measured.q);
  return out;
}

std::string part_text(const RunResults& results, MotionSource source, int joint) {
  if (source == MotionSource::kTool) return "the tool or reflector";
  if (source == MotionSource::kBase) return "the base or tracker";
  return results.cell.nominal.joints[static_cast<std::size_t>(joint)].name;
}

std::string order_sentence(const RunResults& results, const InOrder& all) {
  if (all.changes.visits == 0) return "These poses are too few to look for changes over time.";
  if (!all.changes.steps.empty()) {
    const StepFound* step = &all.changes.steps.front();
    for (const auto& other : all.changes.steps)
      if (other.size_m > step->size_m) step = &other;
    return fmt::format(
        "Something jumped: between poses {} and {} the points moved by {}, as if by "
        "{}{}.",
        results.pose(step->before), results.pose(step->after), length_text(step->size_m),
        part_text(results, step->source, step->joint),
        all.changes.steps.size() > 1 ? fmt::format("; {} jumps in all", all.changes.steps.size())
                                     : "");
  }
  if (!all.changes.drifts.empty()) {
    const DriftFound& drift = all.changes.drifts.front();
    return fmt::format(
        "Something drifts: from pose {} to pose {} the points moved by {}, as if by "
        "{}.",
        results.pose(drift.from), results.pose(drift.to), length_text(drift.size_m),
        part_text(results, drift.source, drift.joint));
  }
  if (all.memory.beyond())
    return fmt::format(
        "Nothing jumps or drifts, but successive residuals are alike (autocorrelation "
        "{:.2f}; chance gives {:.2f} to {:.2f}).",
        all.memory.lag1, all.memory.low95, all.memory.high95);
  return fmt::format(
      "Nothing jumps or drifts over {} visits: successive residuals are independent.",
      all.series.size());
}

int visit_of(const Series& series, int row) {
  const auto& first = series.first_row;
  return static_cast<int>(std::find(first.begin(), first.end(), row) - first.begin());
}

/// Mean of the residuals around each visit, over a twentieth of the series.
std::vector<draw::Point> moving_mean(const Series& series, int axis, double per_m) {
  std::vector<draw::Point> out;
  const int half = std::max(2, series.size() / (2 * kWindows));
  for (int i = 0; i < series.size(); i += std::max(1, half / 4)) {
    const int from = std::max(0, i - half), to = std::min(series.size(), i + half + 1);
    const double mean = series.error_M.col(axis).segment(from, to - from).mean();
    out.push_back({static_cast<double>(i + 1), per_m * mean});
  }
  return out;
}

void draw_axis(const RunResults& results, const InOrder& all, int axis, const LengthUnit& unit,
               const std::set<int>& held, draw::Panel& panel) {
  const Series& series = all.series;
  panel.line({{panel.x_low(), 0.0}, {panel.x_high(), 0.0}}, {.paint = Tone::kMuted});
  const double stride = std::max(1.0, static_cast<double>(series.size()) / kMostVisits);
  for (const bool is_held : {false, true})  // held-out poses on top
    for (double at = 0.0; at < series.size(); at += stride) {
      const int i = static_cast<int>(at), row = series.first_row[static_cast<std::size_t>(i)];
      if (held.contains(row) != is_held) continue;
      panel.mark(i + 1.0, unit.per_m * series.error_M(i, axis),
                 {.fill = is_held ? Mark::Fill::kFilled : Mark::Fill::kHollow,
                  .size = 2.2,
                  .pose = results.pose(row),
                  .words = pose_numbers(results, row)});
    }
  const auto mean = moving_mean(series, axis, unit.per_m);
  panel.line(mean, {.paint = Tone::kPaper, .width = 4.0});
  panel.line(mean, {.paint = Tone::kInk, .width = 2.0});
  std::vector<draw::Panel::Level> jumps;
  for (const auto& step : all.changes.steps)
    jumps.push_back({.at = visit_of(series, step.after) + 0.5,
                     .words = "jump: " + draw::shortened(results.pose(step.after), 11.0, 90.0),
                     .style = {.paint = Tone::kVermilion, .width = 1.5, .dashes = "6 3"}});
  panel.levels_x(jumps);
}

}  // namespace

std::string order_figure(const RunResults& results, double width) {
  const InOrder all = in_order(results);
  auto notes = error_notes(results);
  notes.emplace_back(
      "Residuals are drawn along the axes of the measurement frame; immediate "
      "repeats of a pose are one visit, and outliers are left out.");
  if (all.series.size() > kMostVisits)
    notes.push_back(fmt::format("An even choice of {} of {} visits is drawn; the mean uses all.",
                                kMostVisits, all.series.size()));
  auto legend = pose_legend(results);
  legend.push_back({.words = fmt::format("moving mean over 1/{} of the visits", kWindows),
                    .line = draw::LineStyle{Tone::kInk, 2.0}});
  draw::Sheet sheet(width, {.title = "What the model leaves, in the order of measuring",
                            .sentence = order_sentence(results, all),
                            .legend = std::move(legend),
                            .notes = std::move(notes)});
  std::vector<double> sizes;
  for (Eigen::Index i = 0; i < all.series.error_M.size(); ++i)
    sizes.push_back(std::abs(all.series.error_M.data()[i]));
  const double most = sizes.empty() ? 1e-3 : *std::max_element(sizes.begin(), sizes.end());
  const LengthUnit unit = unit_for(most);
  const std::set<int> held(results.held.begin(), results.held.end());
  const char* names[] = {"x", "y", "z"};
  int left = all.series.axes();
  for (int axis = 0; axis < 3; ++axis) {
    if (!all.series.has_axis[static_cast<std::size_t>(axis)]) continue;
    --left;
    draw::Panel panel(sheet.svg(), sheet.room(left == 0 ? 176.0 : 160.0),
                      {.title = left == 0 ? "visit, in the order of measuring" : "",
                       .low = 0.0,
                       .high = std::max(1.0, static_cast<double>(all.series.size()))},
                      {.title = fmt::format("e{} [{}]", names[axis], unit.name),
                       .low = -most * unit.per_m,
                       .high = most * unit.per_m});
    draw_axis(results, all, axis, unit, held, panel);
  }
  return sheet.file();
}

}  // namespace plumb::offline::figures

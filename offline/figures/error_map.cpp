// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "draw/panel.hpp"
#include "draw/sheet.hpp"
#include "figures/error_figures.hpp"
#include "figures/words.hpp"
#include "figures/worst_band.hpp"
#include "plumb/runtime/chain.hpp"

namespace plumb::offline::figures {
namespace {

using draw::Mark;
using draw::Tone;

constexpr std::size_t kMostArrows = 240;
constexpr double kArrow_px = 34.0;  // of the 95th percentile before calibration
constexpr double kMapHeight = 330.0, kWideMapHeight = 430.0, kWidePage = 1100.0,
                 kNarrowestMap = 250.0;

struct View {
  const char* name;
  int across, up;  // axes of the base frame
};
constexpr std::array<View, 3> kViews{
    {{"from above", 0, 1}, {"from the side", 0, 2}, {"from the front", 1, 2}}};
constexpr std::array<const char*, 3> kAxisNames{"x [mm]", "y [mm]", "z [mm]"};

struct Map {
  Rows3 p_B, before_B, after_B;  // [m]
  std::vector<Eigen::Vector3d> arm_B;
};

Map map_of(const RunResults& results) {
  const ArmState& state = results.run.fit.calibration.state;
  const Measurements& measured = results.measured;
  Rows3 from_base_M = measured.p_M;
  for (Eigen::Index i = 0; i < from_base_M.rows(); ++i) {
    const auto& p = state.frame(setup_of(measured, i)).p;
    from_base_M.row(i) -= Eigen::RowVector3d(p[0], p[1], p[2]);
  }
  Map out{to_base(state, measured, from_base_M),
          to_base(state, measured, results.before_M),
          to_base(state, measured, results.after_M),
          {}};
  if (results.judged().empty()) return out;
  const int row = results.judged()[results.judged().size() / 2];
  const Chain chain(state.arm.calibrated);
  std::vector<double> q(static_cast<std::size_t>(chain.joints()));
  for (std::size_t j = 0; j < q.size(); ++j) q[j] = measured.q(row, static_cast<Eigen::Index>(j));
  ChainFrames frames;
  chain.frames(q, frames);
  const auto point = [](const Transformd& X) { return Eigen::Vector3d(X.p(0), X.p(1), X.p(2)); };
  out.arm_B.emplace_back(Eigen::Vector3d::Zero());
  for (int j = 0; j < chain.joints(); ++j)
    out.arm_B.push_back(point(frames.joint[static_cast<std::size_t>(j)]));
  out.arm_B.push_back(point(frames.tip));
  out.arm_B.emplace_back(out.p_B.row(row).transpose());
  return out;
}

struct Range {
  double low = INFINITY, high = -INFINITY;
  void add(double v) { low = std::min(low, v), high = std::max(high, v); }
  double middle() const { return high >= low ? 0.5 * (low + high) : 0.0; }
  double size() const { return high > low ? high - low : 0.1; }
};

std::array<Range, 3> ranges_of(const Map& map, const std::vector<int>& rows) {
  std::array<Range, 3> out;
  for (int k = 0; k < 3; ++k) {
    for (const int row : rows) out[static_cast<std::size_t>(k)].add(map.p_B(row, k));
    for (const auto& p : map.arm_B) out[static_cast<std::size_t>(k)].add(p(k));
  }
  return out;
}

/// Axes of this view on which a metre has `px` pixels in both directions.
std::array<draw::Axis, 2> axes_of(const View& view, const std::array<Range, 3>& ranges,
                                  const draw::Box& plot, double px) {
  std::array<draw::Axis, 2> out;
  const std::array<int, 2> which{view.across, view.up};
  const std::array<double, 2> room{plot.width(), plot.height()};
  for (std::size_t k = 0; k < 2; ++k) {
    const Range& range = ranges[static_cast<std::size_t>(which[k])];
    const double half = 0.5 * room[k] / px;
    out[k] = {.title = kAxisNames[static_cast<std::size_t>(which[k])],
              .low = 1e3 * (range.middle() - half),
              .high = 1e3 * (range.middle() + half),
              .ends = draw::Axis::Ends::kExact};
  }
  return out;
}

/// The largest number of pixels a metre at which every view fits into its room with a margin.
double scale_of(const std::array<Range, 3>& ranges, const draw::Box& plot) {
  double px = INFINITY;
  for (const View& view : kViews) {
    px = std::min(px, (plot.width() - 2.0 * kArrow_px) /
                          ranges[static_cast<std::size_t>(view.across)].size());
    px = std::min(
        px, (plot.height() - 2.0 * kArrow_px) / ranges[static_cast<std::size_t>(view.up)].size());
  }
  return px;
}

/// 1, 2 or 5 times a power of ten, not above `factor`.
double round_down(double factor) {
  const double power = std::pow(10.0, std::floor(std::log10(factor)));
  const double lead = factor / power;
  return power * (lead >= 5.0 ? 5.0 : lead >= 2.0 ? 2.0 : 1.0);
}

void draw_view(const RunResults& results, const Map& map, const View& view,
               const std::vector<int>& rows, double factor, draw::Svg& svg, draw::Panel& panel) {
  std::vector<draw::Point> arm;
  for (const auto& p : map.arm_B) arm.push_back({1e3 * p(view.across), 1e3 * p(view.up)});
  svg.clip(panel.plot());
  panel.line(arm, {.paint = Tone::kBand, .width = 7.0});
  panel.line(arm, {.paint = Tone::kMuted, .width = 1.0});
  for (const bool after : {false, true}) {
    const Rows3& error = after ? map.after_B : map.before_B;
    for (const int row : rows) {
      const double x = 1e3 * map.p_B(row, view.across), y = 1e3 * map.p_B(row, view.up);
      svg.arrow(panel.at(x, y),
                panel.at(x + 1e3 * factor * error(row, view.across),
                         y + 1e3 * factor * error(row, view.up)),
                {.paint = after ? Tone::kBlue : Tone::kVermilion, .width = after ? 1.5 : 0.9},
                results.pose(row), after ? pose_numbers(results, row) : std::string());
    }
  }
  svg.end_clip();
}

}  // namespace

std::string error_map(const RunResults& results, double width) {
  std::vector<int> all = results.judged();
  const std::vector<int> rows = thinned(results, all, kMostArrows);
  const Map map = map_of(results);
  const auto ranges = ranges_of(map, rows);
  // Where the frames will be, to give all views one scale.
  const auto layout = [&](draw::Sheet& sheet) {
    return sheet.grid(3, kNarrowestMap, width >= kWidePage ? kWideMapHeight : kMapHeight);
  };
  draw::Sheet trial(width, {.title = "", .sentence = ""});
  const draw::Box outer = layout(trial).front();
  const draw::Axis widest{.title = "x", .low = -8888.0, .high = 8888.0};
  const draw::Box plot = draw::Panel(trial.svg(), outer, widest, widest, "view").plot();
  const double px = scale_of(ranges, plot);
  const double usual = quantile_of(sorted_errors(results, all, Which::kBefore), 0.95);
  const double factor = usual > 0.0 ? round_down(kArrow_px / (px * usual)) : 1.0;
  auto notes = error_notes(results);
  notes.push_back(fmt::format(
      "Arrows show e in the base frame, from the measured point, {:g} times enlarged, before and "
      "after alike; the grey line is the arm in {}.",
      factor, all.empty() ? "no pose" : pose_list(results, std::vector{all[all.size() / 2]}, 1)));
  if (const auto note = thinning_note(rows.size(), all.size()); !note.empty())
    notes.push_back(note);
  draw::Sheet sheet(
      width, {.title = fmt::format("Errors over the workspace, arrows {:g} times enlarged", factor),
              .sentence = where_sentence(results),
              .legend = {{.words = "before", .line = draw::LineStyle{Tone::kVermilion, 0.9}},
                         {.words = "after", .line = draw::LineStyle{Tone::kBlue, 1.8}}},
              .notes = std::move(notes)});
  const auto rooms = layout(sheet);
  for (std::size_t k = 0; k < kViews.size(); ++k) {
    // The labels of the ticks decide how much room a frame has; the second time they are known.
    draw::Box inner = plot;
    for (int again = 0; again < 2; ++again) {
      draw::Svg unused(width);
      auto axes = axes_of(kViews[k], ranges, inner, px);
      inner = draw::Panel(unused, rooms[k], axes[0], axes[1], kViews[k].name).plot();
    }
    const auto axes = axes_of(kViews[k], ranges, inner, px);
    draw::Panel panel(sheet.svg(), rooms[k], axes[0], axes[1], kViews[k].name);
    draw_view(results, map, kViews[k], rows, factor, sheet.svg(), panel);
  }
  return sheet.file();
}

}  // namespace plumb::offline::figures

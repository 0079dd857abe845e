// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "arm/predicted_points.hpp"
#include "compare/worst_band.hpp"
#include "figures/error_figures.hpp"
#include "figures/words.hpp"
#include "figures/workspace_views.hpp"
#include "plumb/runtime/chain.hpp"

namespace plumb::offline::figures {
namespace {

using draw::Mark;
using draw::Tone;

constexpr std::size_t kMostArrows = 240;
constexpr double kArrow_px = 34.0;  // of the 95th percentile before calibration

struct Map {
  Rows3 p_B, before_B, after_B;  // [m]
  std::vector<Eigen::Vector3d> arm_B;
};

Map map_of(const RunResults& results) {
  const ArmState& state = results.run.fit.calibration.state;
  const Measurements& measured = results.measured;
  Map out{places_B(state, measured),
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

Extent extent_of(const Map& map, const std::vector<int>& rows) {
  Extent out;
  for (const int row : rows) out.add(map.p_B.row(row).transpose());
  for (const auto& p : map.arm_B) out.add(p);
  return out;
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
  const WorkspaceViews views(width, extent_of(map, rows), kArrow_px);
  const double px = views.px_per_m();
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
              .sentence = compare::where_sentence(results.cell, results.measured, results.run.fit),
              .legend = {{.words = "before", .line = draw::LineStyle{Tone::kVermilion, 0.9}},
                         {.words = "after", .line = draw::LineStyle{Tone::kBlue, 1.8}}},
              .notes = std::move(notes)});
  auto panels = views.panels(sheet);
  for (std::size_t k = 0; k < panels.size(); ++k)
    draw_view(results, map, views.views()[k], rows, factor, sheet.svg(), panels[k]);
  return sheet.file();
}

}  // namespace plumb::offline::figures

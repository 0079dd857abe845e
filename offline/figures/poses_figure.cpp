// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "draw/panel.hpp"
#include "draw/sheet.hpp"
#include "figures/error_axis.hpp"
#include "figures/run_figures.hpp"
#include "figures/words.hpp"
#include "fit/error_by_poses.hpp"
#include "program/counted_words.hpp"

namespace plumb::offline::figures {
namespace {

using draw::Tone;

constexpr double kPosesHeight = 320.0;  // [px]
constexpr double kRoom = 1.15;          // beyond the first and the last number of poses
constexpr double kWorthMore = 1.1;      // a further doubling that takes more than this

const draw::LineStyle kAloneLine{.paint = Tone::kMuted, .width = 1.6, .dashes = "6 3"};
const draw::LineStyle kWithLine{.paint = Tone::kBlue, .width = 1.6};

draw::Mark alone_mark() {
  return {.shape = draw::Shape::kSquare, .paint = Tone::kMuted, .size = 4.5};
}
draw::Mark with_mark() {
  return {.shape = draw::Shape::kCircle, .paint = Tone::kBlue, .size = 5.0};
}

/// How much the last doubling of the poses took.
std::string more_poses_words(const std::vector<PosesAndError>& curve) {
  const auto last = std::find_if(curve.rbegin(), curve.rend(),
                                 [](const PosesAndError& p) { return p.alone_m.has_value(); });
  if (last == curve.rend()) return "These readings are too few for a fit without all of them.";
  const auto half = std::find_if(curve.rbegin(), curve.rend(), [&](const PosesAndError& p) {
    return p.alone_m && 2 * p.poses <= last->poses;
  });
  std::string out = fmt::format("{} {}", counted_words(last->poses, "pose reaches", "poses reach"),
                                length_text(*last->alone_m));
  if (half == curve.rend()) return out + ".";
  out += fmt::format(", {} {}", counted_words(half->poses, "reaches", "reach"),
                     length_text(*half->alone_m));
  return out + (*half->alone_m > kWorthMore * *last->alone_m ? ": more poses would still help."
                                                             : ": more poses would help little.");
}

std::string saved_words(const std::vector<PosesAndError>& curve) {
  const auto first = std::find_if(curve.begin(), curve.end(),
                                  [](const PosesAndError& p) { return p.with_m.has_value(); });
  if (first == curve.end()) return more_poses_words(curve);
  std::string out = fmt::format("With what is taken over, {} {}",
                                counted_words(first->poses, "pose reaches", "poses reach"),
                                length_text(*first->with_m));
  if (const auto alone = poses_alone(curve, *first->with_m))
    return out + (*alone <= first->poses
                      ? ", and as many reach that alone."
                      : fmt::format(", for which the arm alone needs about {:.0f}.", *alone));
  return out + ", which the arm alone reaches with none of these numbers of poses.";
}

}  // namespace

std::string poses_figure(const RunResults& results, double width) {
  std::vector<int> used = results.held;
  used.insert(used.end(), results.fit.begin(), results.fit.end());
  std::sort(used.begin(), used.end());
  const auto curve = error_by_poses(results.cell, results.measured, used);
  const bool both = takes_over(results.cell);
  std::vector<draw::LegendEntry> legend{
      {.words = "this arm alone", .mark = alone_mark(), .line = kAloneLine}};
  if (both)
    legend.push_back({.words = "with what an earlier run or other arms taught",
                      .mark = with_mark(),
                      .line = kWithLine});
  std::vector<std::string> notes{
      "Mean length of e = measured - predicted at the readings that were not fitted, the mean of "
      "five random choices of the poses; no in-sample error is drawn."};
  if (!both)
    notes.push_back(
        "Does an earlier run, or a sister arm, save poses? Name it: [fit] prior_from = "
        "\"../arm1\".");
  draw::Sheet sheet(width, {.title = "How many poses does it take?",
                            .sentence = saved_words(curve),
                            .legend = std::move(legend),
                            .notes = std::move(notes)});
  double most = results.cell.tolerance_m, least = most;
  for (const auto& point : curve)
    for (const auto& error : {point.alone_m, point.with_m})
      if (error) most = std::max(most, *error), least = std::min(least, *error);
  const ErrorAxis axis = mean_error_axis(least, most);
  draw::Axis poses{.title = "poses that were fitted",
                   .low = 8.0 / kRoom,
                   .high = 16.0 * kRoom,
                   .scale = draw::Axis::Scale::kLog,
                   .ends = draw::Axis::Ends::kExact,
                   .ticks = {}};
  if (!curve.empty()) poses.high = kRoom * curve.back().poses;
  for (const auto& point : curve)
    poses.ticks.push_back({static_cast<double>(point.poses), fmt::format("{}", point.poses)});
  draw::Panel panel(sheet.svg(), sheet.room(kPosesHeight), poses, axis.axis);
  const auto draw_curve = [&](auto error_of, const draw::LineStyle& line, draw::Mark mark,
                              const char* what) {
    std::vector<draw::Point> points;
    for (const auto& point : curve)
      if (const auto error = error_of(point))
        points.push_back({static_cast<double>(point.poses), axis.of(*error)});
    panel.line(points, line);
    for (const auto& p : points) {
      mark.words =
          fmt::format("{:.0f} poses, {}: {}", p.x, what, length_text(p.y / axis.unit.per_m));
      panel.mark(p.x, p.y, mark);
    }
  };
  draw_curve([](const PosesAndError& p) { return p.alone_m; }, kAloneLine, alone_mark(), "alone");
  draw_curve([](const PosesAndError& p) { return p.with_m; }, kWithLine, with_mark(), "with");
  draw_limits(results, axis, Along::kY, panel);
  return sheet.file();
}

}  // namespace plumb::offline::figures

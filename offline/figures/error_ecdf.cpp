// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "draw/panel.hpp"
#include "draw/sheet.hpp"
#include "figures/error_axis.hpp"
#include "figures/error_figures.hpp"
#include "figures/words.hpp"

namespace plumb::offline::figures {
namespace {

using draw::Tone;

constexpr std::size_t kMostSteps = 1000;  // of a curve

std::vector<draw::Point> ecdf_steps(const std::vector<double>& errors_m, const ErrorAxis& axis) {
  std::vector<draw::Point> out{{axis.axis.low, 0.0}};
  const auto n = static_cast<double>(errors_m.size());
  const std::size_t stride = 1 + errors_m.size() / kMostSteps;
  double share = 0.0;
  for (std::size_t i = 0; i < errors_m.size(); ++i) {
    if (axis.ends_before(errors_m[i])) break;
    if (i % stride != 0 && i + 1 != errors_m.size() && !axis.ends_before(errors_m[i + 1])) continue;
    const double x = axis.of(errors_m[i]);
    out.push_back({x, share});
    share = 100.0 * static_cast<double>(i + 1) / n;
    out.push_back({x, share});
  }
  if (!errors_m.empty() && axis.ends_before(errors_m.back()))
    out.push_back({axis.axis.high, share});
  return out;
}

/// The curve; where it goes on beyond the axis, a mark at the edge with the number of poses there.
void draw_curve(const std::vector<double>& errors_m, const ErrorAxis& axis,
                const draw::LineStyle& style, draw::Panel& panel) {
  const auto steps = ecdf_steps(errors_m, axis);
  panel.line(steps, style);
  const auto beyond = std::count_if(errors_m.begin(), errors_m.end(),
                                    [&](double error) { return axis.ends_before(error); });
  if (beyond == 0) return;
  const std::string words = fmt::format("{} beyond", beyond);
  panel.mark(
      axis.axis.high, steps.back().y,
      {.shape = draw::Shape::kTriangleRight, .paint = style.paint, .size = 5.0, .words = words});
  panel.label(axis.axis.high, steps.back().y, words);
}

std::string ecdf_sentence(const RunResults& results) {
  const auto rows = usual_rows(results, results.judged());
  const auto before = sorted_errors(results, rows, Which::kBefore);
  const auto after = sorted_errors(results, rows, Which::kAfter);
  if (after.empty()) return "There is no pose to judge.";
  return fmt::format(
      "Half of {} miss by at most {} and 95 % by at most {}; before calibration it "
      "was {} and {}.",
      judged_words(results), length_text(quantile_of(after, 0.5)),
      length_text(quantile_of(after, 0.95)), length_text(quantile_of(before, 0.5)),
      length_text(quantile_of(before, 0.95)));
}

}  // namespace

std::string error_ecdf(const RunResults& results, double width) {
  const draw::LineStyle before{.paint = Tone::kVermilion, .width = 2.0, .dashes = "7 3"};
  const draw::LineStyle after{.paint = Tone::kBlue, .width = 2.2};
  const draw::LineStyle fitted{.paint = Tone::kBlue, .width = 1.0, .dashes = "3 2"};
  const bool held = !results.held.empty();
  std::vector<draw::LegendEntry> legend{
      {.words = held ? "before, held-out poses" : "before, fitted poses", .line = before},
      {.words = held ? "after, held-out poses" : "after, fitted poses", .line = after}};
  const bool both = held && !results.fit.empty();
  if (both) legend.push_back({.words = "after, fitted poses (never accuracy)", .line = fitted});
  const ErrorAxis axis = error_axis(results);
  draw::SheetText text{.title = "Share of the poses that miss by no more than an error",
                       .sentence = ecdf_sentence(results),
                       .legend = std::move(legend),
                       .notes = error_notes(results)};
  std::vector<int> drawn = results.judged();
  if (both) drawn.insert(drawn.end(), results.fit.begin(), results.fit.end());
  add_beyond(results, axis, drawn, text);
  draw::Sheet sheet(width, std::move(text));
  draw::Panel panel(sheet.svg(), sheet.room(360.0), axis.axis,
                    {.title = "share of the poses [%]", .low = 0.0, .high = 100.0});
  draw_limits(results, axis, Along::kX, panel);
  if (both) draw_curve(sorted_errors(results, results.fit, Which::kAfter), axis, fitted, panel);
  draw_curve(sorted_errors(results, results.judged(), Which::kBefore), axis, before, panel);
  draw_curve(sorted_errors(results, results.judged(), Which::kAfter), axis, after, panel);
  return sheet.file();
}

}  // namespace plumb::offline::figures

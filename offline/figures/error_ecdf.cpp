// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

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
    if (i % stride != 0 && i + 1 != errors_m.size()) continue;
    const double x = axis.of(errors_m[i]);
    out.push_back({x, share});
    share = 100.0 * static_cast<double>(i + 1) / n;
    out.push_back({x, share});
  }
  return out;
}

std::string ecdf_sentence(const RunResults& results) {
  const auto before = sorted_errors(results, results.judged(), Which::kBefore);
  const auto after = sorted_errors(results, results.judged(), Which::kAfter);
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
  draw::Sheet sheet(width, {.title = "Share of the poses that miss by no more than an error",
                            .sentence = ecdf_sentence(results),
                            .legend = std::move(legend),
                            .notes = error_notes(results)});
  const ErrorAxis axis = error_axis(results);
  draw::Panel panel(sheet.svg(), sheet.room(360.0), axis.axis,
                    {.title = "share of the poses [%]", .low = 0.0, .high = 100.0});
  draw_limits(results, axis, Along::kX, panel);
  if (both)
    panel.line(ecdf_steps(sorted_errors(results, results.fit, Which::kAfter), axis), fitted);
  panel.line(ecdf_steps(sorted_errors(results, results.judged(), Which::kBefore), axis), before);
  panel.line(ecdf_steps(sorted_errors(results, results.judged(), Which::kAfter), axis), after);
  return sheet.file();
}

}  // namespace plumb::offline::figures

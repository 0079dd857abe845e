// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "draw/panel.hpp"
#include "draw/sheet.hpp"
#include "figures/error_axis.hpp"
#include "figures/error_figures.hpp"
#include "figures/words.hpp"

namespace plumb::offline::figures {
namespace {

using draw::Tone;

constexpr double kPanelHeight = 210.0;
constexpr int kLinearBins = 40, kBinsPerDecade = 8;
constexpr double kLowestCount = 0.7;  // of the axis, so that one pose is seen

std::vector<double> bin_edges(const draw::Axis& axis) {
  std::vector<double> out;
  if (axis.scale == draw::Axis::Scale::kLinear) {
    for (int i = 0; i <= kLinearBins; ++i)
      out.push_back(axis.low + (axis.high - axis.low) * i / kLinearBins);
    return out;
  }
  const int bins =
      std::max(1, static_cast<int>(std::lround(kBinsPerDecade * std::log10(axis.high / axis.low))));
  for (int i = 0; i <= bins; ++i)
    out.push_back(axis.low * std::pow(axis.high / axis.low, static_cast<double>(i) / bins));
  return out;
}

std::vector<int> counts_of(const std::vector<double>& errors_m, const ErrorAxis& axis,
                           const std::vector<double>& edges) {
  std::vector<int> out(edges.size() - 1, 0);
  for (const double error : errors_m) {
    if (axis.ends_before(error)) continue;
    const auto above = std::upper_bound(edges.begin(), edges.end(), axis.of(error));
    const auto bin = std::clamp<std::ptrdiff_t>(above - edges.begin() - 1, 0,
                                                static_cast<std::ptrdiff_t>(out.size()) - 1);
    ++out[static_cast<std::size_t>(bin)];
  }
  return out;
}

struct Bars {
  std::vector<int> held, fit;
  int beyond = 0;  // the axis
  int most() const {
    int out = 1;
    out = std::max(out, beyond);
    for (const auto* counts : {&held, &fit})
      for (const int n : *counts) out = std::max(out, n);
    return out;
  }
};

void draw_bars(const Bars& bars, const std::vector<double>& edges, const ErrorAxis& axis, Tone tone,
               draw::Panel& panel) {
  const auto draw_one = [&](const std::vector<int>& counts, const char* kind, bool filled) {
    for (std::size_t i = 0; i < counts.size(); ++i) {
      if (counts[i] == 0) continue;
      const std::string words =
          fmt::format("{} to {} {}: {} {}", draw::digits(edges[i], 3),
                      draw::digits(edges[i + 1], 3), axis.unit.name, counts[i], kind);
      const draw::LineStyle edge{.paint = filled ? Tone::kPaper : tone,
                                 .width = filled ? 0.6 : 1.2};
      panel.bar(edges[i], panel.y_low(), edges[i + 1], counts[i],
                filled ? draw::Paint(tone) : draw::Paint(), edge, words);
    }
  };
  draw_one(bars.held, "held out", true);
  draw_one(bars.fit, "fitted", false);
  if (bars.beyond == 0) return;
  const std::string words = fmt::format("{} beyond", bars.beyond);
  panel.mark(axis.axis.high, bars.beyond,
             {.shape = draw::Shape::kTriangleRight, .paint = tone, .size = 5.0, .words = words});
  panel.label(axis.axis.high, bars.beyond, words);
}

std::string hist_sentence(const RunResults& results) {
  const auto rows = usual_rows(results, results.judged());
  const auto before = sorted_errors(results, rows, Which::kBefore);
  const auto after = sorted_errors(results, rows, Which::kAfter);
  if (after.empty()) return "There is no pose to judge.";
  const double tolerance = results.cell.tolerance_m;
  const auto within = std::upper_bound(after.begin(), after.end(), tolerance) - after.begin();
  const double a = quantile_of(before, 0.5), b = quantile_of(after, 0.5);
  const std::string change = b < a ? "falls" : b > a ? "rises" : "stays";
  return fmt::format(
      "The median error of {} {} from {} to {}; {} of {} are within the tolerance "
      "of {}, and the largest error is {}.",
      judged_words(results), change, length_text(a), length_text(b), within, after.size(),
      length_text(tolerance), length_text(after.back()));
}

}  // namespace

std::string error_hist(const RunResults& results, double width) {
  std::vector<draw::LegendEntry> legend;
  if (!results.held.empty())
    legend = {{.words = "before, held out", .area = Tone::kVermilion},
              {.words = "after, held out", .area = Tone::kBlue}};
  if (!results.fit.empty())
    legend.push_back(
        {.words = "fitted poses (outline)", .line = draw::LineStyle{Tone::kBlue, 1.4}});
  const ErrorAxis axis = error_axis(results);
  draw::SheetText text{.title = "Distribution of the error, before and after calibration",
                       .sentence = hist_sentence(results),
                       .legend = std::move(legend),
                       .notes = error_notes(results)};
  std::vector<int> all = results.held;
  all.insert(all.end(), results.fit.begin(), results.fit.end());
  add_beyond(results, axis, all, text);
  draw::Sheet sheet(width, std::move(text));
  const auto edges = bin_edges(axis.axis);
  const auto bars_of = [&](Which which) {
    const auto errors = sorted_errors(results, all, which);
    return Bars{counts_of(sorted_errors(results, results.held, which), axis, edges),
                counts_of(sorted_errors(results, results.fit, which), axis, edges),
                static_cast<int>(std::count_if(errors.begin(), errors.end(),
                                               [&](double e) { return axis.ends_before(e); }))};
  };
  const Bars before = bars_of(Which::kBefore), after = bars_of(Which::kAfter);
  const draw::Axis count{.title = "poses",
                         .low = kLowestCount,
                         .high = 1.3 * std::max(before.most(), after.most()),
                         .scale = draw::Axis::Scale::kLog,
                         .ends = draw::Axis::Ends::kExact};
  draw::Axis upper = axis.axis;
  upper.title.clear();
  draw::Panel first(sheet.svg(), sheet.room(kPanelHeight), upper, count, "before");
  draw_bars(before, edges, axis, Tone::kVermilion, first);
  draw_limits(results, axis, Along::kX, first);
  draw::Panel second(sheet.svg(), sheet.room(kPanelHeight), axis.axis, count, "after");
  draw_bars(after, edges, axis, Tone::kBlue, second);
  draw_limits(results, axis, Along::kX, second);
  return sheet.file();
}

}  // namespace plumb::offline::figures

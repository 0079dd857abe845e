// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "draw/panel.hpp"
#include "draw/sheet.hpp"
#include "figures/error_axis.hpp"
#include "figures/run_figures.hpp"
#include "figures/words.hpp"
#include "program/counted_words.hpp"

namespace plumb::offline::figures {
namespace {

using draw::Tone;

constexpr double kHistoryHeight = 320.0;  // [px]
constexpr double kHalfStep = 0.4;         // of the way between two checks: its control limit

const draw::LineStyle kControl{.paint = Tone::kVermilion, .width = 1.4, .dashes = "6 3"};
const draw::LineStyle kExpected{.paint = Tone::kMuted, .width = 1.2};

bool changed(const Run& run) { return run.recheck->verdict == "changed"; }

draw::Mark before_mark(const Run& run) {
  return {.shape = changed(run) ? draw::Shape::kDiamond : draw::Shape::kCircle,
          .paint = changed(run) ? Tone::kVermilion : Tone::kBlue,
          .size = 5.0,
          .words = fmt::format("run {}: {}", run.number, run.recheck->words)};
}

std::string history_sentence(const RunResults& results) {
  const auto& all = results.rechecks;
  if (all.empty()) return fmt::format("Run {} was never rechecked.", results.run.number);
  const Run& last = all.back();
  const auto times = std::count_if(all.begin(), all.end(), changed);
  std::string out =
      fmt::format("{} since run {}, of which {} found a change",
                  counted_words(static_cast<long long>(all.size()), "recheck", "rechecks"),
                  results.run.number, times == 0 ? "none" : fmt::format("{}", times));
  return out + fmt::format(
                   "; the last one, run {}, missed by {} on average, where up to {} is what "
                   "chance may do.",
                   last.number, length_text(last.recheck->before.mean),
                   length_text(last.recheck->limit_m));
}

double calibration_error(const Run& run) {
  return run.fit.held.n > 0 ? run.fit.held.mean : run.fit.fit.mean;
}

std::string calibration_note(const Run& run) {
  return run.fit.held.n > 0
             ? fmt::format("Calibration: run {}, {} held-out readings.", run.number, run.fit.held.n)
             : fmt::format(
                   "Calibration: run {}; no pose was held out, so its error is in-sample and "
                   "no accuracy.",
                   run.number);
}

}  // namespace

std::string history_figure(const RunResults& results, double width) {
  draw::Sheet sheet(
      width,
      {.title = "Is the calibration still true?",
       .sentence = history_sentence(results),
       .legend = {{.words = "error of the calibration",
                   .mark = draw::Mark{.shape = draw::Shape::kSquare, .paint = Tone::kInk}},
                  {.words = "recheck: nothing changed",
                   .mark = draw::Mark{.shape = draw::Shape::kCircle, .paint = Tone::kBlue}},
                  {.words = "recheck: something changed",
                   .mark = draw::Mark{.shape = draw::Shape::kDiamond, .paint = Tone::kVermilion}},
                  {.words = "after what changed was refitted",
                   .mark = draw::Mark{.shape = draw::Shape::kCircle,
                                      .paint = Tone::kBlue,
                                      .fill = draw::Mark::Fill::kHollow}},
                  {.words = "to be expected", .line = kExpected},
                  {.words = "control limit", .line = kControl}},
       .notes = {
           "Mean length of e = measured - predicted over the readings of each recheck, by the run "
           "before it.",
           calibration_note(results.run),
           "Control limit: three standard deviations of the mean above what is expected."}});
  double most = std::max(results.cell.tolerance_m, calibration_error(results.run));
  double least = most;
  for (const Run& run : results.rechecks) {
    most = std::max({most, run.recheck->before.mean, run.recheck->limit_m, run.fit.held.mean});
    least = std::min({least, run.recheck->before.mean, run.recheck->expected_m, run.fit.held.mean});
  }
  const ErrorAxis axis = mean_error_axis(least, most);
  draw::Axis runs{.title = "run", .low = -0.6, .high = 0.6, .ticks = {}};
  runs.high += static_cast<double>(results.rechecks.size());
  runs.ticks.push_back({0.0, fmt::format("{}", results.run.number)});
  for (std::size_t i = 0; i < results.rechecks.size(); ++i)
    runs.ticks.push_back(
        {static_cast<double>(i + 1), fmt::format("{}", results.rechecks[i].number)});
  draw::Panel panel(sheet.svg(), sheet.room(kHistoryHeight), runs, axis.axis);
  panel.mark(0.0, axis.of(calibration_error(results.run)),
             {.shape = draw::Shape::kSquare, .paint = Tone::kInk, .size = 5.0});
  for (std::size_t i = 0; i < results.rechecks.size(); ++i) {
    const Run& run = results.rechecks[i];
    const double x = static_cast<double>(i + 1);
    const auto across = [&](double error_m, const draw::LineStyle& style) {
      panel.line({{x - kHalfStep, axis.of(error_m)}, {x + kHalfStep, axis.of(error_m)}}, style);
    };
    across(run.recheck->expected_m, kExpected);
    across(run.recheck->limit_m, kControl);
    if (changed(run)) {
      panel.line({{x, axis.of(run.recheck->before.mean)}, {x, axis.of(run.fit.held.mean)}},
                 {.paint = Tone::kMuted, .dashes = "2 2"});
      panel.mark(x, axis.of(run.fit.held.mean),
                 {.paint = Tone::kBlue, .fill = draw::Mark::Fill::kHollow, .size = 5.0});
    }
    panel.mark(x, axis.of(run.recheck->before.mean), before_mark(run));
  }
  draw_limits(results, axis, Along::kY, panel);
  return sheet.file();
}

}  // namespace plumb::offline::figures

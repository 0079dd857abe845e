// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "arm/predicted_points.hpp"
#include "draw/panel.hpp"
#include "draw/sheet.hpp"
#include "draw/text_width.hpp"
#include "figures/error_axis.hpp"
#include "figures/run_figures.hpp"
#include "figures/words.hpp"
#include "program/counted_words.hpp"

namespace plumb::offline::figures {
namespace {

using draw::Tone;

constexpr double kWorseBeyond = 2.0;  // times the noise floor: more than noise moves an error
constexpr double kStepBar = 30.0, kStepLine = 15.0, kStepSize = 11.0;  // [px]
constexpr double kStepMargin = 52.0, kTopRoom = 38.0;                  // [px]
constexpr double kFrameRoom = 43.0;  // [px] of a panel above and below its frame
constexpr double kLogSteps = 15.0;   // times the smallest error: a logarithmic axis

using Names = std::vector<std::string>;

/// The names of `all` that `fewer` lacks; an effect may occur several times.
Names added_names(Names all, const Names& fewer) {
  for (const auto& name : fewer)
    if (const auto at = std::find(all.begin(), all.end(), name); at != all.end()) all.erase(at);
  return all;
}

bool is_part_of(const Names& fewer, const Names& all) {
  return added_names(fewer, all).empty() && fewer.size() < all.size();
}

std::vector<double> held_errors(const RunResults& results, const Rows3& error_M) {
  std::vector<double> out;
  for (const int row : results.held) out.push_back(error_M.row(row).norm());
  return out;
}

int grown(const std::vector<double>& from, const std::vector<double>& to, double floor_m) {
  int out = 0;
  for (std::size_t i = 0; i < std::min(from.size(), to.size()); ++i)
    out += to[i] > from[i] + kWorseBeyond * floor_m;
  return out;
}

std::string waterfall_sentence(const std::vector<WaterfallStep>& steps, const RunResults& results) {
  if (results.held.empty() || steps.size() < 2)
    return "No pose was held out: how good each model is nobody can say.";
  const WaterfallStep* best = &steps[1];
  double most = -INFINITY;
  for (std::size_t i = 1; i < steps.size(); ++i)
    if (const double fall = steps[i - 1].mean_m - steps[i].mean_m; fall > most)
      most = fall, best = &steps[i];
  const double last = steps.back().mean_m, floor = results.run.fit.floor.mean_m;
  std::string out = fmt::format("The mean held-out error goes from {} to {}; {} brings most of it",
                                length_text(steps.front().mean_m), length_text(last), best->added);
  if (floor > 0.0)
    out += fmt::format(", and what is left is {} times the noise floor",
                       draw::digits(last / floor, 2));
  return out + ".";
}

/// The numbers first, then what was added.
std::string step_words(const WaterfallStep& step, bool first) {
  std::string out = length_text(step.mean_m);
  if (step.worse > 0) out += fmt::format(", {} worse", counted_words(step.worse, "pose", "poses"));
  return out + (first ? ": " : ": + ") + step.added;
}

/// On a ground of their own, so that the lines across the panel do not cross them.
void put_words(const std::string& words, draw::Point at, draw::Svg& svg) {
  const double w = draw::text_width(words, kStepSize);
  svg.box({at.x + 2.0, at.y - kStepSize, at.x + 8.0 + w, at.y + 4.0}, Tone::kPaper);
  svg.text({at.x + 5.0, at.y}, draw::Anchor::kStart, words, {.size = kStepSize});
}

}  // namespace

std::vector<WaterfallStep> waterfall_steps(const RunResults& results,
                                           const std::vector<Run>& earlier) {
  std::vector<const Run*> chain{&results.run};
  for (auto run = earlier.rbegin(); run != earlier.rend(); ++run)
    if (run->number < results.run.number && run->fit.predicted_M.rows() == results.after_M.rows() &&
        run->fit.split.held == results.run.fit.split.held &&
        run->fit.split.fold == results.run.fit.split.fold &&
        run->fit.base == results.run.fit.base && is_part_of(run->effects, chain.back()->effects))
      chain.push_back(&*run);
  std::reverse(chain.begin(), chain.end());
  std::vector<double> last = held_errors(results, results.before_M);
  double sum = 0.0;
  for (const double e : last) sum += e;
  std::vector<WaterfallStep> out{
      {"nominal arm", last.empty() ? 0.0 : sum / static_cast<double>(last.size()), 0}};
  Names names;
  for (const Run* run : chain) {
    const auto errors = held_errors(
        results,
        run == &results.run ? results.after_M : residuals(results.measured, run->fit.predicted_M));
    out.push_back({effect_names(added_names(run->effects, names), " + "), run->fit.held.mean,
                   grown(last, errors, results.run.fit.floor.mean_m)});
    names = run->effects;
    last = errors;
  }
  return out;
}

std::string waterfall(const RunResults& results, const std::vector<WaterfallStep>& steps,
                      double width) {
  auto notes = error_notes(results);
  notes.push_back(
      fmt::format("Steps are earlier runs of the same data, each with fewer effects than "
                  "the next. Worse: the error of a held-out pose grew by more than {:g} "
                  "times the noise floor.",
                  kWorseBeyond));
  draw::Sheet sheet(width, {.title = "Held-out error as the model grows",
                            .sentence = waterfall_sentence(steps, results),
                            .notes = std::move(notes)});
  double most = results.cell.tolerance_m, least = most;
  for (const auto& step : steps) {
    most = std::max(most, step.mean_m);
    if (step.mean_m > 0.0) least = std::min(least, step.mean_m);
  }
  if (results.run.fit.floor.mean_m > 0.0) least = std::min(least, results.run.fit.floor.mean_m);
  ErrorAxis axis{.unit = unit_for(most), .axis = {}};
  axis.axis.title = "mean held-out error [" + axis.unit.name + "]";
  axis.axis.high = 1.1 * most * axis.unit.per_m;
  if (most > kLogSteps * least) {
    axis.axis.scale = draw::Axis::Scale::kLog;
    axis.axis.low = 0.8 * least * axis.unit.per_m;
    axis.axis.ends = draw::Axis::Ends::kExact;
  }
  // The words of each step in as many lines as they need, and its bar below them.
  std::vector<Names> words;
  double height = kTopRoom;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    words.push_back(
        draw::wrapped(step_words(steps[i], i == 0), kStepSize, sheet.svg().width() - kStepMargin));
    height += kStepLine * static_cast<double>(words.back().size()) + kStepBar;
  }
  draw::Panel panel(sheet.svg(), sheet.room(height + kFrameRoom), axis.axis,
                    {.low = 0.0, .high = height, .ticks = {{-1.0, ""}}});
  draw_limits(results, axis, Along::kX, panel);
  double top = height - kTopRoom, last_bar = top;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const double bar = top - kStepLine * static_cast<double>(words[i].size()) - 0.5 * kStepBar;
    const double at = axis.of(steps[i].mean_m);
    if (i > 0) {
      const double from = axis.of(steps[i - 1].mean_m);
      panel.line({{from, last_bar}, {from, bar}}, {.paint = Tone::kMuted, .dashes = "2 2"});
      panel.line({{from, bar}, {at, bar}},
                 {.paint = at > from ? Tone::kVermilion : Tone::kBlue, .width = 5.0});
    }
    panel.mark(at, bar,
               {.shape = i == 0 ? draw::Shape::kSquare : draw::Shape::kCircle,
                .paint = i == 0 ? Tone::kVermilion : Tone::kBlue,
                .size = 5.0,
                .words = step_words(steps[i], i == 0)});
    for (const auto& line : words[i]) {
      top -= kStepLine;
      put_words(line, panel.at(panel.x_low(), top + 4.0), sheet.svg());
    }
    last_bar = bar;
    top -= kStepBar;
  }
  return sheet.file();
}

}  // namespace plumb::offline::figures

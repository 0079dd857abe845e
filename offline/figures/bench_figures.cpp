// SPDX-License-Identifier: Apache-2.0
#include "figures/bench_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "draw/duration.hpp"
#include "draw/panel.hpp"
#include "draw/sheet.hpp"
#include "figures/words.hpp"

namespace plumb::offline::figures {
namespace {

using bench::Benchmark;
using bench::Part;
using bench::Timing;
using bench::Way;
using draw::duration;
using draw::Tone;

constexpr int kBinsPerDecadeOfTime = 12;
constexpr double kCountFloor = 0.5;     // lowest count of the axis; below 1, so that a call is seen
constexpr std::size_t kMostParts = 14;  // effects that have a bar of their own
constexpr double kPartRow = 30.0;       // [px]

/// A reading of less than the clock can tell counts as 1 ns.
double shown_ns(double ns) { return std::max(1.0, ns); }

int time_bin(double ns) {
  return static_cast<int>(std::floor(kBinsPerDecadeOfTime * std::log10(shown_ns(ns))));
}

double bin_start(int bin) {
  return std::pow(10.0, static_cast<double>(bin) / kBinsPerDecadeOfTime);
}

/// Outline of the histogram: points (ns, calls), beginning and ending on the floor.
std::vector<draw::Point> outline_of(const Timing& timing) {
  std::vector<draw::Point> out;
  if (timing.ns.empty()) return out;
  const int first = time_bin(timing.ns.front()), last = time_bin(timing.ns.back());
  std::vector<double> counts(static_cast<std::size_t>(last - first) + 1, 0.0);
  for (const double ns : timing.ns)
    counts[static_cast<std::size_t>(time_bin(ns) - first)] +=
        static_cast<double>(timing.calls_per_reading);
  out.push_back({bin_start(first), kCountFloor});
  for (int bin = first; bin <= last; ++bin) {
    const double n = std::max(kCountFloor, counts[static_cast<std::size_t>(bin - first)]);
    out.push_back({bin_start(bin), n});
    out.push_back({bin_start(bin + 1), n});
  }
  out.push_back({bin_start(last + 1), kCountFloor});
  return out;
}

std::string percent_of_cycle(const Benchmark& found, double ns) {
  return draw::digits(100.0 * 1e-9 * ns / found.cycle_s, 2) + " %";
}

std::vector<draw::Tick> time_ticks(double low_ns, double high_ns) {
  std::vector<draw::Tick> out;
  for (double at = std::pow(10.0, std::floor(std::log10(low_ns) + 1e-9)); at < 1.01 * high_ns;
       at *= 10.0)
    out.push_back({at, duration(at)});
  return out;
}

struct CostPart {
  std::string words;
  double ns = 0.0;
  Tone tone = Tone::kBlue;
};

/// The share of the step before the model's corrections, then what each of these adds.
std::vector<CostPart> parts_of(const Benchmark& found, std::size_t& left_out) {
  std::vector<CostPart> effects, out;
  for (const Timing& timing : found.timings.all) {
    if (timing.way != Way::kChain || timing.ns.empty()) continue;
    if (timing.part == Part::kKinematics)
      out.push_back({"kinematics alone", timing.median(), Tone::kMuted});
    if (timing.part == Part::kGuard) out.push_back({"guard", timing.median(), Tone::kMuted});
    if (timing.part == Part::kTrees)
      effects.push_back({"trees", found.timings.added(timing), Tone::kOrange});
    if (timing.part == Part::kEffect) {
      const auto colon = timing.label.find(':');
      std::string name = effect_names({timing.label.substr(0, colon)}, "");
      if (colon != std::string::npos) name += " of " + timing.label.substr(colon + 1);
      effects.push_back({std::move(name), found.timings.added(timing), Tone::kBlue});
    }
  }
  std::stable_sort(effects.begin(), effects.end(),
                   [](const CostPart& a, const CostPart& b) { return a.ns > b.ns; });
  left_out = effects.size() > kMostParts ? effects.size() - kMostParts : 0;
  effects.resize(std::min(effects.size(), kMostParts));
  out.insert(out.end(), effects.begin(), effects.end());
  return out;
}

}  // namespace

std::string latency_figure(const Benchmark& found, double width) {
  const Timing& warm = found.cycle();
  const Timing& cold = found.timings.of(Part::kCycle, Way::kCold);
  const double budget_ns = 1e9 * found.cycle_s;
  std::string sentence = "No call was timed.";
  if (!warm.ns.empty())
    sentence = fmt::format(
        "The whole step takes {} in the median, {} of the {:g} ms cycle; the worst of {} calls "
        "took "
        "{}.",
        duration(warm.median()), percent_of_cycle(found, warm.median()), 1e3 * found.cycle_s,
        warm.calls(), duration(warm.most()));
  std::vector<std::string> notes{bench::fitness_text(found.why_not_representative)};
  notes.push_back(fmt::format(
      "{} calls, each waiting for the one before, and {} calls with swept caches, one by one; {} "
      "of "
      "{} random poses are refused, which takes as long (seed {}). The clock's own {:.0f} ns are "
      "taken off.",
      warm.calls(), cold.calls(), found.refused_poses, found.poses, found.seed,
      found.timings.clock_ns));
  const draw::LineStyle warm_line{Tone::kBlue, 1.4}, cold_line{Tone::kVermilion, 1.4, "6 3"};
  draw::Sheet sheet(width, {.title = "How long a cycle takes",
                            .sentence = sentence,
                            .legend = {{.words = "in the caches", .line = warm_line},
                                       {.words = "caches swept", .line = cold_line}},
                            .notes = std::move(notes)});
  double low = budget_ns, high = budget_ns, most = 10.0;
  for (const auto* timing : {&warm, &cold})
    for (const draw::Point& at : outline_of(*timing)) {
      low = std::min(low, at.x), high = std::max(high, at.x);
      most = std::max(most, at.y);
    }
  low = std::pow(10.0, std::floor(std::log10(std::max(1.0, low)) + 1e-9));
  high *= 2.5;  // not at a tick, whose label would not fit
  draw::Panel panel(sheet.svg(), sheet.room(350.0),
                    {.title = "time a call",
                     .low = low,
                     .high = high,
                     .scale = draw::Axis::Scale::kLog,
                     .ticks = time_ticks(low, high)},
                    {.title = "number of calls",
                     .low = kCountFloor,
                     .high = 2.0 * most,
                     .scale = draw::Axis::Scale::kLog,
                     .ends = draw::Axis::Ends::kExact});
  const auto filled = outline_of(warm);
  std::vector<draw::Point> floor;
  for (const auto& at : filled) floor.push_back({at.x, kCountFloor});
  panel.band(floor, filled, Tone::kBand);
  panel.line(filled, warm_line);
  panel.line(outline_of(cold), cold_line);
  std::vector<draw::Panel::Level> levels{
      {.at = budget_ns,
       .words = fmt::format("cycle {}", duration(budget_ns)),
       .style = {.paint = Tone::kPurple, .width = 1.4, .dashes = "6 3"}}};
  if (!warm.ns.empty())
    levels.push_back({.at = shown_ns(warm.most()),
                      .words = "worst, in the caches: " + duration(warm.most()),
                      .style = {.paint = Tone::kBlue, .width = 1.2}});
  if (!cold.ns.empty())
    levels.push_back({.at = shown_ns(cold.most()),
                      .words = "worst, swept: " + duration(cold.most()),
                      .style = {.paint = Tone::kVermilion, .width = 1.2, .dashes = "6 3"}});
  panel.levels_x(levels);
  return sheet.file();
}

std::string cost_figure(const Benchmark& found, double width) {
  std::size_t left_out = 0;
  const auto parts = parts_of(found, left_out);
  const CostPart* dearest = nullptr;
  for (const CostPart& part : parts) {
    if (part.tone == Tone::kMuted) continue;
    if (dearest == nullptr || part.ns > dearest->ns) dearest = &part;
  }
  const double step = found.cycle().ns.empty() ? 0.0 : found.cycle().median();
  std::string sentence = fmt::format(
      "The whole step takes {}, {} of the cycle; the model has neither effects nor trees.",
      duration(step), percent_of_cycle(found, step));
  if (dearest != nullptr)
    sentence = fmt::format(
        "The whole step takes {}, {} of the cycle; the dearest addition is {}, {} each time the "
        "model is evaluated.",
        duration(step), percent_of_cycle(found, step), dearest->words,
        duration(std::max(0.0, dearest->ns)));
  std::vector<std::string> notes{bench::fitness_text(found.why_not_representative)};
  notes.emplace_back(
      "Medians of calls that wait for each other. An effect stands with what all effects share, "
      "frames and loads, so the bars do not add up. The inverse correction evaluates effects and "
      "trees three times in a step, six joints or others alike.");
  if (left_out > 0) notes.push_back(fmt::format("{} cheaper effects are left out.", left_out));
  std::vector<draw::LegendEntry> legend;
  for (const auto& [tone, words] :
       {std::pair{Tone::kMuted, "always"}, std::pair{Tone::kBlue, "added by an effect"},
        std::pair{Tone::kOrange, "added by the trees"}})
    if (std::any_of(parts.begin(), parts.end(),
                    [of = tone](const CostPart& part) { return part.tone == of; }))
      legend.push_back({.words = words, .area = tone});
  draw::Sheet sheet(width, {.title = "What the parts of the model cost in a cycle",
                            .sentence = sentence,
                            .legend = std::move(legend),
                            .notes = std::move(notes)});
  double most = 1.0;
  for (const CostPart& part : parts) most = std::max(most, part.ns);
  const auto n = static_cast<double>(std::max<std::size_t>(1, parts.size()));
  draw::Panel panel(sheet.svg(), sheet.room(60.0 + kPartRow * n),
                    {.title = "time an evaluation [ns]", .low = 0.0, .high = most},
                    {.low = 0.0, .high = n, .ticks = {{-1.0, ""}}});
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const CostPart& part = parts[i];
    const double top = n - static_cast<double>(i);
    const std::string words = part.words + ": " + duration(std::max(0.0, part.ns));
    panel.bar(0.0, top - 0.92, std::max(0.0, part.ns), top - 0.58, part.tone, {.paint = {}}, words);
    panel.label_at(0.0, top - 0.46, words);
  }
  return sheet.file();
}

}  // namespace plumb::offline::figures

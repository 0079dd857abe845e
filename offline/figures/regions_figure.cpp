// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>

#include "compare/profiles.hpp"
#include "draw/panel.hpp"
#include "draw/sheet.hpp"
#include "draw/text_width.hpp"
#include "figures/data_figures.hpp"
#include "figures/words.hpp"
#include "program/counted_words.hpp"

namespace plumb::offline::figures {
namespace {

using compare::ErrorBin;
using compare::ErrorProfile;
using draw::Tone;

constexpr double kRegionRow = 46.0;  // [px]
constexpr int kFewInRegion = 3;      // poses: a mean of fewer is no finding

/// The judged poses without those that stand out: one of them would colour its whole region.
std::vector<int> region_rows(const RunResults& results) {
  const Fit& fit = results.run.fit;
  return without_outliers(results.judged(),
                          results.held.empty() ? fit.calibration.outliers : fit.held_outliers);
}

std::vector<ErrorProfile> regions_of(const RunResults& results, const std::vector<int>& rows) {
  if (rows.empty()) return {};
  const auto samples = [&](const std::function<double(int)>& value) {
    std::vector<compare::Sample> all;
    std::set<int> seen;
    for (const int row : rows) {
      const int group = results.measured.replicate_group[static_cast<std::size_t>(row)];
      all.push_back(
          {.value = value(row), .error = results.after(row), .repeat = !seen.insert(group).second});
    }
    return all;
  };
  auto out =
      compare::profiles(results.cell, results.measured, results.run.fit.calibration.state, samples);
  std::erase_if(out, [](const ErrorProfile& p) {
    return (p.kind != ErrorProfile::Kind::kJoint && p.kind != ErrorProfile::Kind::kRegion) ||
           p.bins.empty();
  });
  return out;
}

bool is_angle(const ErrorProfile& p) { return p.unit == ErrorProfile::Unit::kAngle; }

std::string border_text(const ErrorProfile& p, double value) {
  return fmt::format("{:.0f}",
                     std::round(value * (is_angle(p) ? 180.0 / std::numbers::pi : 1e3)) + 0.0);
}

std::string region_sentence(const std::vector<ErrorProfile>& profiles) {
  const ErrorProfile* where = nullptr;
  const ErrorBin* worst = nullptr;
  for (const auto& p : profiles)
    for (const auto& bin : p.bins)
      if (p.matters && bin.n >= kFewInRegion && (worst == nullptr || bin.mean > worst->mean))
        where = &p, worst = &bin;
  if (where == nullptr)
    return "The error is much the same everywhere: no joint and no region matters beyond chance.";
  return fmt::format(
      "The error is largest where {} is between {} and {} {}: {} on average over {} "
      "poses, {} times that of the best part.",
      where->name, border_text(*where, worst->from), border_text(*where, worst->to),
      is_angle(*where) ? "deg" : "mm", length_text(worst->mean), worst->n,
      draw::digits(where->contrast(), 2));
}

void draw_profile(const ErrorProfile& p, double y, double most_m, draw::Svg& svg,
                  draw::Panel& panel) {
  const double step = 1.0 / static_cast<double>(p.bins.size());
  for (std::size_t k = 0; k < p.bins.size(); ++k) {
    const ErrorBin& bin = p.bins[k];
    const double left = step * static_cast<double>(k),
                 share = most_m > 0.0 ? bin.mean / most_m : 0.0;
    const bool few = bin.n < kFewInRegion;
    const draw::Paint paint = few ? draw::Paint(Tone::kPaper) : draw::magnitude_colour(share);
    const std::string range = fmt::format("{} {} to {} {}", p.name, border_text(p, bin.from),
                                          border_text(p, bin.to), is_angle(p) ? "deg" : "mm");
    panel.bar(left, y + 0.36, left + step, y + 0.96, paint, {.paint = Tone::kMuted, .width = 0.5},
              bin.n > 0 ? fmt::format("{}: {}, mean {}", range,
                                      counted_words(bin.n, "pose", "poses"), length_text(bin.mean))
                        : range + ": no pose");
    const double room = panel.x_at(left + step) - panel.x_at(left) - 6.0;
    const draw::Paint ink =
        few ? draw::Paint(Tone::kMuted)
            : draw::Paint(std::string(draw::is_bright(share) ? "#000000" : "#ffffff"));
    std::string words = bin.n > 0 ? fmt::format("{} ({})", length_text(bin.mean), bin.n) : "";
    if (draw::text_width(words, 11.0) > room) words = std::to_string(bin.n);
    if (bin.n > 0)
      svg.text({panel.x_at(left + 0.5 * step), panel.y_at(y + 0.66) + 4.0}, draw::Anchor::kMiddle,
               words, {.size = 11.0, .paint = ink});
    svg.text({panel.x_at(left) + (k == 0 ? 2.0 : 0.0), panel.y_at(y + 0.36) + 12.0},
             k == 0 ? draw::Anchor::kStart : draw::Anchor::kMiddle, border_text(p, bin.from),
             {.size = 10.0, .paint = Tone::kMuted});
  }
  svg.text({panel.x_at(1.0) - 2.0, panel.y_at(y + 0.36) + 12.0}, draw::Anchor::kEnd,
           border_text(p, p.bins.back().to), {.size = 10.0, .paint = Tone::kMuted});
}

}  // namespace

std::string regions_figure(const RunResults& results, double width) {
  const auto rows = region_rows(results);
  const auto profiles = regions_of(results, rows);
  double most_m = 0.0;
  for (const auto& p : profiles)
    for (const auto& bin : p.bins)
      if (bin.n >= kFewInRegion) most_m = std::max(most_m, bin.mean);
  auto notes = error_notes(results);
  notes.push_back(
      fmt::format("Colours: mean error of the judged poses, from 0 (dark) to {} (bright); "
                  "in brackets, or alone, the number of poses. A star marks what matters "
                  "beyond chance, all rows counted. Regions are seen from the base.",
                  length_text(most_m)));
  if (const auto left_out = results.judged().size() - rows.size(); left_out > 0)
    notes.push_back(
        fmt::format("{} left out: {} from where the others put {}.",
                    left_out == 1 ? "One pose is" : fmt::format("{} poses are", left_out),
                    left_out == 1 ? "it is far" : "they are far", left_out == 1 ? "it" : "them"));
  notes.push_back(fmt::format("Parts of fewer than {} poses have no colour.", kFewInRegion));
  std::vector<draw::LegendEntry> legend;
  for (const double share : {0.0, 0.5, 1.0})
    legend.push_back({.words = length_text(share * most_m), .area = draw::magnitude_colour(share)});
  draw::Sheet sheet(width, {.title = "Mean error by joint position and region",
                            .sentence = region_sentence(profiles),
                            .legend = std::move(legend),
                            .notes = std::move(notes)});
  const auto n = static_cast<double>(std::max<std::size_t>(1, profiles.size()));
  std::vector<draw::Tick> names{{-1.0, ""}};
  for (std::size_t i = 0; i < profiles.size(); ++i)
    names.push_back({n - static_cast<double>(i) - 0.36,
                     fmt::format("{}{} [{}]", profiles[i].matters ? "* " : "", profiles[i].name,
                                 is_angle(profiles[i]) ? "deg" : "mm")});
  draw::Panel panel(sheet.svg(), sheet.room(30.0 + kRegionRow * n),
                    {.low = 0.0, .high = 1.0, .ticks = {{-1.0, ""}}},
                    {.low = 0.0, .high = n, .ticks = names});
  for (std::size_t i = 0; i < profiles.size(); ++i)
    draw_profile(profiles[i], n - 1.0 - static_cast<double>(i), most_m, sheet.svg(), panel);
  return sheet.file();
}

}  // namespace plumb::offline::figures

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "draw/panel.hpp"
#include "draw/sheet.hpp"
#include "figures/run_figures.hpp"
#include "figures/words.hpp"
#include "program/counted_words.hpp"

namespace plumb::offline::figures {
namespace {

using draw::Tone;

constexpr double kTwoSided = 1.96;  // standard deviations of a 95 % interval
constexpr double kRow = 17.0;       // [px]
constexpr std::size_t kMostRows = 60;

/// Numbers of one kind, which share an axis.
struct Group {
  std::string name, axis;
  double per = 1.0;      // of the axis' unit in one SI unit
  double typical = 0.0;  // 1 sigma of how far arms are built from nominal, SI; 0: none
  std::vector<const Estimate*> rows = {};
};

double change_of(const Estimate& e) { return e.value - e.nominal; }
double sigmas_of(const Estimate& e) { return e.std > 0.0 ? change_of(e) / e.std : 0.0; }

std::vector<Group> groups_of(const RunResults& results) {
  Group lengths{"lengths of the arm", "fitted - nominal [mm]", 1e3, results.cell.fit.prior_m};
  Group angles{"angles of the arm", "fitted - nominal [mrad]", 1e3, results.cell.fit.prior_rad};
  Group effects{"numbers of effects", "fitted value [its standard deviations]", 1.0, 0.0};
  for (const Estimate& e : results.run.fit.calibration.estimates) {
    if (!e.of_robot) continue;
    Group& group = !e.unit.empty() ? effects : e.is_length ? lengths : angles;
    group.rows.push_back(&e);
  }
  std::vector<Group> out;
  for (Group* group : {&lengths, &angles, &effects}) {
    if (group->rows.empty()) continue;
    if (group->rows.size() > kMostRows) {
      std::stable_sort(group->rows.begin(), group->rows.end(), [](const auto* a, const auto* b) {
        return std::abs(sigmas_of(*a)) > std::abs(sigmas_of(*b));
      });
      group->rows.resize(kMostRows);
    }
    out.push_back(std::move(*group));
  }
  return out;
}

std::string change_text(const Estimate& e) {
  return e.is_length ? length_text(change_of(e)) : draw::digits(1e3 * change_of(e), 2) + " mrad";
}

std::string parameters_sentence(const std::vector<Group>& groups) {
  const Estimate* far = nullptr;
  double far_times = 0.0;
  std::size_t all = 0, clear = 0;
  for (const Group& group : groups)
    for (const Estimate* e : group.rows) {
      ++all;
      clear += std::abs(sigmas_of(*e)) > kTwoSided;
      const double times = group.typical > 0.0 ? std::abs(change_of(*e)) / group.typical : 0.0;
      if (times > far_times) far = e, far_times = times;
    }
  if (all == 0) return "No number of the arm was fitted.";
  std::string out = fmt::format(
      "{} of {} fitted numbers differ from nominal beyond their 95 % "
      "interval",
      clear, all);
  if (far == nullptr) return out + ".";
  return out + fmt::format(
                   "; the largest change is that of {}, {}, {} times the usual "
                   "deviation of an arm.",
                   far->name, change_text(*far), draw::digits(far_times, 2));
}

void draw_group(const Group& group, draw::Sheet& sheet) {
  const auto n = static_cast<double>(group.rows.size());
  double most = kTwoSided * group.typical * group.per;
  std::vector<draw::Tick> names;
  for (std::size_t i = 0; i < group.rows.size(); ++i) {
    const Estimate& e = *group.rows[i];
    names.push_back({n - 0.5 - static_cast<double>(i), e.name});
    const bool sigmas = group.typical <= 0.0;
    const double size = sigmas ? std::abs(sigmas_of(e)) + kTwoSided
                               : group.per * (std::abs(change_of(e)) + kTwoSided * e.std);
    most = std::max(most, size);
  }
  draw::Panel panel(sheet.svg(), sheet.room(62.0 + kRow * n),
                    {.title = group.axis, .low = -most, .high = most},
                    {.low = 0.0, .high = n, .ticks = names}, group.name);
  const double band = kTwoSided * group.typical * group.per;
  if (band > 0.0) panel.bar(-band, 0.0, band, n, Tone::kBand);
  panel.line({{0.0, 0.0}, {0.0, n}}, {.paint = Tone::kMuted, .width = 1.0});
  for (std::size_t i = 0; i < group.rows.size(); ++i) {
    const Estimate& e = *group.rows[i];
    const bool sigmas = group.typical <= 0.0;
    const double at = sigmas ? sigmas_of(e) : group.per * change_of(e);
    const double half = sigmas ? kTwoSided : kTwoSided * group.per * e.std;
    const double y = names[i].value;
    panel.line({{at - half, y}, {at + half, y}}, {.paint = Tone::kBlue, .width = 2.0});
    panel.mark(
        at, y,
        {.fill = std::abs(sigmas_of(e)) > kTwoSided ? draw::Mark::Fill::kFilled
                                                    : draw::Mark::Fill::kHollow,
         .size = 3.6,
         .words = sigmas ? fmt::format("{}: {:.4g} {} ± {:.2g}", e.name, e.value, e.unit, e.std)
                         : fmt::format("{}: {} ± {:.2g}, {:.1f} standard deviations", e.name,
                                       change_text(e), group.per * e.std, sigmas_of(e))});
  }
}

}  // namespace

std::string parameters_figure(const RunResults& results, double width) {
  const auto groups = groups_of(results);
  std::vector<std::string> notes{
      "Intervals hold 95 %. The band is where 95 % of arms are built, as [fit] prior_m and "
      "prior_rad "
      "of the cell say or plumb assumes. Tracker frame and reflector are fitted too, and not "
      "shown."};
  std::size_t fitted = 0, shown = 0;
  for (const Estimate& e : results.run.fit.calibration.estimates) fitted += e.of_robot;
  for (const Group& group : groups) shown += group.rows.size();
  notes.push_back(fmt::format(
      "Run {}: {} of the arm fitted, {} of them shown; {} held "
      "at nominal because these poses cannot tell them.",
      results.run.number, counted_words(static_cast<long long>(fitted), "number", "numbers"), shown,
      counted_words(static_cast<long long>(results.run.fit.calibration.held.size()), "was",
                    "were")));
  draw::Sheet sheet(
      width, {.title = "What calibration changed",
              .sentence = parameters_sentence(groups),
              .legend = {{.words = "differs from nominal",
                          .mark = draw::Mark{.fill = draw::Mark::Fill::kFilled, .size = 3.6}},
                         {.words = "may be nominal",
                          .mark = draw::Mark{.fill = draw::Mark::Fill::kHollow, .size = 3.6}},
                         {.words = "usual range of arms", .area = Tone::kBand}},
              .notes = std::move(notes)});
  for (const Group& group : groups) draw_group(group, sheet);
  return sheet.file();
}

}  // namespace plumb::offline::figures

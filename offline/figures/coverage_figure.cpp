// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "draw/panel.hpp"
#include "draw/sheet.hpp"
#include "figures/data_figures.hpp"
#include "figures/words.hpp"
#include "program/counted_words.hpp"

namespace plumb::offline::figures {
namespace {

using draw::Tone;

constexpr int kCoverageBins = 24;
constexpr double kAlmostAll = 0.9;  // of the range of a joint

/// Where the poses lie between the limits of one joint, in [deg] or [mm].
struct JointCoverage {
  std::string name;
  const char* unit = "deg";
  double low = 0.0, high = 1.0;  // limits
  std::vector<int> held = std::vector<int>(kCoverageBins, 0), fit = held;
  double used_low = INFINITY, used_high = -INFINITY;
  double gap_from = 0.0, gap_to = 0.0;  // the widest one, limits included

  /// The widest part without a pose, as a share of the range.
  double gap() const { return high > low ? (gap_to - gap_from) / (high - low) : 0.0; }
  double used() const {
    return high > low && used_high >= used_low ? (used_high - used_low) / (high - low) : 0.0;
  }
};

JointCoverage coverage_of(const RunResults& results, int joint) {
  const auto& row = results.cell.nominal.joints[static_cast<std::size_t>(joint)];
  const bool slides = row.type == format::JointType::kPrismatic;
  const double per = slides ? 1e3 : 180.0 / std::numbers::pi;
  JointCoverage out;
  out.name = row.name;
  out.unit = slides ? "mm" : "deg";
  out.low = per * row.q_min, out.high = per * row.q_max;
  std::vector<double> all;
  const auto add = [&](const std::vector<int>& rows, std::vector<int>& counts) {
    for (const int r : rows) {
      const double q = per * results.measured.q(r, joint);
      all.push_back(q);
      const double share = (q - out.low) / std::max(1e-9, out.high - out.low);
      ++counts[static_cast<std::size_t>(
          std::clamp(share * kCoverageBins, 0.0, kCoverageBins - 1.0))];
    }
  };
  add(results.held, out.held);
  add(results.fit, out.fit);
  if (all.empty()) return out;
  std::sort(all.begin(), all.end());
  out.used_low = all.front(), out.used_high = all.back();
  all.insert(all.begin(), out.low);
  all.push_back(out.high);
  for (std::size_t i = 1; i < all.size(); ++i)
    if (all[i] - all[i - 1] > out.gap_to - out.gap_from)
      out.gap_from = all[i - 1], out.gap_to = all[i];
  return out;
}

std::string coverage_sentence(const std::vector<JointCoverage>& joints) {
  const JointCoverage* least = nullptr;
  for (const auto& joint : joints)
    if (least == nullptr || joint.used() < least->used()) least = &joint;
  if (least == nullptr || least->used_high < least->used_low) return "No pose is in use.";
  if (least->used() >= kAlmostAll) {
    const JointCoverage* widest = least;
    for (const auto& joint : joints)
      if (joint.gap() > widest->gap()) widest = &joint;
    return fmt::format(
        "Every joint used at least {:.0f} % of its range; the widest part without a pose is that "
        "of {} between {:.0f} and {:.0f} {}.",
        std::floor(100.0 * least->used()), widest->name, widest->gap_from, widest->gap_to,
        widest->unit);
  }
  return fmt::format(
      "{} used the least of its range: {:.0f} to {:.0f} {}, {:.0f} % of it; nothing "
      "was measured between {:.0f} and {:.0f} {}.",
      least->name, least->used_low, least->used_high, least->unit, 100.0 * least->used(),
      least->gap_from, least->gap_to, least->unit);
}

/// True if the run was made with folds: every pose is then held out once.
bool in_folds(const RunResults& results) {
  return results.run.fit.split.folds > 0 && results.fit.empty();
}

std::vector<draw::LegendEntry> coverage_legend(const RunResults& results) {
  if (in_folds(results)) return {{.words = "fitted, and held out once", .area = Tone::kBlue}};
  return {{.words = "held out", .area = Tone::kBlue},
          {.words = "fitted (outline)", .line = draw::LineStyle{Tone::kBlue, 1.4}}};
}

std::string coverage_counts(const RunResults& results) {
  if (in_folds(results))
    return fmt::format("{}, each held out in one of {} folds",
                       counted_words(static_cast<long long>(results.held.size()), "pose", "poses"),
                       results.run.fit.split.folds);
  return fmt::format(
      "{} held-out and {}", results.held.size(),
      counted_words(static_cast<long long>(results.fit.size()), "fitted pose", "fitted poses"));
}

}  // namespace

std::string coverage_figure(const RunResults& results, double width) {
  std::vector<JointCoverage> joints;
  int most = 1;
  for (int j = 0; j < results.cell.joints(); ++j) {
    joints.push_back(coverage_of(results, j));
    for (const auto* counts : {&joints.back().held, &joints.back().fit})
      for (const int n : *counts) most = std::max(most, n);
  }
  draw::Sheet sheet(width,
                    {.title = "Which part of the joint ranges was measured",
                     .sentence = coverage_sentence(joints),
                     .legend = coverage_legend(results),
                     .notes = {fmt::format(
                         "Run {}: {}. Each panel spans the limits of its joint in the cell; all "
                         "count on one scale.",
                         results.run.number, coverage_counts(results))}});
  const auto rooms = sheet.grid(static_cast<int>(joints.size()), 240.0, 170.0);
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const auto& joint = joints[k];
    draw::Panel panel(sheet.svg(), rooms[k],
                      {.title = fmt::format("position [{}]", joint.unit),
                       .low = joint.low,
                       .high = joint.high,
                       .ends = draw::Axis::Ends::kExact},
                      {.title = "poses", .low = 0.0, .high = static_cast<double>(most)},
                      joint.name);
    const double step = (panel.x_high() - panel.x_low()) / kCoverageBins;
    for (int i = 0; i < kCoverageBins; ++i) {
      const double from = panel.x_low() + step * i;
      const auto at = static_cast<std::size_t>(i);
      if (joint.held[at] > 0)
        panel.bar(from, 0.0, from + step, joint.held[at], Tone::kBlue,
                  {.paint = Tone::kPaper, .width = 0.4});
      if (joint.fit[at] > 0)
        panel.bar(from, 0.0, from + step, joint.fit[at], {}, {.paint = Tone::kBlue, .width = 1.1});
    }
  }
  return sheet.file();
}

}  // namespace plumb::offline::figures

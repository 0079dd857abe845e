// SPDX-License-Identifier: Apache-2.0
#include "figures/evidence_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "draw/panel.hpp"
#include "draw/sheet.hpp"
#include "effects/registry.hpp"
#include "figures/words.hpp"
#include "program/counted_words.hpp"

namespace plumb::offline::figures {
namespace {

using draw::Tone;

constexpr std::size_t kMostCandidates = 12;  // are drawn
constexpr double kCandidateRow = 44.0;       // [px]
constexpr double kLargestLn = 1000.0;        // beyond it "over 1000"

std::string joint_names(const Cell& cell, const std::vector<int>& joints,
                        const std::string& between, const std::string& last) {
  std::vector<std::string> names;
  for (const int j : joints) names.push_back(cell.nominal.joints[static_cast<std::size_t>(j)].name);
  std::string out;
  for (std::size_t i = 0; i < names.size(); ++i)
    out += (i == 0 ? "" : i + 1 == names.size() ? last : between) + names[i];
  return out;
}

std::string candidate_name(const Cell& cell, const Candidate& c) {
  if (c.entry.joints.empty()) return c.title;
  return c.title + (is_change_point(c.entry.name) ? " at " : " of ") +
         joint_names(cell, c.entry.joints, ", ", " and ");
}

/// "gear_harmonics:J2", as other candidates name it.
std::string candidate_key(const Cell& cell, const Candidate& c) {
  return c.entry.joints.empty() ? c.entry.name
                                : c.entry.name + ":" + joint_names(cell, c.entry.joints, "+", "+");
}

bool is_like_first(const Cell& cell, const Candidate& first, const Candidate& c) {
  const std::string key = candidate_key(cell, c);
  return std::any_of(first.confounded_with.begin(), first.confounded_with.end(),
                     [&](const auto& name) { return name == key || name.starts_with(key + "@"); });
}

std::string ln_text(double ln_bayes) {
  if (std::abs(ln_bayes) > kLargestLn) return ln_bayes > 0.0 ? "over 1000" : "below -1000";
  return fmt::format("{:.0f}", std::round(ln_bayes) + 0.0);
}

std::string evidence_sentence(const Cell& cell, const Diagnosis& d) {
  if (d.candidates.empty()) return "No effect of the library can be judged with these data.";
  const Candidate& first = d.candidates.front();
  const std::string name = candidate_name(cell, first);
  if (!first.supported)
    return fmt::format(
        "No further effect is supported: the first one, {}, would {} the error by {:.1f} ± "
        "{:.1f} %.",
        name, first.gain < 0.0 ? "raise" : "lower", 100.0 * std::abs(first.gain),
        100.0 * first.gain_se);
  std::string out = fmt::format("Adding {} takes the mean error of held-out poses from {} to {}",
                                name, length_text(d.before.mean), length_text(first.alone.mean));
  if (d.before.n == 0)
    out = fmt::format("Adding {} lowers the error by {:.0f} % in cross-validation", name,
                      100.0 * first.gain);
  const auto like = static_cast<std::size_t>(
      std::count_if(d.candidates.begin(), d.candidates.end(),
                    [&](const Candidate& c) { return is_like_first(cell, first, c); }));
  if (like > 0)
    return out + fmt::format("; these poses hardly tell it from {} other {}.", like,
                             like == 1 ? "effect" : "effects");
  return out + "; no other effect imitates it.";
}

std::string figures_text(const Candidate& c, bool is_first) {
  std::string out = "ln Bayes " + ln_text(c.ln_bayes);
  if (c.alone.n > 0) out += "; alone " + length_text(c.alone.mean);
  if (!is_first && c.after.n > 0) out += "; with the first " + length_text(c.after.mean);
  return out;
}

Tone tone_of(const Candidate& c) {
  return !c.supported ? Tone::kGrid : c.plausible ? Tone::kBlue : Tone::kOrange;
}

/// Legend entries for what occurs among the first `n` candidates.
std::vector<draw::LegendEntry> evidence_legend(const Cell& cell, const Diagnosis& d,
                                               std::size_t n) {
  std::vector<draw::LegendEntry> out;
  const auto any = [&](const auto& is) {
    return std::any_of(d.candidates.begin(), d.candidates.begin() + static_cast<std::ptrdiff_t>(n),
                       is);
  };
  for (const auto& [tone, words] : {std::pair{Tone::kBlue, "supported"},
                                    std::pair{Tone::kOrange, "supported, of an unusual size"},
                                    std::pair{Tone::kGrid, "not supported"}})
    if (any([of = tone](const Candidate& c) { return tone_of(c) == of; }))
      out.push_back({.words = words, .area = tone});
  if (any([&](const Candidate& c) {
        return &c != &d.candidates.front() && is_like_first(cell, d.candidates.front(), c);
      }))
    out.push_back({.words = "hard to tell from the first",
                   .mark = draw::Mark{draw::Shape::kDiamond, Tone::kPurple}});
  return out;
}

std::string poses_text(const Diagnosis& d) {
  if (d.folds > 0)
    return fmt::format("{}, each held out in one of {} folds",
                       counted_words(d.poses_held, "pose", "poses"), d.folds);
  return fmt::format("{} fitted and {}", d.poses_fit,
                     counted_words(d.poses_held, "held-out pose", "held-out poses"));
}

}  // namespace

std::string evidence(const Cell& cell, const Diagnosis& d, double width) {
  const std::size_t n = std::min(kMostCandidates, d.candidates.size());
  std::vector<std::string> notes{
      "Bars: by how much the RMS error falls if this effect is added, cross-validated inside the "
      "fit "
      "poses; the line is one standard error either way. ln Bayes: the evidence, by which they are "
      "sorted. mm: mean error of the held-out poses, e = measured - predicted.",
      fmt::format(
          "The present model of the cell: {}, {} held-out error. {} of {} candidates are shown; {} "
          "effects cannot be tested with these data.",
          poses_text(d), length_text(d.before.mean), n, d.candidates.size(),
          d.not_testable.size())};
  draw::Sheet sheet(width, {.title = "Which effect is missing",
                            .sentence = evidence_sentence(cell, d),
                            .legend = evidence_legend(cell, d, n),
                            .notes = std::move(notes)});
  double low = 0.0, high = 1.0;
  for (std::size_t i = 0; i < n; ++i) {
    const Candidate& c = d.candidates[i];
    low = std::min(low, 100.0 * (c.gain - c.gain_se));
    high = std::max(high, 100.0 * (c.gain + c.gain_se));
  }
  const auto rows = static_cast<double>(std::max<std::size_t>(1, n));
  draw::Panel panel(
      sheet.svg(), sheet.room(60.0 + kCandidateRow * rows),
      {.title = "fall of the RMS error [%]", .low = std::max(low, -100.0), .high = high},
      {.low = 0.0, .high = rows, .ticks = {{-1.0, ""}}});
  for (std::size_t i = 0; i < n; ++i) {
    const Candidate& c = d.candidates[i];
    const double top = rows - static_cast<double>(i), gain = 100.0 * c.gain, se = 100.0 * c.gain_se;
    const Tone tone = tone_of(c);
    panel.bar(0.0, top - 0.95, std::max(gain, panel.x_low()), top - 0.72, tone,
              {.paint = Tone::kMuted, .width = 0.6},
              fmt::format("{}: {:.1f} ± {:.1f} %", candidate_name(cell, c), gain, se));
    panel.line({{std::max(gain - se, panel.x_low()), top - 0.835}, {gain + se, top - 0.835}},
               {.paint = Tone::kInk, .width = 1.6});
    if (i > 0 && is_like_first(cell, d.candidates.front(), c))
      panel.mark(std::max(panel.x_low(), std::max(gain + se, 0.0)) +
                     0.02 * (panel.x_high() - panel.x_low()),
                 top - 0.835,
                 {.shape = draw::Shape::kDiamond, .paint = Tone::kPurple, .size = 3.2});
    panel.label_at(panel.x_low(), top - 0.28,
                   fmt::format("{}. {}", i + 1, candidate_name(cell, c)));
    panel.label_at(panel.x_low(), top - 0.61, figures_text(c, i == 0));
  }
  return sheet.file();
}

}  // namespace plumb::offline::figures

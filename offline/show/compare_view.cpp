// SPDX-License-Identifier: Apache-2.0
#include "show/compare_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fit/verdict.hpp"
#include "noise/main_jump.hpp"
#include "show/compare_words.hpp"
#include "show/error_table.hpp"
#include "show/heads.hpp"
#include "show/table.hpp"
#include "show/units.hpp"

namespace plumb::offline::show {
namespace {

using compare::Comparison;
using compare::ErrorProfile;

constexpr std::size_t kWorstListed = 10, kWorstOrientations = 5;
constexpr std::size_t kProfilesShown = 4;
constexpr int kBarWidth = 18;

std::string percent(double share) { return fmt::format("{:.1f} %", 100.0 * share); }

std::string within_words(const Comparison& comparison, const Fit& fit, double tolerance_m) {
  if (fit.held.n == 0)
    return fmt::format("Within the tolerance of {} mm: {} of the fitted readings.", mm(tolerance_m),
                       percent(comparison.fit_within_tolerance));
  return fmt::format(
      "Within the tolerance of {} mm: {} of the held-out readings, {} of the fitted.",
      mm(tolerance_m), percent(comparison.within_tolerance),
      percent(comparison.fit_within_tolerance));
}

std::string title(const ErrorProfile& profile) {
  const std::string unit = unit_name(profile.unit);
  return quantity_words(profile) + (unit.empty() ? "" : " [" + unit + "]");
}

/// As many decimals as tell one bin from the next.
std::string range_text(const ErrorProfile& profile, const compare::ErrorBin& bin) {
  if (profile.unit == ErrorProfile::Unit::kName)
    return profile.names[static_cast<std::size_t>(bin.from)];
  if (profile.unit == ErrorProfile::Unit::kSign) return fmt::format("{:+.0f}", bin.from);
  const double step = std::abs(in_unit(bin.to, profile.unit) - in_unit(bin.from, profile.unit));
  const int digits = step >= 2.0 || step == 0.0 ? 0 : step >= 0.2 ? 1 : 2;
  return fmt::format("{:9.{}f} .. {:.{}f}", in_unit(bin.from, profile.unit), digits,
                     in_unit(bin.to, profile.unit), digits);
}

/// What the errors of a profile are of.
struct ErrorOf {
  const char* caption;
  std::string (*text)(double si);
};
constexpr ErrorOf kOfPosition{"Mean error [mm] by ", mm};
constexpr ErrorOf kOfOrientation{"Mean orientation error [deg] by ", deg};

Table profile_table(const ErrorProfile& profile, Comparison::Set set,
                    const ErrorOf& of = kOfPosition) {
  double most = 0.0;
  for (const auto& bin : profile.bins) most = std::max(most, bin.mean);
  const bool held = set == Comparison::Set::kHeldOut;
  std::vector<std::string> header{title(profile), held ? "held-out" : "fit", "mean", ""};
  if (held) header.insert(header.end() - 1, {"fit", "mean"});
  Table table{.name = "profile",
              .caption = of.caption + title(profile),
              .goes_on = true,
              .head = header,
              .left_from = header.size() - 1};
  const auto mean = [&](int n, double value) { return n > 0 ? of.text(value) : "-"; };
  for (const auto& bin : profile.bins) {
    const int bar = most > 0 ? static_cast<int>(std::lround(bin.mean / most * kBarWidth)) : 0;
    std::vector<std::string> row{range_text(profile, bin), fmt::format("{}", bin.n),
                                 mean(bin.n, bin.mean)};
    if (held) {
      row.push_back(fmt::format("{}", bin.fit_n));
      row.push_back(mean(bin.fit_n, bin.fit_mean));
    }
    row.emplace_back(static_cast<std::size_t>(bar), '#');
    table.add(std::move(row));
  }
  return table;
}

/// The profiles that matter, the strongest first.
std::vector<const ErrorProfile*> chosen_profiles(const std::vector<ErrorProfile>& profiles) {
  std::vector<const ErrorProfile*> chosen;
  for (const auto& profile : profiles)
    if (profile.matters && profile.kind != ErrorProfile::Kind::kSetup) chosen.push_back(&profile);
  std::stable_sort(chosen.begin(), chosen.end(),
                   [](auto* a, auto* b) { return a->ln_p < b->ln_p; });
  if (chosen.size() > kProfilesShown) chosen.resize(kProfilesShown);
  return chosen;
}

/// Set-ups are listed whether or not they differ: that they do not is worth knowing.
Blocks setups_blocks(const Comparison& comparison) {
  for (const auto& profile : comparison.profiles) {
    if (profile.kind != ErrorProfile::Kind::kSetup) continue;
    Table table = profile_table(profile, comparison.set);
    table.caption =
        fmt::format("Mean error by set-up [mm]; the set-ups {}",
                    profile.matters ? "differ beyond chance" : "differ no more than by chance");
    table.captioned = true;
    table.goes_on = false;
    return {std::move(table)};
  }
  return {};
}

/// Where orientations fail.
Blocks turn_blocks(const Cell& cell, const Comparison& comparison) {
  const auto& turns = comparison.turns;
  if (turns.poses.empty()) return {};
  Table worst{.name = "worst_orientations",
              .caption = "Orientations that are missed most [deg]",
              .captioned = true,
              .head = {"pose", "orientation error"}};
  for (std::size_t i = 0; i < std::min(kWorstOrientations, turns.poses.size()); ++i)
    worst.add({turns.poses[i].pose, deg(turns.poses[i].error_rad)});
  Blocks out;
  for (auto& words : {turning_joint_words(cell, turns),
                      dependence_words(turns.profiles, "The orientation error")})
    if (!words.empty()) out.emplace_back(Sentence{words});
  if (out.empty())
    out.emplace_back(Sentence{"Nothing explains the orientation error beyond chance."});
  out.emplace_back(Figure{"orientations"});
  out.emplace_back(std::move(worst));
  const auto chosen = chosen_profiles(turns.profiles);
  if (!chosen.empty())
    out.emplace_back(profile_table(*chosen.front(), comparison.set, kOfOrientation));
  return out;
}

}  // namespace

std::string after_comparison(const Cell& cell, const Comparison& comparison, const Fit& fit,
                             const Answers& answers) {
  if (!comparison.changes.steps.empty() || !comparison.changes.drifts.empty())
    return "diagnose   # puts it into the model, if the readings support it";
  if (!answers.next.starts_with("compare")) return answers.next;
  switch (quality(fit, cell.tolerance_m)) {
    case Quality::kWorstPoseIsFar:
      return "check   # is one of the readings wrong?";
    case Quality::kLimitedByNoise:
    case Quality::kPerhapsLimitedByJoints:
      return "check   # how large are noise and rounding of the readings?";
    default:
      return "plan --n 30   # which poses to measure next";
  }
}

Blocks tolerance_blocks(const Cell& cell, const Measurements& measured,
                        const Comparison& comparison, const Fit& fit) {
  Blocks out = error_blocks(measured, fit);
  out.emplace_back(Note{within_words(comparison, fit, cell.tolerance_m), Note::Stands::kBelow});
  return out;
}

/// A jump is called the cause only if it explains enough of the squared error. Otherwise something
/// else is missing, and that may look like a jump where the poses change.
Blocks moved_blocks(const Cell& cell, const Measurements& measured, const Comparison& comparison) {
  const auto& steps = comparison.changes.steps;
  if (steps.empty() || !is_clear(steps.front())) return {};
  const double share = share_of_error(steps.front(), comparison.stats.rms,
                                      static_cast<double>(measured.pose.size()));
  if (!is_possible(share)) return {};
  const std::string step = step_words(cell, measured, steps.front());
  if (is_cause(share)) return {Sentence{"Something moved during the measurement: " + step + "."}};
  return {Sentence{fmt::format(
      "Possibly something moved too: {}. It would cause at most {:.0f} % of the squared "
      "error; what else is missing may look like a jump, so diagnose first.",
      step, std::ceil(100.0 * share))}};
}

Blocks pattern_blocks(const Cell& cell, const Measurements& measured, const Comparison& comparison,
                      const Fit& fit) {
  Blocks out = setups_blocks(comparison);
  for (auto& words : {lack_of_fit_words(comparison.lack_of_fit, fit), joint_words(cell, comparison),
                      order_words(comparison.order), changes_words(comparison.changes)})
    out.emplace_back(Sentence{words});
  for (const auto& step : comparison.changes.steps)
    out.emplace_back(under(step_words(cell, measured, step)));
  for (const auto& drift : comparison.changes.drifts)
    out.emplace_back(under(drift_words(cell, measured, drift)));
  return out;
}

Blocks where_blocks(const Cell& cell, const Comparison& comparison, const Answers& answers) {
  Blocks out{Sentence{answers.where}, Figure{"error-map"}};
  if (const auto words = dependence_words(comparison.profiles, "The error"); !words.empty())
    out.emplace_back(Sentence{words});
  const auto chosen = chosen_profiles(comparison.profiles);
  if (!chosen.empty())
    out.emplace_back(Sentence{comparison.set == Comparison::Set::kHeldOut
                                  ? "Number of readings and their mean error [mm], of the held-out "
                                    "ones and of the fitted:"
                                  : "Number of readings and their mean error [mm]:"});
  for (const auto* profile : chosen) out.emplace_back(profile_table(*profile, comparison.set));
  append(out, turn_blocks(cell, comparison));
  return out;
}

Blocks compare_blocks(const Cell& cell, const Measurements& measured, const Comparison& comparison,
                      const Run& run, const Answers& answers) {
  Blocks out{Sentence{answers.sentence, name_of(grade(run.fit, cell.tolerance_m))}};
  append(out, moved_blocks(cell, measured, comparison));
  append(out, tolerance_blocks(cell, measured, comparison, run.fit));
  append(out, pattern_blocks(cell, measured, comparison, run.fit));
  out.emplace_back(worst_table(comparison));
  append(out, where_blocks(cell, comparison, answers));
  return out;
}

Table worst_table(const Comparison& comparison) {
  const bool held = comparison.set == Comparison::Set::kHeldOut;
  Table table{.name = "worst",
              .caption = fmt::format("Worst {} readings [mm], measured - predicted in the "
                                     "measurement frame",
                                     held ? "held-out" : "fitted"),
              .captioned = true,
              .head = {"pose", "error", "dx", "dy", "dz"}};
  for (std::size_t i = 0; i < std::min(kWorstListed, comparison.poses.size()); ++i) {
    const auto& pose = comparison.poses[i];
    std::vector<std::string> row{pose.pose, mm(pose.error_M.norm())};
    for (int k = 0; k < 3; ++k) row.push_back(fmt::format("{:+.3f}", to_mm(pose.error_M(k))));
    table.add(std::move(row));
  }
  return table;
}

}  // namespace plumb::offline::show

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

constexpr std::size_t kWorstListed = 10;
constexpr std::size_t kProfilesShown = 4;
constexpr int kBarWidth = 18;

std::string percent(double share) { return fmt::format("{:.1f} %", 100.0 * share); }

std::string within_text(const Comparison& comparison, const Fit& fit, double tolerance_m) {
  if (fit.held.n == 0)
    return fmt::format("Within the tolerance of {} mm: {} of the fitted readings.\n",
                       mm(tolerance_m), percent(comparison.fit_within_tolerance));
  return fmt::format(
      "Within the tolerance of {} mm: {} of the held-out readings, {} of the fitted.\n",
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

std::string profile_text(const ErrorProfile& profile, Comparison::Set set) {
  double most = 0.0;
  for (const auto& bin : profile.bins) most = std::max(most, bin.mean_m);
  const bool held = set == Comparison::Set::kHeldOut;
  std::vector<std::string> header{title(profile), held ? "held-out" : "fit", "mean", ""};
  if (held) header.insert(header.end() - 1, {"fit", "mean"});
  Table table{.head = header};
  table.left_from = header.size() - 1;
  const auto mean = [](int n, double value) { return n > 0 ? mm(value) : "-"; };
  for (const auto& bin : profile.bins) {
    const int bar = most > 0 ? static_cast<int>(std::lround(bin.mean_m / most * kBarWidth)) : 0;
    std::vector<std::string> row{range_text(profile, bin), fmt::format("{}", bin.n),
                                 mean(bin.n, bin.mean_m)};
    if (held) {
      row.push_back(fmt::format("{}", bin.fit_n));
      row.push_back(mean(bin.fit_n, bin.fit_mean_m));
    }
    row.emplace_back(static_cast<std::size_t>(bar), '#');
    table.add(std::move(row));
  }
  return text_of(table);
}

/// The profiles that matter, the strongest first.
std::string where_text(const Comparison& comparison) {
  std::vector<const ErrorProfile*> chosen;
  for (const auto& profile : comparison.profiles)
    if (profile.matters && profile.kind != ErrorProfile::Kind::kSetup) chosen.push_back(&profile);
  std::stable_sort(chosen.begin(), chosen.end(),
                   [](auto* a, auto* b) { return a->ln_p < b->ln_p; });
  if (chosen.size() > kProfilesShown) chosen.resize(kProfilesShown);
  std::string out = "\n" + where_words(comparison) + "\n";
  if (!chosen.empty())
    out += comparison.set == Comparison::Set::kHeldOut
               ? "Number of readings and their mean error [mm], of the held-out ones and of the "
                 "fitted:\n"
               : "Number of readings and their mean error [mm]:\n";
  for (const auto* profile : chosen) out += profile_text(*profile, comparison.set);
  return out;
}

std::string findings_text(const Cell& cell, const Measurements& measured,
                          const Comparison& comparison, const Fit& fit) {
  std::string out = "\n" + lack_of_fit_words(comparison.lack_of_fit, fit) + "\n" +
                    joint_words(cell, comparison) + "\n" + order_words(comparison.order) + "\n" +
                    changes_words(comparison.changes) + "\n";
  for (const auto& step : comparison.changes.steps)
    out += "  " + step_words(cell, measured, step) + "\n";
  for (const auto& drift : comparison.changes.drifts)
    out += "  " + drift_words(cell, measured, drift) + "\n";
  return out;
}

/// Set-ups are listed whether or not they differ: that they do not is worth knowing.
std::string setups_text(const Comparison& comparison) {
  for (const auto& profile : comparison.profiles)
    if (profile.kind == ErrorProfile::Kind::kSetup)
      return fmt::format(
                 "\nMean error by set-up [mm]; the set-ups {}\n",
                 profile.matters ? "differ beyond chance" : "differ no more than by chance") +
             profile_text(profile, comparison.set);
  return "";
}

/// A jump is called the cause only if it explains enough of the squared error. Otherwise something
/// else is missing, and that may look like a jump where the poses change.
std::string compare_verdict(const Cell& cell, const Measurements& measured,
                            const Comparison& comparison, const std::string& error) {
  const auto& steps = comparison.changes.steps;
  if (steps.empty() || !is_clear(steps.front())) return error;
  const double share = share_of_error(steps.front(), comparison.stats.rms,
                                      static_cast<double>(measured.pose.size()));
  if (!is_possible(share)) return error;
  if (!is_cause(share))
    return fmt::format(
        "{}\nPossibly something moved too: {}. It would cause at most {:.0f} % of the squared "
        "error; what else is missing may look like a jump, so diagnose first.",
        error, step_words(cell, measured, steps.front()), std::ceil(100.0 * share));
  return fmt::format("{}\nSomething moved during the measurement: {}.", error,
                     step_words(cell, measured, steps.front()));
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

std::string compare_text(const Cell& cell, const Measurements& measured,
                         const Comparison& comparison, const Run& run, const Answers& answers) {
  const double tolerance_m = cell.tolerance_m;
  const Table worst = worst_table(comparison);
  return compare_verdict(cell, measured, comparison, answers.sentence) + "\n\n" +
         text_of(error_blocks(measured, run.fit)) + within_text(comparison, run.fit, tolerance_m) +
         setups_text(comparison) + findings_text(cell, measured, comparison, run.fit) + "\n" +
         worst.caption + "\n" + text_of(worst) + where_text(comparison);
}

Table worst_table(const Comparison& comparison) {
  const bool held = comparison.set == Comparison::Set::kHeldOut;
  Table table{.caption = fmt::format("Worst {} readings [mm], measured - predicted in the "
                                     "measurement frame",
                                     held ? "held-out" : "fitted"),
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

// SPDX-License-Identifier: Apache-2.0
#include "fit/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "fit/constants.hpp"
#include "noise/usual_errors.hpp"
#include "program/counted_words.hpp"

namespace plumb::offline {
namespace {

constexpr std::size_t kNamed = 3;  // readings that stand out, in a headline

std::string mm(double m) { return fmt::format("{:.3f} mm", m * 1e3); }

std::string readings(int n) { return counted_words(n, "reading", "readings"); }

bool leaves_out(const Fit& fit) { return !single_bad(fit).empty(); }

/// Names of the poses of the outliers, each once; empty if a name is missing.
std::vector<std::string> names_of(const std::vector<Outlier>& outliers) {
  std::vector<std::string> out;
  for (const auto& one : outliers) {
    if (one.pose.empty()) return {};
    if (std::find(out.begin(), out.end(), one.pose) == out.end()) out.push_back(one.pose);
  }
  return out;
}

/// "P7, P24, P41"; "12 readings" if they are many.
std::string who_stands_out(const Fit& fit) {
  const auto names = names_of(fit.held_outliers);
  if (names.empty() || names.size() > kNamed)
    return readings(static_cast<int>(fit.held_outliers.size()));
  return fmt::format("{}", fmt::join(names, ", "));
}

/// "P7, P24, P41, which miss by 3.012 to 5.100 mm"
std::string outlier_words(const Fit& fit) {
  const auto& all = fit.held_outliers;
  const auto [least, most] = std::minmax_element(
      all.begin(), all.end(), [](const auto& a, const auto& b) { return a.error_m < b.error_m; });
  if (all.size() == 1)
    return fmt::format("{}, which misses by {}", who_stands_out(fit), mm(most->error_m));
  return fmt::format("{}, which miss by {:.3f} to {}", who_stands_out(fit), least->error_m * 1e3,
                     mm(most->error_m));
}

/// "held-out error 0.164 mm mean, 0.384 mm at 95 % of 48 readings", and the readings left out.
std::string size_words(const Fit& fit) {
  const ErrorStats& held = usual_held(fit);
  std::string out = fmt::format("held-out error {} mean, {} at 95 % of {}", mm(held.mean),
                                mm(held.p95), readings(held.n));
  if (leaves_out(fit)) return out + " (without " + outlier_words(fit) + ")";
  if (fit.held_outliers.empty()) return out;
  return out + fmt::format(" ({} of them stand out, too many for single bad readings)",
                           fit.held_outliers.size());
}

std::string floor_words(const Fit& fit) { return offline::floor_words(fit.floor); }

/// The excess of a fit; without a noise floor or held-out poses that of an error of 0.
HeldOutExcess left(const Fit& fit) { return held_out_excess_of(fit).value_or(HeldOutExcess{}); }
double times_floor(const Fit& fit) { return left(fit).times; }

/// "6.5 times the noise floor 0.016 mm"
std::string times_words(const Fit& fit) {
  return fmt::format("{:.1f} times the {}", times_floor(fit), floor_words(fit));
}

/// Says that the error may be scatter of the joints, which a diagnosis has inferred from residuals.
std::string scatter_words(const Fit& fit) {
  return fmt::format(
      "{}, no more than joints would leave that do not come back to exactly the same place ({}, "
      "inferred from what the model leaves); repeat some poses, each approached anew, to measure "
      "it",
      times_words(fit), mm(fit.floor.inferred_m));
}

/// Whether something that the model lacks turns the tool.
bool turned(const Fit& fit) {
  const auto excess = turn_excess_of(fit);
  return excess && excess->lack_of_fit();
}

/// How far the orientations miss, and what that may be.
std::string turned_words(const Fit& fit) {
  const std::string missed = missed_words(fit.turn_held.mean, fit.turn_floor);
  return fit.turn_floor.source == NoiseFloor::Source::kSigma
             ? missed +
                   ": they scatter by more than sigma_urad says, or something that turns the tool "
                   "is missing; repeats of some poses would tell"
             : missed +
                   ": something that turns the tool is missing, or they have errors of their own "
                   "that repeats do not show";
}

Quality quality_within(const Fit& fit) {
  const double times = times_floor(fit);
  if (left(fit).lack_of_fit()) return Quality::kGoodNotComplete;
  if (turned(fit)) return Quality::kGoodButTurned;
  if (times <= 0.0 || times >= kBelowTheFloor) return Quality::kGood;
  return fit.floor.source == NoiseFloor::Source::kRepeats ? Quality::kRepeatsDisagree
                                                          : Quality::kSigmaTooLarge;
}

Quality quality_beyond(const Fit& fit) {
  const bool measured_floor = fit.floor.source == NoiseFloor::Source::kRepeats;
  if (!measured_floor && times_floor(fit) < kBelowTheFloor) return Quality::kBeyondSigmaTooLarge;
  if (!left(fit).lack_of_fit() && turned(fit)) return Quality::kBeyondAndTurned;
  switch (left(fit).level()) {
    case HeldOutExcess::Level::kAtTheFloor:
      return Quality::kLimitedByNoise;
    case HeldOutExcess::Level::kAsFewPosesLeaveIt:
      return Quality::kTooFewPoses;
    case HeldOutExcess::Level::kAsScatterLeavesIt:
      return Quality::kPerhapsLimitedByJoints;
    default:
      return Quality::kBeyond;
  }
}

/// Whether the tolerance is kept only without the readings that stand out.
bool good_but_for_some(const Fit& fit, double tolerance_m) {
  return leaves_out(fit) && keeps(usual_held(fit), tolerance_m) && !keeps(fit.held, tolerance_m);
}

/// "Good", restricted to what the poses show: nothing is known of joints that never moved, nor of
/// the size of an arm where no length was read.
std::string good(const Fit& fit, double tolerance_m) {
  std::string but = good_but_for_some(fit, tolerance_m) ? " but for " + who_stands_out(fit) : "";
  if (fit.size_unknown) but = " in shape, of unknown size" + but;
  if (fit.still.empty()) return "Good" + but;
  return fmt::format("Good{} only while {} {} where {}", but, fmt::join(fit.still, ", "),
                     fit.still.size() == 1 ? "stays" : "stay",
                     fit.still.size() == 1 ? "it was" : "they were");
}

std::string good_words(const Fit& fit, const std::string& size, double tolerance_m) {
  const std::string head = good(fit, tolerance_m);
  const bool measured_floor = fit.floor.source == NoiseFloor::Source::kRepeats;
  switch (left(fit).level()) {
    case HeldOutExcess::Level::kAtTheFloor:
      return fmt::format("{}: {}, at the {}; {}.", head, size, floor_words(fit),
                         measured_floor
                             ? "nothing more can be learnt from these poses"
                             : "repeats of a few poses would tell whether more can be learnt");
    case HeldOutExcess::Level::kAsScatterLeavesIt:
      return fmt::format("{}: {}, within {}; {}.", head, size, mm(tolerance_m), scatter_words(fit));
    default:
      return fmt::format("{}: {}, within {}; {}, as few poses leave it.", head, size,
                         mm(tolerance_m), times_words(fit));
  }
}

/// The readings that stand out may be bad, or the model may fail at their poses; this cannot be
/// told from the errors.
std::string but_for_words(const Fit& fit, const std::string& size, double tolerance_m) {
  const std::string kept =
      fmt::format("{}: {}, within {}", good(fit, tolerance_m), size, mm(tolerance_m));
  const auto excess = held_out_excess_of(fit);
  const std::string floor = excess ? "; " + times_words(fit) : "";
  return fmt::format("{}{}. Bad readings, or poses where the model fails: measure them again.",
                     kept, floor);
}

std::string limited_words(const Fit& fit, const std::string& size, double tolerance_m) {
  const std::string out =
      fmt::format("Limited by the measurement: {}, at the {}, ", size, floor_words(fit));
  if (fit.floor.source == NoiseFloor::Source::kRepeats)
    return out + fmt::format(
                     "but the tolerance is {}: repeats of a pose scatter that much, or "
                     "something moved between them.",
                     mm(tolerance_m));
  return out + fmt::format("but the tolerance is {}.", mm(tolerance_m));
}

}  // namespace

std::span<const Outlier> single_bad(const Fit& fit) {
  const bool single = are_single(fit.held_outliers.size(), static_cast<std::size_t>(fit.held.n));
  if (!single || fit.held_without_outliers.n == 0) return {};
  return fit.held_outliers;
}

const ErrorStats& usual_held(const Fit& fit) {
  return leaves_out(fit) ? fit.held_without_outliers : fit.held;
}

std::string without_words(const Fit& fit) {
  if (!leaves_out(fit)) return {};
  return fmt::format(" (without {})",
                     counted_words(static_cast<long long>(single_bad(fit).size()),
                                   "reading that stands out", "readings that stand out"));
}

std::optional<HeldOutExcess> held_out_excess_of(const Fit& fit) {
  if (fit.held.n == 0) return std::nullopt;
  return held_out_excess(usual_held(fit).mean, fit.floor, fit.unavoidable_ratio);
}

std::optional<HeldOutExcess> turn_excess_of(const Fit& fit) {
  if (fit.turn_held.n == 0) return std::nullopt;
  return held_out_excess(fit.turn_held.mean, fit.turn_floor, fit.unavoidable_ratio);
}

bool keeps(const ErrorStats& held, double tolerance_m) {
  return held.p95 <= tolerance_m && held.max <= kWorstPose * tolerance_m;
}

Quality quality(const Fit& fit, double tolerance_m) {
  if (fit.held.n == 0) return Quality::kNotHeldOut;
  const ErrorStats& held = usual_held(fit);
  const bool within = held.p95 <= tolerance_m;
  if (within && !keeps(held, tolerance_m)) return Quality::kWorstPoseIsFar;
  const bool known = fit.floor.source != NoiseFloor::Source::kNone;
  if (!within) return known ? quality_beyond(fit) : Quality::kBeyondNoiseUnknown;
  const Quality out = known ? quality_within(fit) : Quality::kGoodNoiseUnknown;
  const bool good = out == Quality::kGood || out == Quality::kGoodNoiseUnknown;
  return good && good_but_for_some(fit, tolerance_m) ? Quality::kGoodButForSome : out;
}

Grade grade(const Fit& fit, double tolerance_m) {
  switch (quality(fit, tolerance_m)) {
    case Quality::kNotHeldOut:
      return Grade::kUnknown;
    case Quality::kGood:
    case Quality::kGoodNoiseUnknown:
      return fit.still.empty() && !fit.size_unknown ? Grade::kGood : Grade::kPartly;
    case Quality::kRepeatsDisagree:
    case Quality::kSigmaTooLarge:
    case Quality::kGoodNotComplete:
    case Quality::kGoodButTurned:
    case Quality::kGoodButForSome:
    case Quality::kWorstPoseIsFar:
    case Quality::kLimitedByNoise:
    case Quality::kPerhapsLimitedByJoints:
      return Grade::kPartly;
    default:
      return Grade::kBad;
  }
}

const char* name_of(Grade grade) {
  switch (grade) {
    case Grade::kGood:
      return "good";
    case Grade::kPartly:
      return "partly";
    case Grade::kBad:
      return "bad";
    default:
      return "unknown";
  }
}

std::string verdict_head(const Fit& fit, double tolerance_m) {
  switch (quality(fit, tolerance_m)) {
    case Quality::kNotHeldOut:
      return "Accuracy unknown";
    case Quality::kGood:
    case Quality::kGoodNoiseUnknown:
    case Quality::kGoodButForSome:
      return good(fit, tolerance_m);
    case Quality::kRepeatsDisagree:
    case Quality::kSigmaTooLarge:
    case Quality::kGoodNotComplete:
    case Quality::kGoodButTurned:
      return good(fit, tolerance_m) + ", not complete";
    case Quality::kWorstPoseIsFar:
      return "Not good everywhere";
    case Quality::kLimitedByNoise:
      return "Limited by the measurement";
    case Quality::kPerhapsLimitedByJoints:
      return "Perhaps limited by the arm";
    default:
      return "Not good enough";
  }
}

std::string verdict(const Fit& fit, double tolerance_m) {
  const std::string size = size_words(fit), tolerance = mm(tolerance_m);
  switch (quality(fit, tolerance_m)) {
    case Quality::kNotHeldOut:
      return "No pose was held out: this fit says nothing about its accuracy.";
    case Quality::kGood:
      return good_words(fit, size, tolerance_m);
    case Quality::kRepeatsDisagree:
      return fmt::format(
          "{}, but repeats of a pose differ by more than the model misses: {}, within {}, {}; "
          "something changes between the repeats.",
          good(fit, tolerance_m), size, tolerance, floor_words(fit));
    case Quality::kSigmaTooLarge:
      return fmt::format(
          "{}: {}, within {}; the noise as it is stated would give {}: sigma is "
          "stated too large.",
          good(fit, tolerance_m), size, tolerance, mm(fit.floor.mean_m));
    case Quality::kGoodNotComplete:
      return fmt::format(
          "{}: {}, within {}; but {}: something physical is still "
          "missing.",
          good(fit, tolerance_m), size, tolerance, times_words(fit));
    case Quality::kGoodButTurned:
      return fmt::format("{}: {}, within {}; but {}.", good(fit, tolerance_m), size, tolerance,
                         turned_words(fit));
    case Quality::kGoodButForSome:
      return but_for_words(fit, size, tolerance_m);
    case Quality::kWorstPoseIsFar:
      return fmt::format(
          "Not good everywhere: {}, within {}, but the worst pose misses by {}: a "
          "bad reading, or a place where the model fails.",
          size, tolerance, mm(usual_held(fit).max));
    case Quality::kLimitedByNoise:
      return limited_words(fit, size, tolerance_m);
    case Quality::kPerhapsLimitedByJoints:
      return fmt::format("Perhaps limited by the arm: {}, over the tolerance of {}; {}.", size,
                         tolerance, scatter_words(fit));
    case Quality::kBeyondSigmaTooLarge:
      return fmt::format(
          "Not good enough: {}, over the tolerance of {}; but the noise as it is stated would give "
          "{}: sigma is stated too large. Correct sigma_um, then what is missing can be judged.",
          size, tolerance, mm(fit.floor.mean_m));
    case Quality::kBeyondAndTurned:
      return fmt::format("Not good enough: {}, over the tolerance of {}; {}, but {}.", size,
                         tolerance, times_words(fit), turned_words(fit));
    case Quality::kTooFewPoses:
      return fmt::format(
          "Not good enough: {}, over the tolerance of {}; {}, as "
          "few poses leave it: measure more.",
          size, tolerance, times_words(fit));
    case Quality::kBeyond:
      return fmt::format(
          "Not good enough: {}, over the tolerance of {}; {}: "
          "something physical is missing.",
          size, tolerance, times_words(fit));
    default:
      return fmt::format("{}: {}; tolerance {}; noise floor unknown.",
                         quality(fit, tolerance_m) == Quality::kGoodNoiseUnknown
                             ? good(fit, tolerance_m)
                             : "Not good enough",
                         size, tolerance);
  }
}

std::string next_step(const Fit& fit, double tolerance_m) {
  switch (quality(fit, tolerance_m)) {
    case Quality::kNotHeldOut:
      return "fit --held-out kfold:5   # hold poses out, to know the accuracy";
    case Quality::kGood:
    case Quality::kGoodNoiseUnknown:
    case Quality::kSigmaTooLarge:
      return fit.still.empty() ? "compile   # the model file for the controller"
                               : "plan --n 30   # poses that move the other joints too";
    case Quality::kGoodButForSome:
      return "check   # are the readings that stand out wrong?";
    case Quality::kWorstPoseIsFar:
      return "compare   # which pose is it?";
    case Quality::kPerhapsLimitedByJoints:
    case Quality::kLimitedByNoise:
      return "compare   # did something move during the measurement?";
    case Quality::kBeyondSigmaTooLarge:
      return "check   # after sigma_um is corrected in cell.toml: what do the readings say of it?";
    case Quality::kTooFewPoses:
      return "plan --n 30   # which poses to measure next";
    default:
      return "diagnose   # which effect is missing?";
  }
}

}  // namespace plumb::offline

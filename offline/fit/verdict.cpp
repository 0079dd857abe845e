// SPDX-License-Identifier: Apache-2.0
#include "fit/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace plumb::offline {
namespace {

constexpr double kBelowTheFloor = 0.75;  // times the noise floor: the floor is not only noise
constexpr double kFarBeyond = 3.0;       // tolerances

std::string mm(double m) { return fmt::format("{:.3f} mm", m * 1e3); }

std::string readings(int n) { return fmt::format("{} reading{}", n, n == 1 ? "" : "s"); }

/// "held-out error 0.164 mm mean, 0.384 mm at 95 % of 48 readings"
std::string size_words(const ErrorStats& held) {
  return fmt::format("held-out error {} mean, {} at 95 % of {}", mm(held.mean), mm(held.p95),
                     readings(held.n));
}

std::string floor_words(const Fit& fit) { return "noise floor " + mm(fit.floor.mean_m); }

/// Of a fit with a noise floor.
HeldOutExcess left(const Fit& fit) { return held_out_excess_of(fit).value_or(HeldOutExcess{}); }
double times_floor(const Fit& fit) { return left(fit).times; }

/// "6.5 times the noise floor 0.016 mm"; it says so where it leaves readings out that the
/// millimetres beside it count.
std::string times_words(const Fit& fit) {
  const bool without = fit.held_without_outliers.n > 0 && fit.held_without_outliers.n < fit.held.n;
  return fmt::format("{}{:.1f} times the {}",
                     without ? fmt::format("without {} readings that stand out ",
                                           fit.held.n - fit.held_without_outliers.n)
                             : "",
                     times_floor(fit), floor_words(fit));
}

Quality quality_within(const Fit& fit) {
  const double times = times_floor(fit);
  if (left(fit).lack_of_fit()) return Quality::kGoodNotComplete;
  if (times <= 0.0 || times >= kBelowTheFloor) return Quality::kGood;
  return fit.floor.source == NoiseFloor::Source::kRepeats ? Quality::kRepeatsDisagree
                                                          : Quality::kSigmaTooLarge;
}

Quality quality_beyond(const Fit& fit) {
  const bool measured_floor = fit.floor.source == NoiseFloor::Source::kRepeats;
  if (!measured_floor && times_floor(fit) < kBelowTheFloor) return Quality::kBeyondSigmaTooLarge;
  switch (left(fit).level()) {
    case HeldOutExcess::Level::kAtTheFloor:
      return Quality::kLimitedByNoise;
    case HeldOutExcess::Level::kAsFewPosesLeaveIt:
      return Quality::kTooFewPoses;
    default:
      return Quality::kBeyond;
  }
}

/// Of joints that never moved nothing is known.
std::string good(const Fit& fit) {
  if (fit.still.empty()) return "Good";
  return fmt::format("Good only while {} {} where {}", fmt::join(fit.still, ", "),
                     fit.still.size() == 1 ? "stays" : "stay",
                     fit.still.size() == 1 ? "it was" : "they were");
}

std::string good_words(const Fit& fit, const std::string& size, double tolerance_m) {
  if (left(fit).level() == HeldOutExcess::Level::kAtTheFloor)
    return fmt::format("{}: {}, at the {}; nothing more can be learnt from these poses.", good(fit),
                       size, floor_words(fit));
  return fmt::format("{}: {}, within {}; {}, as few poses leave it.", good(fit), size,
                     mm(tolerance_m), times_words(fit));
}

std::string limited_by_joints(const Fit& fit, const std::string& size, double tolerance_m) {
  return fmt::format(
      "Limited by the arm: {}, at the {}, but the tolerance is {}: the joints do not come back to "
      "exactly the same place, which no model removes.",
      size, floor_words(fit), mm(tolerance_m));
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

std::optional<HeldOutExcess> held_out_excess_of(const Fit& fit) {
  if (fit.held.n == 0) return std::nullopt;
  const ErrorStats& usual = fit.held_without_outliers.n > 0 ? fit.held_without_outliers : fit.held;
  return held_out_excess(usual.mean, fit.floor, fit.unavoidable_ratio);
}

bool keeps(const ErrorStats& held, double tolerance_m) {
  return held.p95 <= tolerance_m && held.max <= kFarBeyond * tolerance_m;
}

Quality quality(const Fit& fit, double tolerance_m) {
  if (fit.held.n == 0) return Quality::kNotHeldOut;
  const bool within = fit.held.p95 <= tolerance_m;
  if (within && !keeps(fit.held, tolerance_m)) return Quality::kWorstPoseIsFar;
  if (fit.floor.source == NoiseFloor::Source::kNone)
    return within ? Quality::kGoodNoiseUnknown : Quality::kBeyondNoiseUnknown;
  return within ? quality_within(fit) : quality_beyond(fit);
}

Grade grade(const Fit& fit, double tolerance_m) {
  switch (quality(fit, tolerance_m)) {
    case Quality::kNotHeldOut:
      return Grade::kUnknown;
    case Quality::kGood:
    case Quality::kGoodNoiseUnknown:
      return fit.still.empty() ? Grade::kGood : Grade::kPartly;
    case Quality::kRepeatsDisagree:
    case Quality::kSigmaTooLarge:
    case Quality::kGoodNotComplete:
    case Quality::kWorstPoseIsFar:
    case Quality::kLimitedByNoise:
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
      return good(fit);
    case Quality::kRepeatsDisagree:
    case Quality::kSigmaTooLarge:
    case Quality::kGoodNotComplete:
      return good(fit) + ", not complete";
    case Quality::kWorstPoseIsFar:
      return "Not good everywhere";
    case Quality::kLimitedByNoise:
      return fit.floor.holds_scatter ? "Limited by the arm" : "Limited by the measurement";
    default:
      return "Not good enough";
  }
}

std::string verdict(const Fit& fit, double tolerance_m) {
  const std::string size = size_words(fit.held), tolerance = mm(tolerance_m);
  switch (quality(fit, tolerance_m)) {
    case Quality::kNotHeldOut:
      return "No pose was held out: this fit says nothing about its accuracy.";
    case Quality::kGood:
      return good_words(fit, size, tolerance_m);
    case Quality::kRepeatsDisagree:
      return fmt::format(
          "{}, but repeats of a pose differ by more than the model misses: {}, within {}, {}; "
          "something changes between the repeats.",
          good(fit), size, tolerance, floor_words(fit));
    case Quality::kSigmaTooLarge:
      return fmt::format(
          "{}: {}, within {}; the noise as it is stated would give {}: sigma is "
          "stated too large.",
          good(fit), size, tolerance, mm(fit.floor.mean_m));
    case Quality::kGoodNotComplete:
      return fmt::format(
          "{}: {}, within {}; but {}: something physical is still "
          "missing.",
          good(fit), size, tolerance, times_words(fit));
    case Quality::kWorstPoseIsFar:
      return fmt::format(
          "Not good everywhere: {}, within {}, but the worst pose misses by {}: a "
          "bad reading, or a place where the model fails.",
          size, tolerance, mm(fit.held.max));
    case Quality::kLimitedByNoise:
      return fit.floor.holds_scatter ? limited_by_joints(fit, size, tolerance_m)
                                     : limited_words(fit, size, tolerance_m);
    case Quality::kBeyondSigmaTooLarge:
      return fmt::format(
          "Not good enough: {}, over the tolerance of {}; but the noise as it is stated would give "
          "{}: sigma is stated too large. Correct sigma_um, then what is missing can be judged.",
          size, tolerance, mm(fit.floor.mean_m));
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
      return fmt::format(
          "{}: {}; tolerance {}; noise floor unknown.",
          quality(fit, tolerance_m) == Quality::kGoodNoiseUnknown ? good(fit) : "Not good enough",
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
    case Quality::kWorstPoseIsFar:
      return "compare   # which pose is it?";
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

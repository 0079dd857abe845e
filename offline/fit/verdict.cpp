// SPDX-License-Identifier: Apache-2.0
#include "fit/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace plumb::offline {
namespace {

constexpr double kAtTheFloor = 1.3;  // times the noise floor: nothing left to explain
constexpr double kFew = 1.15;        // times the noise: poses are few indeed
constexpr double kFarBeyond = 3.0;   // tolerances

std::string mm(double m) { return fmt::format("{:.3f} mm", m * 1e3); }

std::string poses(int n) { return fmt::format("{} pose{}", n, n == 1 ? "" : "s"); }

/// What the error is beside the noise floor.
struct Ratio {
  double times = 0.0;  // without poses that stand out, which say nothing about physics
  bool at_floor = false;
  bool of_few_poses = false;  // no more than so few poses leave of a complete model
};

Ratio ratio_of(const Fit& fit) {
  Ratio out;
  const ErrorStats& usual = fit.held_without_outliers.n > 0 ? fit.held_without_outliers : fit.held;
  out.times = fit.floor.mean_m > 0 ? usual.mean / fit.floor.mean_m : 0.0;
  out.at_floor = out.times <= kAtTheFloor;
  out.of_few_poses = !out.at_floor && fit.unavoidable_ratio > kFew &&
                     out.times <= kAtTheFloor * fit.unavoidable_ratio;
  return out;
}

/// Of joints that never moved nothing is known.
std::string good(const Fit& fit) {
  if (fit.still.empty()) return "Good";
  return fmt::format("Good only while {} {} where {}", fmt::join(fit.still, ", "),
                     fit.still.size() == 1 ? "stays" : "stay",
                     fit.still.size() == 1 ? "it was" : "they were");
}

std::string within_tolerance(const Fit& fit, const std::string& size, const std::string& floor,
                             double tolerance_m) {
  const Ratio ratio = ratio_of(fit);
  if (ratio.at_floor)
    return fmt::format("{}: {}, at the {}; nothing more can be learnt from these poses.", good(fit),
                       size, floor);
  if (ratio.of_few_poses)
    return fmt::format("{}: {}, within {}; {:.1f} times the {}, as few poses leave it.", good(fit),
                       size, mm(tolerance_m), ratio.times, floor);
  return fmt::format(
      "{}: {}, within {}; but {:.1f} times the {}: something physical is still "
      "missing.",
      good(fit), size, mm(tolerance_m), ratio.times, floor);
}

std::string beyond_tolerance(const Fit& fit, const std::string& size, const std::string& floor,
                             double tolerance_m) {
  const Ratio ratio = ratio_of(fit);
  if (ratio.at_floor)
    return fmt::format("Limited by the measurement: {}, at the {}, but the tolerance is {}.", size,
                       floor, mm(tolerance_m));
  if (ratio.of_few_poses)
    return fmt::format(
        "Not good enough: {}, over the tolerance of {}; {:.1f} times the {}, as few poses leave "
        "it: measure more.",
        size, mm(tolerance_m), ratio.times, floor);
  return fmt::format(
      "Not good enough: {}, {:.1f} times the {} and over the tolerance of {}: something physical "
      "is missing.",
      size, ratio.times, floor, mm(tolerance_m));
}

}  // namespace

bool keeps(const ErrorStats& held, double tolerance_m) {
  return held.p95 <= tolerance_m && held.max <= kFarBeyond * tolerance_m;
}

std::string verdict(const Fit& fit, double tolerance_m) {
  if (fit.held.n == 0) return "No pose was held out: this fit says nothing about its accuracy.";
  const std::string size = fmt::format("held-out error {} mean, {} at 95 % ({})", mm(fit.held.mean),
                                       mm(fit.held.p95), poses(fit.held.n));
  const bool within = fit.held.p95 <= tolerance_m;
  if (within && !keeps(fit.held, tolerance_m))
    return fmt::format(
        "Not good everywhere: {}, within {}, but the worst pose misses by {}: a bad reading, or a "
        "place where the model fails.",
        size, mm(tolerance_m), mm(fit.held.max));
  if (fit.floor.source == NoiseFloor::Source::kNone)
    return fmt::format("{}: {}; tolerance {}; noise floor unknown.",
                       within ? good(fit) : "Not good enough", size, mm(tolerance_m));
  const std::string floor = "noise floor " + mm(fit.floor.mean_m);
  return within ? within_tolerance(fit, size, floor, tolerance_m)
                : beyond_tolerance(fit, size, floor, tolerance_m);
}

}  // namespace plumb::offline

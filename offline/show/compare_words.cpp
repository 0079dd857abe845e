// SPDX-License-Identifier: Apache-2.0
#include "show/compare_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fit/verdict.hpp"
#include "program/counted_words.hpp"
#include "show/units.hpp"

namespace plumb::offline::show {

using compare::ErrorProfile;
using compare::LackOfFit;
using Unit = ErrorProfile::Unit;

namespace {

constexpr double kClose = 0.5;  // successive poses are neighbours in joint space
constexpr double kMinute = 60.0;

std::string vector_um(const Eigen::VectorXd& v, Eigen::Index first) {
  return fmt::format("({:+.0f}, {:+.0f}, {:+.0f})", v(first) * 1e6, v(first + 1) * 1e6,
                     v(first + 2) * 1e6);
}

std::string shift_words(const Cell& cell, const StepFound& step) {
  switch (step.source) {
    case MotionSource::kTool:
      return vector_um(step.shift, 0) + " um along the tool's axes";
    case MotionSource::kBase:
      return vector_um(step.shift, 0) + " um and " + vector_um(step.shift, 3) +
             " urad about the middle of the points";
    case MotionSource::kJoint:
      return fmt::format("{:+.0f} {}", step.shift(0) * 1e6,
                         slides(cell.nominal.joints[step.joint]) ? "um" : "urad");
  }
  return "";
}

}  // namespace

std::string chance(double ln_p) {
  const double tens = -ln_p / std::log(10.0);
  if (tens > 12.0) return "below 1 in 10^12";
  if (tens > 6.0) return fmt::format("1 in 10^{:.0f}", std::floor(tens));
  return fmt::format("1 in {:.0f}", std::max(1.0, std::exp(-ln_p)));
}

double in_unit(double value, Unit unit) {
  switch (unit) {
    case Unit::kLength:
      return to_mm(value);
    case Unit::kAngle:
      return to_deg(value);
    case Unit::kTime:
      return value / kMinute;
    case Unit::kRow:
      return std::round(value);
    default:
      return value;
  }
}

const char* unit_name(Unit unit) {
  switch (unit) {
    case Unit::kLength:
      return "mm";
    case Unit::kAngle:
      return "deg";
    case Unit::kMass:
      return "kg";
    case Unit::kTorque:
      return "Nm";
    case Unit::kTemperature:
      return "degC";
    case Unit::kTime:
      return "min";
    case Unit::kRow:
      return "row";
    case Unit::kName:
    case Unit::kSign:
      return "";
  }
  return "";
}

std::string quantity_words(const ErrorProfile& profile) {
  switch (profile.kind) {
    case ErrorProfile::Kind::kJoint:
      return "joint " + profile.name;
    case ErrorProfile::Kind::kRegion:
      return profile.name + " in the base frame";
    case ErrorProfile::Kind::kOrder:
      return "order of measurement";
    default:
      return profile.name;
  }
}

std::string lack_of_fit_words(const LackOfFit& found, const Fit& fit) {
  const auto held = held_out_excess_of(fit);
  if (found.basis == LackOfFit::Basis::kNone)
    return "Lack of fit: unknown; repeats of a few poses, or sigma_um, would tell.";
  if (!found.significant() && held && held->lack_of_fit())
    return "Lack of fit: none on the fitted readings; it is the held-out ones that the model "
           "misses "
           "by more than noise.";
  if (!found.significant())
    return "Lack of fit: none; what the model misses is no more than the noise of the readings.";
  using Level = HeldOutExcess::Level;
  if (held && held->level() == Level::kAsScatterLeavesIt)
    return fmt::format(
        "Lack of fit: {:.0f} % of the squared error is more than noise (by chance: {}), as much as "
        "joints would leave that do not come back to exactly the same place; a diagnosis found no "
        "better explanation.",
        100.0 * found.systematic, chance(found.ln_p));
  if (held && held->level() == Level::kAsFewPosesLeaveIt)
    return fmt::format(
        "Lack of fit: {:.0f} % of the squared error of the fitted readings is systematic (by "
        "chance: {}), but the held-out ones are missed by no more than so few poses leave.",
        100.0 * found.systematic, chance(found.ln_p));
  if (held && held->level() == Level::kAtTheFloor)
    return fmt::format(
        "Lack of fit: {:.0f} % of the squared error of the fitted readings is systematic (by "
        "chance: {}), too little to take the held-out ones above the noise floor.",
        100.0 * found.systematic, chance(found.ln_p));
  return fmt::format(
      "Lack of fit: {:.0f} % of the squared error is systematic, so a better model "
      "can remove it (by chance: {}).",
      100.0 * found.systematic, chance(found.ln_p));
}

std::string order_words(const compare::Autocorrelation& found) {
  if (found.n == 0) return "Time: too few poses to tell.";
  if (!found.beyond()) return "Time: the error does not depend on the order of measuring.";
  const std::string size = fmt::format("(correlation {:+.2f}, by chance {:+.2f} .. {:+.2f})",
                                       found.lag1, found.low95, found.high95);
  if (found.lag1 < 0.0)
    return fmt::format("Time: readings that follow each other miss in opposite directions {}.",
                       size);
  if (found.closeness < kClose)
    return fmt::format(
        "Time: readings that follow each other miss alike {}. Their poses also lie "
        "close together, so this may be the pose and not the time.",
        size);
  return fmt::format(
      "Time: readings that follow each other miss alike {}: something changes with "
      "time.",
      size);
}

namespace {

/// Which joints explain a squared error; empty if none does.
std::string shares_words(const Cell& cell, const std::vector<compare::JointShare>& shares,
                         const char* error) {
  const compare::JointShare* best = nullptr;
  for (const auto& share : shares)
    if (share.matters && (best == nullptr || share.share > best->share)) best = &share;
  if (best == nullptr) return "";
  std::string others;
  for (const auto& share : shares)
    if (share.matters && &share != best && share.share > 0.02)
      others +=
          fmt::format(", {} {:.0f} %", cell.nominal.joints[share.joint].name, 100.0 * share.share);
  return fmt::format(
      "{} matters most; an error of its angle that depends on the angle, {:.0f} urad RMS, would "
      "explain {:.0f} % of the squared {}{}.",
      cell.nominal.joints[best->joint].name, best->rms_rad * 1e6, 100.0 * best->share, error,
      others);
}

}  // namespace

std::string joint_words(const Cell& cell, const compare::Comparison& found) {
  const auto words = shares_words(cell, found.joints, "error");
  return "Joints: " + (words.empty() ? "no joint's own angle explains the error." : words);
}

std::string turning_joint_words(const Cell& cell, const compare::Turns& found) {
  std::string out;
  if (found.axis)
    out = fmt::format(
        "Orientation: the tool is turned about the axis of {}, by {:.0f} % of the squared error.",
        cell.nominal.joints[static_cast<std::size_t>(found.axis->joint)].name,
        100.0 * found.axis->share);
  const auto words = shares_words(cell, found.joints, "orientation error");
  if (!words.empty()) out += (out.empty() ? "Orientation: " : " ") + words;
  return out;
}

std::string dependence_words(const std::vector<ErrorProfile>& profiles, const char* error) {
  const ErrorProfile* best = nullptr;
  for (const auto& p : profiles)
    if (p.matters && (best == nullptr || p.ln_p < best->ln_p)) best = &p;
  if (best == nullptr) return "";
  return fmt::format("{} changes most with {}; it explains {:.0f} % of the differences.", error,
                     quantity_words(*best), 100.0 * best->explained);
}

std::string step_words(const Cell& cell, const Measurements& measured, const StepFound& step) {
  std::string out =
      fmt::format("between rows {} and {} (poses {} and {}) {} jumped by {}", step.before + 1,
                  step.after + 1, measured.pose[step.before], measured.pose[step.after],
                  in_words(cell, {step.source, step.joint}), shift_words(cell, step));
  if (step.earliest != step.latest)
    out += fmt::format("; the last row before it lies in {} .. {}", step.earliest + 1,
                       step.latest + 1);
  return out;
}

std::string drift_words(const Cell& cell, const Measurements& measured, const DriftFound& drift) {
  return fmt::format("from row {} to {} (poses {} and {}) {} drifts by {} mm, smoothly",
                     drift.from + 1, drift.to + 1, measured.pose[drift.from],
                     measured.pose[drift.to], in_words(cell, {drift.source, drift.joint}),
                     mm(drift.size_m));
}

std::string changes_words(const Changes& found) {
  if (found.visits == 0) return "Jumps and drift: too few poses to tell.";
  if (found.steps.empty() && found.drifts.empty())
    return fmt::format("Jumps and drift: none over {} in order.",
                       counted_words(found.visits, "reading", "readings"));
  return "Jumps and drift:";
}

}  // namespace plumb::offline::show

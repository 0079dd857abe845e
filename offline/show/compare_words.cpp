// SPDX-License-Identifier: Apache-2.0
#include "show/compare_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "show/units.hpp"

namespace plumb::offline::show {

using compare::ErrorProfile;
using compare::LackOfFit;
using compare::Mover;
using Unit = ErrorProfile::Unit;

namespace {

constexpr double kClose = 0.5;  // successive poses are neighbours in joint space
constexpr double kMinute = 60.0;

std::string vector_um(const Eigen::VectorXd& v, Eigen::Index first) {
  return fmt::format("({:+.0f}, {:+.0f}, {:+.0f})", v(first) * 1e6, v(first + 1) * 1e6,
                     v(first + 2) * 1e6);
}

std::string shift_words(const Cell& cell, const compare::StepFound& step) {
  switch (step.mover) {
    case Mover::kTool:
      return vector_um(step.shift, 0) + " um along the tool's axes";
    case Mover::kBase:
      return vector_um(step.shift, 0) + " um and " + vector_um(step.shift, 3) +
             " urad about the middle of the points";
    case Mover::kJoint:
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

const char* mover_name(Mover mover) {
  return mover == Mover::kTool ? "tool" : mover == Mover::kBase ? "base" : "joint";
}

std::string mover_words(const Cell& cell, Mover mover, int joint) {
  if (mover == Mover::kTool) return "the reflector or the tool";
  if (mover == Mover::kBase) return "the tracker or the base";
  return fmt::format("the zero of {}", cell.nominal.joints[joint].name);
}

std::string lack_of_fit_words(const LackOfFit& found) {
  if (found.basis == LackOfFit::Basis::kNone)
    return "Lack of fit: unknown; repeats of a few poses, or sigma_um, would tell.";
  const std::string against =
      found.basis == LackOfFit::Basis::kRepeats
          ? fmt::format("what the poses miss is F({}, {}) = {:.3g} times what repeats scatter",
                        found.dof_model, found.dof_noise, found.ratio)
          : fmt::format("the mean square error is {:.3g} times that of the stated sigma",
                        found.ratio);
  if (!found.significant())
    return fmt::format("Lack of fit: none; {}, which chance explains.", against);
  return fmt::format(
      "Lack of fit: {} (by chance {}); {:.0f} % of the squared error of the fit is systematic.",
      against, chance(found.ln_p), 100.0 * found.systematic);
}

std::string order_words(const compare::Autocorrelation& found) {
  if (found.n == 0) return "Order: too few poses to tell.";
  const std::string size = fmt::format(
      "autocorrelation of successive residuals {:+.2f}, chance gives {:+.2f} .. {:+.2f}",
      found.lag1, found.low95, found.high95);
  if (!found.beyond()) return fmt::format("Order: no memory; {}.", size);
  if (found.lag1 < 0.0) return fmt::format("Order: neighbours alternate; {}.", size);
  if (found.closeness < kClose)
    return fmt::format(
        "Order: neighbours miss alike; {}. Successive poses also lie close together "
        "in joint space, so this may be the pose and not the time.",
        size);
  return fmt::format("Order: neighbours miss alike; {}: something changes with time.", size);
}

std::string joint_words(const Cell& cell, const compare::Comparison& found) {
  const compare::JointShare* best = nullptr;
  for (const auto& share : found.joints)
    if (share.matters && (best == nullptr || share.share > best->share)) best = &share;
  if (best == nullptr) return "Joints: no joint's own angle explains the error.";
  std::string others;
  for (const auto& share : found.joints)
    if (share.matters && &share != best && share.share > 0.02)
      others +=
          fmt::format(", {} {:.0f} %", cell.nominal.joints[share.joint].name, 100.0 * share.share);
  return fmt::format(
      "Joints: {} matters most; a turn of it that depends on its own angle, {:.0f} urad RMS, would "
      "explain {:.0f} % of the squared error{}.",
      cell.nominal.joints[best->joint].name, best->rms_rad * 1e6, 100.0 * best->share, others);
}

std::string where_words(const compare::Comparison& found) {
  const ErrorProfile* best = nullptr;
  for (const auto& p : found.profiles)
    if (p.matters && (best == nullptr || p.ln_p < best->ln_p)) best = &p;
  if (best == nullptr)
    return "Where: nowhere in particular; no quantity changes the error beyond chance.";
  return fmt::format(
      "Where: the error changes most with {}; it explains {:.0f} % of the differences.",
      quantity_words(*best), 100.0 * best->explained);
}

std::string step_words(const Cell& cell, const Measurements& measured,
                       const compare::StepFound& step) {
  std::string out = fmt::format("between pose {} and {} (rows {} and {}) {} jumped by {}",
                                measured.pose[step.before], measured.pose[step.after],
                                step.before + 1, step.after + 1,
                                mover_words(cell, step.mover, step.joint), shift_words(cell, step));
  if (step.earliest != step.latest)
    out += fmt::format("; the last row before it lies in {} .. {}", step.earliest + 1,
                       step.latest + 1);
  return out;
}

std::string drift_words(const Cell& cell, const Measurements& measured,
                        const compare::DriftFound& drift) {
  return fmt::format("from pose {} to {} {} drifts by {} mm, smoothly", measured.pose[drift.from],
                     measured.pose[drift.to], mover_words(cell, drift.mover, drift.joint),
                     mm(drift.size_m));
}

std::string changes_words(const compare::Changes& found) {
  if (found.visits == 0) return "Changes in order: too few poses to tell.";
  if (found.steps.empty() && found.drifts.empty())
    return fmt::format("Changes in order: none over {} visits.", found.visits);
  return "Changes in order:";
}

}  // namespace plumb::offline::show

// SPDX-License-Identifier: Apache-2.0
#include "compile/compiler.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "arm/context_needs.hpp"
#include "arm/effect_binding.hpp"
#include "arm/parameter.hpp"
#include "plumb/format/version.hpp"

namespace plumb::offline {
namespace {

/// The slew limit lets the correction grow from zero to its largest size in this time.
constexpr double kSlewTime_s = 1.0;

/// A correction of the position alone is damped near singular poses, so that it can be solved
/// closer to them than one of the orientation. Nearer than this, a micrometre of 1 m turns a joint
/// by 3 mrad.
constexpr double kLeastSingularPosition = 0.0003;

format::HeldOut held_out(const ErrorStats& s) {
  return {.poses = static_cast<std::uint32_t>(s.n),
          .mean_m = s.mean,
          .rms_m = s.rms,
          .p95_m = s.p95,
          .max_m = s.max};
}

/// Names of the parameters of effects that are fitted but not compiled.
std::set<std::string> left_behind(const format::Model& fitted) {
  std::set<std::string> out;
  for (const auto& p : effect_parameters(fitted))
    if (!runs_online(fitted.effects[static_cast<std::size_t>(p.joint)])) out.insert(p.name);
  return out;
}

/// Robot parameters with their covariance; what belongs to the measurement is left behind.
void add_covariance(const Calibration& calibration, format::Provenance& out) {
  const auto behind = left_behind(calibration.state.arm);
  std::vector<Eigen::Index> robot;
  for (std::size_t i = 0; i < calibration.estimates.size(); ++i) {
    const Estimate& e = calibration.estimates[i];
    if (!e.of_robot || behind.contains(e.name)) continue;
    robot.push_back(static_cast<Eigen::Index>(i));
    out.parameter_names.push_back(calibration.estimates[i].name);
  }
  for (std::size_t i = 0; i < robot.size(); ++i)
    for (std::size_t k = 0; k <= i; ++k)
      out.covariance.push_back(static_cast<float>(calibration.covariance(robot[i], robot[k])));
}

format::Provenance provenance(const Run& run) {
  format::Provenance out;
  out.tool_version = format::kVersion;
  out.created = run.created;
  out.run = fmt::format("{:04}", run.number);
  out.inputs = run.inputs;
  out.inputs.push_back({"cell.toml", run.cell_sha256});
  out.poses_fit = static_cast<std::uint32_t>(run.fit.fit.n);
  out.held_out = held_out(run.fit.held);
  out.noise_floor_m = run.fit.floor.mean_m;
  add_covariance(run.fit.calibration, out);
  return out;
}

format::GuardLimits guard(const Cell& cell, const Run& run) {
  format::GuardLimits out;
  const auto& estimates = run.fit.calibration.estimates;
  const bool turns = std::any_of(estimates.begin(), estimates.end(),
                                 [](const Estimate& e) { return e.name == "target.rx"; });
  out.corrects = turns ? format::Corrects::kPose : format::Corrects::kPosition;
  out.length_scale_m = reach(cell.nominal);
  out.cycle_s = cell.deploy.cycle_s;
  if (out.corrects == format::Corrects::kPosition) out.min_singular_value = kLeastSingularPosition;
  out.max_correction_m = cell.deploy.max_correction_m;
  out.max_rotation_rad = cell.deploy.max_correction_m / out.length_scale_m * M_PI;
  out.slew_m_per_s = out.max_correction_m / kSlewTime_s;
  out.slew_rad_per_s = out.max_rotation_rad / kSlewTime_s;
  return out;
}

}  // namespace

/// True for effects of the robot, and for those of its environment, which the cycle reads by
/// sensors.
bool runs_online(const format::Effect& effect) {
  const EffectDomain domain = domain_of(effect);
  return domain == EffectDomain::kRobot || domain == EffectDomain::kEnvironment;
}

format::Model compile(const Cell& cell, const Run& run) {
  format::Model out;
  out.cell_name = cell.name;
  out.robot_name = cell.robot_name;
  out.serial = cell.serial;
  out.gravity = cell.gravity;
  out.nominal = cell.nominal;
  const format::Model& fitted = run.fit.calibration.state.arm;
  out.calibrated = fitted.calibrated;
  for (const auto& effect : fitted.effects)
    if (runs_online(effect)) out.effects.push_back(effect);
  out.mechanics = fitted.mechanics;
  out.trees = fitted.trees;
  out.domain = fitted.domain;
  out.domain.context = ranges_read(out, fitted.domain.context);
  out.guard = guard(cell, run);
  out.provenance = provenance(run);
  return out;
}

}  // namespace plumb::offline

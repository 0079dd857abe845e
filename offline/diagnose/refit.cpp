// SPDX-License-Identifier: Apache-2.0
#include "diagnose/refit.hpp"

#include <algorithm>
#include <map>

#include "arm/arm_change.hpp"
#include "arm/effect_binding.hpp"
#include "arm/predicted_points.hpp"
#include "diagnose/constants.hpp"
#include "fit/calibrate.hpp"
#include "noise/orientation_floor.hpp"

namespace plumb::offline {
namespace {

/// Start values: parameters that the new list of effects shares with the old one keep their values.
void keep_values(const ArmState& old, ArmState& fresh) {
  std::map<std::string, double> values;
  for (const auto& p : effect_parameters(old.arm)) values[p.name] = value_of(old, p);
  for (const auto& p : effect_parameters(fresh.arm))
    if (const auto it = values.find(p.name); it != values.end())
      fresh.arm.effects[p.joint].parameters[p.component] = it->second;
}

bool did_not_converge(const Failure& failure) {
  return failure.problems().front().code == "E-FIT-CONVERGE";
}

/// Scatter of the orientations about a model, per axis [rad]; not less than that of their readings.
double scatter_about(const Cell& cell, const Measurements& measured, const std::vector<int>& fit,
                     const ArmState& state) {
  const Eigen::VectorXd off = turn_errors(state, pick(measured, fit));
  return std::max(sigma_of_angles({off.begin(), off.end()}),
                  orientation_floor(cell, measured).sigma_rad);
}

Calibration fitted_from(const Cell& with, const Measurements& measured, const std::vector<int>& fit,
                        const ArmState& start, const Calibration& from, Refit how) {
  if (how == Refit::kNearby) return calibrate_near(with, measured, fit, start, from);
  try {
    return calibrate_from(with, measured, fit, start);
  } catch (const Failure& failure) {
    if (!did_not_converge(failure)) throw;
    // The same geometry and poses as before ask less of the solver.
    return calibrate_near(with, measured, fit, start, from);
  }
}

}  // namespace

Calibration refitted(const Cell& cell, const Measurements& measured, const std::vector<int>& fit,
                     const std::vector<EffectEntry>& effects, const Calibration& from, Refit how) {
  Cell with = cell;
  with.effects = effects;
  ArmState start = from.state;
  start.arm.effects = bind_effects(with, measured);
  keep_values(from.state, start);
  Calibration out = fitted_from(with, measured, fit, start, from, how);
  if (!measured.has_orientation() || !cell.measurement.sigma_rad) return out;
  // Orientations weigh little while the model lacks what turns the tool. It may lack less now.
  const double scatter = scatter_about(cell, measured, fit, out.state);
  if (scatter > kSharperOrientations * *cell.measurement.sigma_rad) return out;
  with.measurement.sigma_rad = scatter;
  return fitted_from(with, measured, fit, out.state, out, how);
}

}  // namespace plumb::offline

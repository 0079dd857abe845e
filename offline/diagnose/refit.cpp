// SPDX-License-Identifier: Apache-2.0
#include "diagnose/refit.hpp"

#include <map>

#include "arm/arm_change.hpp"
#include "arm/effect_binding.hpp"
#include "fit/calibrate.hpp"

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

}  // namespace

Calibration refitted(const Cell& cell, const Measurements& measured, const std::vector<int>& fit,
                     const std::vector<EffectEntry>& effects, const Calibration& from, Refit how) {
  Cell with = cell;
  with.effects = effects;
  ArmState start = from.state;
  start.arm.effects = bind_effects(with, measured);
  keep_values(from.state, start);
  if (how == Refit::kNearby) return calibrate_near(with, measured, fit, start, from);
  try {
    return calibrate_from(with, measured, fit, start);
  } catch (const Failure& failure) {
    if (!did_not_converge(failure)) throw;
    // The same geometry and poses as before ask less of the solver.
    return calibrate_near(with, measured, fit, start, from);
  }
}

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#include "arm/measured_arm.hpp"

#include <algorithm>

#include "arm/arm_change.hpp"
#include "arm/effect_binding.hpp"

namespace plumb::offline {
namespace {

std::vector<int> effects_of_measurement(const FittedEffects& effects) {
  std::vector<int> out;
  for (int i = 0; i < effects.size(); ++i)
    if (effects.of_measurement(i)) out.push_back(i);
  return out;
}

/// The model without these effects; an empty model if there are none, as no copy is needed then.
format::Model without(const std::vector<int>& effects, const format::Model& model) {
  if (effects.empty()) return {};
  format::Model out = model;
  for (auto i = effects.rbegin(); i != effects.rend(); ++i)
    out.effects.erase(out.effects.begin() + *i);
  return out;
}

std::vector<std::size_t> places(const std::vector<std::string>& some,
                                const std::vector<std::string>& all) {
  std::vector<std::size_t> out;
  for (const auto& name : some)
    out.push_back(static_cast<std::size_t>(std::find(all.begin(), all.end(), name) - all.begin()));
  return out;
}

}  // namespace

MeasuredArm::MeasuredArm(const format::Model& model)
    : model_(model),
      effects_(model),
      of_measurement_(effects_of_measurement(effects_)),
      robot_(without(of_measurement_, model)),
      sensors_(places(temperature_names(robot_), temperature_names(model))),
      arm_(of_measurement_.empty() ? model : robot_) {}

Prediction MeasuredArm::predict(std::span<const double> q, const MeasuredContext& at) const {
  if (of_measurement_.empty()) return arm_.predict(q, at.known);
  Prediction refusal{.X_BT = {}, .tree_B = Vector3::Zero(), .status = Status::kNotFinite};
  const Context known = of_robot(at);
  EffectSet::Workspace workspace;
  Deviation deviation;
  arm_.prepare(known, workspace);
  arm_.find_deviation(q, workspace, deviation);
  if (refused(deviation.status)) return refusal;
  add_measurement(q, at, deviation);
  ChainAxes axes;
  Vector3 p_BT;
  const Status status = arm_.locate(q, deviation, axes, p_BT);
  if (refused(status)) return refusal;
  const Matrix3 R_BT = turned(deviation.motion.turn_B).R * axes.tip.R;
  return {.X_BT = {R_BT, p_BT}, .tree_B = Vector3(deviation.tree_B.data()), .status = status};
}

Context MeasuredArm::of_robot(const MeasuredContext& at) const {
  Context out = at.known;
  for (std::size_t k = 0; k < sensors_.size(); ++k)
    out.temperature_degC[k] = at.known.temperature_degC[sensors_[k]];
  return out;
}

void MeasuredArm::add_measurement(std::span<const double> q, const MeasuredContext& at,
                                  Deviation& out) const {
  const Chain& chain = arm_.chain();
  ChainFrames rigid;
  chain.frames(q, rigid);
  FittedEffects::Surroundings around;
  effects_.survey(rigid, at, around);
  for (const int i : of_measurement_) {
    const auto& theta = model_.effects[static_cast<std::size_t>(i)].parameters;
    effects_.apply_one<double>(i, theta, q, chain, rigid, around, out.motion);
  }
  if (out.motion.undefined && out.status == Status::kOk) out.status = Status::kContextFallback;
}

}  // namespace plumb::offline

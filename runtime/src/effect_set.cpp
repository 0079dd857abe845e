// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/effect_set.hpp"

#include "plumb/format/formula.hpp"
#include "plumb/runtime/effect_library.hpp"

namespace plumb {
namespace {

bool known(double v) noexcept { return v == v; }

/// Number of the sensor among those the effects read, or -1.
int sensor_of(const format::Model& model, const std::string& name) noexcept {
  const std::string* found = nullptr;
  for (int k = 0; (found = temperature_name(model, k)) != nullptr; ++k)
    if (*found == name) return k;
  return -1;
}

bool substitute(double& value, double fallback) noexcept {
  if (known(value)) return false;
  value = fallback;
  return true;
}

EffectShape shape_of(const format::Model& model, const format::Effect& effect) noexcept {
  return {.arm_joints = static_cast<int>(model.calibrated.joints.size()),
          .joints = effect.joints,
          .constants = effect.constants,
          .formula = effect.formula.code.empty() ? nullptr : &effect.formula};
}

}  // namespace

EffectFault find_effect_fault(const format::Model& model) noexcept {
  using Kind = EffectFault::Kind;
  for (std::size_t i = 0; i < model.effects.size(); ++i) {
    const auto& effect = model.effects[i];
    const int law = find_effect_law(effect.name);
    if (law < 0) return {Kind::kUnknownLaw, i, 0};
    const EffectInfo& info = effect_info(law);
    if (effect.version > info.version) return {Kind::kNewer, i, info.version};
    const std::size_t constants =
        info.constants.size() * (info.constants_per_joint ? effect.joints.size() : 1);
    if (effect.constants.size() != constants) return {Kind::kConstants, i, constants};
    const auto count =
        static_cast<std::size_t>(effect_parameter_count(law, shape_of(model, effect)));
    if (effect.parameters.size() != count) return {Kind::kParameters, i, count};
    if (format::find_formula_fault(effect, model.calibrated.joints.size()) !=
        format::FormulaFault::kNone)
      return {Kind::kFormula, i, 0};
  }
  if (temperature_name(model, format::kMaxTemperatures) != nullptr) return {Kind::kSensors, 0, 0};
  return {};
}

const std::string* temperature_name(const format::Model& model, int k) noexcept {
  int next = 0;
  for (std::size_t i = 0; i < model.effects.size(); ++i)
    for (const auto& need : model.effects[i].context) {
      if (need.input != format::ContextInput::kTemperature) continue;
      bool seen = false;
      for (std::size_t b = 0; b < i; ++b)
        for (const auto& before : model.effects[b].context)
          seen = seen || (before.input == need.input && before.name == need.name);
      if (!seen && next++ == k) return &need.name;
    }
  return nullptr;
}

EffectSet::EffectSet(const format::Model& model) noexcept
    : model_(&model), X_TF_(from_pose(model.calibrated.tool).inverse()) {
  for (const auto& effect : model.effects) {
    const int law = find_effect_law(effect.name);
    if (law < 0 || count_ == format::kMaxEffects) continue;
    Bound& bound = effects_[static_cast<std::size_t>(count_++)];
    bound.law = law;
    with_law(law, [&bound](auto found) { bound.apply = &decltype(found)::template apply<double>; });
    bound.shape = shape_of(model, effect);
    bound.theta = effect.parameters;
    bound.needs = effect.context;
    for (const auto& need : effect.context) {
      if (need.input != format::ContextInput::kTemperature) continue;
      bound.temperature = sensor_of(model, need.name);
      if (bound.temperature >= 0 && bound.sensor_count < bound.sensors.size())
        bound.sensors[bound.sensor_count++] = static_cast<std::uint8_t>(bound.temperature);
    }
  }
}

bool EffectSet::fill_in(const Bound& bound, Context& context) noexcept {
  bool any = false;
  const auto fill = [&any](double& value, double fallback) {
    any = substitute(value, fallback) || any;
  };
  std::size_t sensor = 0;
  for (const auto& need : bound.needs) switch (need.input) {
      case format::ContextInput::kDirection:
        for (int j : bound.shape.joints)
          fill(context.direction[static_cast<std::size_t>(j)], need.fallback);
        break;
      case format::ContextInput::kTravel:
        for (int j : bound.shape.joints)
          fill(context.travel[static_cast<std::size_t>(j)], need.fallback);
        break;
      case format::ContextInput::kPayload:
        fill(context.payload_kg, need.fallback);
        break;
      case format::ContextInput::kTemperature:
        if (sensor < bound.sensor_count)
          fill(context.temperature_degC[bound.sensors[sensor++]], need.fallback);
        break;
      case format::ContextInput::kTime:
        fill(context.time_s, need.fallback);
        break;
    }
  return any;
}

bool EffectSet::fill_in(Context& context) const noexcept {
  bool any = false;
  for (int i = 0; i < count_; ++i)
    any = fill_in(effects_[static_cast<std::size_t>(i)], context) || any;
  return any;
}

void EffectSet::survey(const Chain& chain, const ChainFrames<double>& frames,
                       const Context& context, Surroundings& out) const noexcept {
  out.context = context;
  out.stood_in = fill_in(out.context);
  weigh(chain, frames, model_->mechanics, model_->gravity, X_TF_, out.context, out.loads);
}

bool EffectSet::apply(std::span<const double> q, const Chain& chain,
                      const ChainFrames<double>& frames, const Context& context,
                      Motion<double>& out) const noexcept {
  Surroundings around;
  survey(chain, frames, context, around);
  for (int i = 0; i < count_; ++i) {
    const Bound& bound = effects_[static_cast<std::size_t>(i)];
    bound.apply(bound.theta, bound.shape, situation(bound, q, chain, frames, around), out);
  }
  return around.stood_in || out.undefined;
}

}  // namespace plumb

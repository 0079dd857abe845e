// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/effect_set.hpp"

#include <algorithm>

#include "plumb/format/formula.hpp"
#include "plumb/runtime/detail/effect_library.hpp"

namespace plumb {
namespace {

bool known(double v) noexcept { return v == v; }

/// A law in the form that the cycle calls, with everything it needs inlined.
template <class Law>
[[gnu::flatten]] void apply_law(const BoundEffect& effect, const Situation& at,
                                Motion<double>& out) noexcept {
  Law::template apply<double>(effect.theta, effect.shape, at, out);
}

/// The index of the sensor among those that the effects read, or -1.
int sensor_of(const format::Model& model, const std::string& name) noexcept {
  const std::string* found = nullptr;
  for (int k = 0; (found = temperature_name(model, k)) != nullptr; ++k)
    if (*found == name) return k;
  return -1;
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
        static_cast<std::size_t>(effect_parameter_count(law, effect_shape(model, effect)));
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

EffectShape effect_shape(const format::Model& model, const format::Effect& effect) noexcept {
  EffectShape out{.arm_joints = static_cast<int>(model.calibrated.joints.size()),
                  .joints = effect.joints,
                  .constants = effect.constants,
                  .formula = effect.formula.code.empty() ? nullptr : &effect.formula};
  for (const auto& need : effect.context) {
    if (need.input != format::ContextInput::kTemperature) continue;
    const int place = sensor_of(model, need.name);
    if (place >= 0) out.sensors.add(static_cast<std::uint8_t>(place));
  }
  return out;
}

Weights effect_weights(const format::Model& model, const Fallbacks& fallbacks) noexcept {
  Weights out(model.mechanics, model.gravity, from_pose(model.calibrated.tool).inverse(),
              static_cast<int>(model.calibrated.joints.size()));
  const double payload_kg = fallbacks.values().payload_kg;
  if (known(payload_kg)) out.expect_payload(payload_kg);
  return out;
}

EffectSet::EffectSet(const format::Model& model) noexcept {
  for (const auto& effect : model.effects) {
    const int law = find_effect_law(effect.name);
    if (law >= 0 && count_ < format::kMaxEffects) bind(model, effect, law);
  }
  weights_ = effect_weights(model, fallbacks_);
}

void EffectSet::bind(const format::Model& model, const format::Effect& effect, int law) noexcept {
  BoundEffect& bound = effects_[count_++];
  with_law(law, [&bound](auto found) { bound.apply = &apply_law<decltype(found)>; });
  bound.shape = effect_shape(model, effect);
  bound.theta = effect.parameters;
  fallbacks_.add(effect, bound.shape);
}

void EffectSet::prepare(const Context& context, Workspace& out) const noexcept {
  out.context = &context;
  out.used_fallback = fallbacks_.used_for(context);
  weights_.attach_payload(context, out.payload_T, out.loads);
}

bool EffectSet::apply(std::span<const double> q, const Chain& chain, Workspace& workspace,
                      Motion<double>& out) const noexcept {
  const Situation at{.q = q,
                     .chain = chain,
                     .frames = workspace.frames,
                     .loads = workspace.loads,
                     .context = *workspace.context,
                     .fallbacks = fallbacks_.values()};
  chain.frames(q, weights_.centres(), workspace.payload_T, workspace.frames, workspace.points_B);
  weights_.weigh(workspace.points_B, workspace.loads);
  for (const BoundEffect& bound : std::span(effects_).first(count_)) bound.apply(bound, at, out);
  return workspace.used_fallback | out.undefined;
}

}  // namespace plumb

// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/effect_set.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>

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

/// The position of an input in a Context, counted in doubles, so that a required input is found by
/// an index instead of a switch.
constexpr std::size_t place(std::size_t bytes) noexcept { return bytes / sizeof(double); }
constexpr std::size_t kDirectionAt = place(offsetof(Context, direction));
constexpr std::size_t kTravelAt = place(offsetof(Context, travel));
constexpr std::size_t kPayloadAt = place(offsetof(Context, payload_kg));
constexpr std::size_t kTemperatureAt = place(offsetof(Context, temperature_degC));
constexpr std::size_t kTimeAt = place(offsetof(Context, time_s));
static_assert(std::is_standard_layout_v<Context> && std::is_trivially_copyable_v<Context>);

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
    : weights_(model.mechanics, model.gravity, from_pose(model.calibrated.tool).inverse(),
               static_cast<int>(model.calibrated.joints.size())) {
  for (const auto& effect : model.effects) {
    const int law = find_effect_law(effect.name);
    if (law >= 0 && count_ < format::kMaxEffects) bind(model, effect, law);
  }
  if (known(fallbacks_.payload_kg)) weights_.expect_payload(fallbacks_.payload_kg);
}

void EffectSet::bind(const format::Model& model, const format::Effect& effect, int law) noexcept {
  BoundEffect& bound = effects_[count_++];
  bound.law = law;
  with_law(law, [&bound](auto found) { bound.apply = &apply_law<decltype(found)>; });
  bound.shape = shape_of(model, effect);
  bound.theta = effect.parameters;
  for (const auto& need : effect.context) {
    if (need.input != format::ContextInput::kTemperature) continue;
    const int place = sensor_of(model, need.name);
    if (place >= 0) bound.shape.sensors.add(static_cast<std::uint8_t>(place));
  }
  std::size_t sensor = 0;
  for (const auto& need : effect.context) add_fallback(need, bound, sensor);
}

void EffectSet::add_fallback(const format::ContextNeed& need, const BoundEffect& bound,
                             std::size_t& sensor) noexcept {
  switch (need.input) {
    case format::ContextInput::kDirection:
      for (const std::size_t j : bound.shape.joints) add_fallback(kDirectionAt + j, need.fallback);
      break;
    case format::ContextInput::kTravel:
      for (const std::size_t j : bound.shape.joints) add_fallback(kTravelAt + j, need.fallback);
      break;
    case format::ContextInput::kPayload:
      add_fallback(kPayloadAt, need.fallback);
      break;
    case format::ContextInput::kTemperature:
      if (sensor < bound.shape.sensors.size())
        add_fallback(kTemperatureAt + bound.shape.sensors[sensor++], need.fallback);
      break;
    case format::ContextInput::kTime:
      add_fallback(kTimeAt, need.fallback);
      break;
  }
}

void EffectSet::add_fallback(std::size_t input, double value) noexcept {
  const auto needed = std::span(needs_).first(need_count_);
  if (input >= kInputs || std::find(needed.begin(), needed.end(), input) != needed.end()) return;
  needs_[need_count_++] = input;
  needs_[need_count_] = input;
  std::memcpy(reinterpret_cast<std::byte*>(&fallbacks_) + input * sizeof value, &value,
              sizeof value);
}

/// Compares two inputs at a time: a comparison is unordered if either of them is NaN, that is
/// unknown.
bool EffectSet::lacks(const Context& context) const noexcept {
  const auto* const bytes = reinterpret_cast<const std::byte*>(&context);
  bool any = false;
  for (std::size_t i = 0; i < need_count_; i += 2) {
    double one, other;
    std::memcpy(&one, bytes + needs_[i] * sizeof one, sizeof one);
    std::memcpy(&other, bytes + needs_[i + 1] * sizeof other, sizeof other);
    any |= __builtin_isunordered(one, other) != 0;
  }
  return any;
}

void EffectSet::survey(const ChainFrames& frames, const Context& context,
                       ContextAndLoads& out) const noexcept {
  out.context = context;
  weights_.weigh(frames, context, out.loads);
}

void EffectSet::prepare(const Context& context, Workspace& out) const noexcept {
  out.context = &context;
  out.used_fallback = lacks(context);
  weights_.attach_payload(context, out.payload_T, out.loads);
}

bool EffectSet::apply(std::span<const double> q, const Chain& chain, Workspace& workspace,
                      Motion<double>& out) const noexcept {
  const Situation at{.q = q,
                     .chain = chain,
                     .frames = workspace.frames,
                     .loads = workspace.loads,
                     .context = *workspace.context,
                     .fallbacks = fallbacks_};
  chain.frames(q, weights_.centres(), workspace.payload_T, workspace.frames, workspace.points_B);
  weights_.weigh(workspace.points_B, workspace.loads);
  for (const BoundEffect& bound : std::span(effects_).first(count_)) bound.apply(bound, at, out);
  return workspace.used_fallback | out.undefined;
}

}  // namespace plumb

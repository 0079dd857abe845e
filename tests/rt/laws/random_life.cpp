// SPDX-License-Identifier: Apache-2.0
#include "tests/rt/laws/random_life.hpp"

#include <algorithm>

#include "random_model.hpp"
#include "tests/rt/every_effect.hpp"
#include "tests/rt/wild.hpp"
#include "tests/runtime/random_arm.hpp"

namespace plumb::tests {
namespace {

/// An arm that people own with so many joints, or nothing.
std::vector<format::JointRow> known_rows(Random& random, std::size_t joints) {
  switch (joints) {
    case 2:
      return test::planar(2).joints;
    case 3:
      return test::planar(3).joints;
    case 4:
      return test::scara().joints;
    case 5:
      return test::five_axes().joints;
    case 6:
      return one_in(random, 2) ? test::ur10().joints : test::tx200().joints;
    case 7:
      return test::iiwa().joints;
    default:
      return {};
  }
}

void add_effects(Random& random, format::Model& model) {
  model.effects.clear();
  const int joints = static_cast<int>(model.nominal.joints.size());
  if (one_in(random, 2)) add_masses(model);
  for (int i = random.below(4); i > 0; --i) {
    const int law = random.below(kEffectLaws);
    if (effect_info(law).name == "formula") continue;
    model.effects.push_back(typical_effect(model, law, 1 + random.below(joints)));
  }
  if (find_effect_fault(model).kind != EffectFault::Kind::kNone) model.effects.clear();
}

}  // namespace

format::Model random_arm_model(std::uint64_t seed) {
  Random random(seed);
  test::RandomArm arm(seed);
  format::Model model = format::random_model(seed);
  const auto rows = known_rows(random, model.nominal.joints.size());
  if (!rows.empty() && !one_in(random, 3)) {
    model.nominal.joints = rows;
    model.nominal.convention = rows == test::tx200().joints ? format::Convention::kModified
                                                            : format::Convention::kStandard;
  }
  if (!one_in(random, 8)) model.calibrated = arm.as_built(model.nominal);
  if (one_in(random, 4)) model.trees = {};
  if (one_in(random, 8)) model.guard.ramp_s = 0.0;
  add_effects(random, model);
  return model;
}

RandomInputs::RandomInputs(const Corrector& corrector, const format::Model& model,
                           std::uint64_t seed)
    : corrector_(corrector), model_(model), random_(~seed) {}

/// A controller's small steps, now and then somewhere else.
void RandomInputs::wander() {
  const bool jumps = one_in(random_, 200);
  for (std::size_t i = 0; i < model_.nominal.joints.size(); ++i) {
    const auto& row = model_.nominal.joints[i];
    q_[i] = jumps ? random_.uniform(row.q_min, row.q_max)
                  : std::clamp(q_[i] + random_.uniform(-0.02, 0.02), row.q_min, row.q_max);
  }
}

Transformd RandomInputs::sound_target() {
  const auto n = model_.nominal.joints.size();
  Transformd X = corrector_.nominal().forward(std::span<const double>(q_).first(n));
  const auto u = [&] { return random_.uniform(-1e-3, 1e-3); };
  X = exp(format::Twist{{u(), u(), u()}, {u(), u(), u()}}) * X;
  return one_in(random_, 32) ? sound_pose(random_) : X;
}

Transformd RandomInputs::target(bool& sound) {
  sound = !one_in(random_, 32);
  if (!sound) return broken_pose(random_);
  Transformd X = sound_target();
  if (one_in(random_, 128)) X.p(random_.below(3)) = wild_but_finite(random_);
  return X;
}

void RandomInputs::context(Context& out) {
  out = {};
  if (one_in(random_, 2)) return;
  const auto number = [&](double size) {
    return one_in(random_, 64) ? wild(random_) : random_.uniform(-size, size);
  };
  for (auto* values : {&out.direction, &out.travel})
    for (double& x : *values) x = number(1.0);
  for (double& x : out.temperature_degC) x = number(60.0);
  for (auto* values : {&out.payload_com_m, &out.force_N, &out.moment_Nm})
    for (double& x : *values) x = number(1.0);
  out.payload_kg = number(20.0);
  out.time_s = number(1e5);
}

/// Beside the target by a millimetre, by a metre, or by a world.
Correction RandomInputs::invented(const Transformd& X_BD) {
  Correction out{.X_BC = X_BD, .status = Status::kOk};
  const double size = one_in(random_, 2) ? 2e-3 : 2.0;
  const auto u = [&] { return random_.uniform(-size, size); };
  out.X_BC.p += Vector3(u(), u(), u());
  out.X_BC.R = exp(format::Twist{{}, {u(), u(), u()}}).R * out.X_BC.R;
  if (one_in(random_, 10)) out.X_BC.p(random_.below(3)) = wild(random_);
  if (one_in(random_, 20)) out.X_BC = broken_pose(random_);
  if (one_in(random_, 10)) out.status = static_cast<Status>(random_.below(10) - 7);
  return out;
}

void RandomInputs::next(CycleInput& out) {
  wander();
  out.q = q_;
  for (double& x : out.q) x += random_.uniform(-0.01, 0.01);
  out.joints = model_.nominal.joints.size() - (one_in(random_, 256) ? 1 : 0);
  if (one_in(random_, 32))
    out.q[static_cast<std::size_t>(random_.below(kMaxJoints))] = wild(random_);
  out.X_BD = target(out.sound_target);
  out.kind = one_in(random_, 16) ? SeedKind::kMeasured : SeedKind::kCommanded;
  context(out.context);
  out.dt_s = one_in(random_, 8) ? wild(random_) : model_.guard.cycle_s * random_.uniform(0.0, 2.5);
  out.age = one_in(random_, 64) ? Guard::Inputs::kStale : Guard::Inputs::kFresh;
  out.invents = one_in(random_, 2);
  if (out.invents) out.invented = invented(out.X_BD);
}

}  // namespace plumb::tests

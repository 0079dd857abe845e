// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/cycle.hpp"

#include "finite.hpp"

namespace plumb {
namespace {

LastMove::Joints dead_bands(const LoadedModel& model, double dead_band) noexcept {
  LastMove::Joints out{};
  const Chain& chain = model.corrector().nominal();
  for (int i = 0; i < chain.joints(); ++i)
    out[static_cast<std::size_t>(i)] =
        dead_band * (chain.revolute(i) ? 1.0 : model.limits().length_scale_m);
  return out;
}

}  // namespace

Cycle::Cycle(ModelSlot& slot, const CycleSettings& settings) noexcept
    : slot_(&slot),
      model_(&slot.take()),
      settings_(settings),
      guard_(model_->limits()),
      inputs_(settings.context),
      move_(dead_bands(*model_, settings.dead_band)) {}

std::size_t Cycle::joints() const noexcept {
  return static_cast<std::size_t>(model_->corrector().nominal().joints());
}

void Cycle::take_model() noexcept {
  const LoadedModel& now = slot_->take();
  if (&now == model_) return;
  model_ = &now;
  guard_.swap(now.limits());
}

bool Cycle::sound(const Joints& q) const noexcept {
  return internal::is_joint_state(std::span(q).first(joints()));
}

Cycle::Joints Cycle::angles(Joints values) const noexcept {
  model_->coupling().to_angles(values);
  return values;
}

void Cycle::hear_joints(const CycleInput& input) noexcept {
  if (input.joints == Arrival::kNothingNew) return;
  q_commanded_ = angles(input.q_commanded);
  if (sound(input.q_measured)) q_measured_ = angles(input.q_measured);
  if (sound(input.q_measured) || sound(input.q_commanded)) joints_age_.renew();
}

/// The target of this cycle: the one that arrived, valid or not, or else the last valid one.
Transformd Cycle::hear_target(const CycleInput& input) noexcept {
  if (input.target == Arrival::kNothingNew) return X_BD_;
  if (internal::is_pose(input.X_BD)) {
    X_BD_ = input.X_BD;
    target_age_.renew();
  }
  return input.X_BD;
}

void Cycle::follow_moves() noexcept {
  const SeedKind source = sound(q_commanded_) ? SeedKind::kCommanded : SeedKind::kMeasured;
  if (source != move_source_) move_.change_source();
  move_source_ = source;
  const Joints& q = source == SeedKind::kCommanded ? q_commanded_ : q_measured_;
  move_.follow(std::span(q).first(joints()));
}

Cycle::Seed Cycle::seed() const noexcept {
  const auto first = [this](const Joints& q) { return std::span(q).first(joints()); };
  if (sound(q_commanded_)) return {first(q_commanded_), SeedKind::kCommanded};
  if (has_solution_) return {first(q_solution_), SeedKind::kLastSolution};
  return {first(q_measured_), SeedKind::kMeasured};
}

void Cycle::remember(const Transformd& X_BD, const Correction& correction) noexcept {
  if (!internal::is_pose(X_BD)) return;
  has_solution_ = !refused(correction.status);
  if (has_solution_) q_solution_ = correction.q;
}

Guard::Inputs Cycle::freshness() const noexcept {
  const bool fresh =
      target_age_.within(settings_.target_limit_s) && joints_age_.within(settings_.joints_limit_s);
  return fresh ? Guard::Inputs::kFresh : Guard::Inputs::kStale;
}

CycleOutput Cycle::step(const CycleInput& input) noexcept {
  take_model();
  const CycleTime::Tick tick = time_.tick(input.now_ns, model_->limits().cycle_s);
  target_age_.advance(tick.ageing_s);
  joints_age_.advance(tick.ageing_s);
  hear_joints(input);
  const Transformd X_BD = hear_target(input);
  follow_moves();
  inputs_.step(input.context, tick.ageing_s);
  context_ = inputs_.context(move_, static_cast<int>(joints()));
  const Seed from = seed();
  Correction correction = model_->corrector().solve(X_BD, from.q, from.kind, context_);
  remember(X_BD, correction);
  const GuardOutput output = guard_.step(X_BD, correction, tick.dt_s, freshness());
  model_->coupling().to_values(correction.q);
  return {output, correction};
}

}  // namespace plumb

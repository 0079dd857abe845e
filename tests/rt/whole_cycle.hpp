// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "plumb/runtime/guard.hpp"
#include "tests/rt/wild.hpp"

namespace plumb::tests {

/// One cycle after another as a controller would run them: predict, solve, guard. One in eight has
/// an input that is no number, out of range or no pose; half of the context comes and goes.
/// Allocates when it is built and never again; calls nothing of the system.
class WholeCycle {
 public:
  explicit WholeCycle(format::Model model)
      : model_(std::move(model)), corrector_(model_), guard_(model_.guard) {}
  WholeCycle(const WholeCycle&) = delete;  // the corrector refers to the model
  WholeCycle& operator=(const WholeCycle&) = delete;

  void step() noexcept {
    draw();
    const auto n = static_cast<std::size_t>(corrector_.nominal().joints());
    const auto q = std::span<const double>(q_).first(n);
    const Prediction arm = corrector_.forward_model().predict(q, context_);
    const Transformd X_BD = one_in(random_, 16) ? broken_pose(random_) : arm.X_BT;
    const Correction correction = corrector_.solve(X_BD, q, SeedKind::kCommanded, context_);
    const GuardOutput output = guard_.step(X_BD, correction, dt_s_);
    refused_ += refused(correction.status) ? 1 : 0;
    valid_ += output.has_output && !refused(output.status) ? 1 : 0;
  }

  void run(long cycles) noexcept {
    for (long i = 0; i < cycles; ++i) step();
  }

  long valid() const noexcept { return valid_; }
  long refusals() const noexcept { return refused_; }
  const GuardCounters& counters() const noexcept { return guard_.counters(); }

 private:
  void draw() noexcept {
    for (double& x : q_) x = random_.uniform(-3.0, 3.0);
    if (one_in(random_, 16)) q_[static_cast<std::size_t>(random_.below(6))] = wild(random_);
    context_ = {};
    if (one_in(random_, 2)) know();
    dt_s_ = one_in(random_, 16) ? wild(random_) : model_.guard.cycle_s;
  }

  void know() noexcept {
    for (double& x : context_.direction) x = one_in(random_, 2) ? 1.0 : -1.0;
    for (double& x : context_.travel) x = random_.uniform(-1.0, 1.0);
    for (double& x : context_.temperature_degC) x = random_.uniform(15.0, 45.0);
    context_.payload_kg = one_in(random_, 16) ? wild(random_) : random_.uniform(0.0, 10.0);
    context_.time_s = random_.uniform(0.0, 3600.0);
  }

  format::Model model_;
  Corrector corrector_;
  Guard guard_;
  Random random_{1};
  std::array<double, kMaxJoints> q_{};
  Context context_;
  double dt_s_ = 0.0;
  long valid_ = 0, refused_ = 0;
};

}  // namespace plumb::tests

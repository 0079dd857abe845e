// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

#include "bench/bench_inputs.hpp"
#include "plumb/runtime/cycle.hpp"

namespace plumb::offline::bench {

/// The cycle as plumb-rt runs it: in every step a target, its joints and all readings arrive.
class WholeCycle {
 public:
  /// Precondition: find_effect_fault finds none in the model.
  explicit WholeCycle(format::Model model)
      : model_(LoadedModel::make(std::move(model))), slot_(*model_), cycle_(slot_) {
    input_.target = input_.joints = Arrival::kArrived;
    period_ns_ = std::llround(1e9 * model_->limits().cycle_s);
  }

  GuardOutput step(const BenchPose& pose, const Context& context) noexcept {
    input_.now_ns += period_ns_;
    input_.X_BD = pose.X_BD;
    input_.q_commanded = pose.q;
    input_.context.payload_kg = {context.payload_kg, 0.0};
    input_.context.payload_com_m = context.payload_com_m;
    for (std::size_t k = 0; k < context.temperature_degC.size(); ++k)
      input_.context.temperature_degC[k] = {context.temperature_degC[k], 0.0};
    input_.context.time_s = {context.time_s, 0.0};
    return cycle_.step(input_).output;
  }

 private:
  std::unique_ptr<const LoadedModel> model_;
  ModelSlot slot_;
  Cycle cycle_;
  CycleInput input_;
  std::int64_t period_ns_ = 0;
};

}  // namespace plumb::offline::bench

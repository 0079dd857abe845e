// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "effects/measured_context.hpp"
#include "fit/fitted_effects.hpp"
#include "plumb/runtime/forward_model.hpp"

namespace plumb::offline {

/// The arm as it was measured: what the runtime predicts, and the effects of the measurement
/// besides, which the runtime does not know. Without such effects it is the runtime's prediction to
/// the bit. Refers to the model's memory.
class MeasuredArm {
 public:
  explicit MeasuredArm(const format::Model& model);
  MeasuredArm(const MeasuredArm&) = delete;
  MeasuredArm& operator=(const MeasuredArm&) = delete;

  /// As ForwardModel::predict. Any thread.
  Prediction predict(std::span<const double> q, const MeasuredContext& at) const;

 private:
  /// The context as the runtime's part of the effects reads it.
  Context of_robot(const MeasuredContext& at) const;

  /// Adds the motion of the effects of the measurement at q.
  void add_measurement(std::span<const double> q, const MeasuredContext& at, Deviation& out) const;

  const format::Model& model_;
  FittedEffects effects_;
  std::vector<int> of_measurement_;   // effects that the runtime does not know
  format::Model robot_;               // without those; unused if there are none
  std::vector<std::size_t> sensors_;  // of robot_, as places among those of the whole model
  ForwardModel arm_;
};

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "arm/fitted_effects.hpp"
#include "effects/measured_context.hpp"
#include "plumb/runtime/forward_model.hpp"

namespace plumb::offline {

/// The arm as it was measured: the runtime's prediction plus the effects of the measurement, which
/// the runtime does not know. Without such effects it equals the runtime's prediction bit for bit.
/// Refers to the memory of the model.
class MeasuredArm {
 public:
  explicit MeasuredArm(const format::Model& model);
  MeasuredArm(const MeasuredArm&) = delete;
  MeasuredArm& operator=(const MeasuredArm&) = delete;

  /// As ForwardModel::predict. May be called from any thread.
  Prediction predict(std::span<const double> q, const MeasuredContext& at) const;

 private:
  /// The context with the temperatures in the order of `robot_`.
  Context of_robot(const MeasuredContext& at) const;

  /// Adds the motion of the effects of the measurement at q.
  void add_measurement(std::span<const double> q, const MeasuredContext& at, Deviation& out) const;

  const format::Model& model_;
  FittedEffects effects_;
  std::vector<int> of_measurement_;   // indices of the effects that the runtime does not know
  format::Model robot_;               // the model without them; unused if there are none
  std::vector<std::size_t> sensors_;  // index in the whole model of each temperature of robot_
  ForwardModel arm_;
};

}  // namespace plumb::offline

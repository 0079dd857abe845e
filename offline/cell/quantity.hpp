// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace plumb::offline {

/// Kind of quantity a column holds; it decides which units fit.
enum class Quantity {
  kText,
  kNumber,
  kLength,
  kAngle,
  kMass,
  kTemperature,
  kTime,
  kForce,
  kTorque
};

}  // namespace plumb::offline

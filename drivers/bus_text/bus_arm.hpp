// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "plumb/drivers/bus_layout.hpp"
#include "plumb/format/model.hpp"

namespace plumb::drivers {

/// The properties of an arm on which the default bus layout depends.
struct BusArm {
  std::vector<format::JointType> joints;
  double cycle_s = 0.004;
};
BusArm bus_arm(const format::Chain& chain, double cycle_s);

/// The default layout for this arm. Positions of sliding joints are sent in micrometres.
BusLayout arm_layout(const BusArm& arm, int temperatures, CorrectionForm correction);
MessageLayout arm_message(const BusArm& arm, MessageKind kind);

}  // namespace plumb::drivers

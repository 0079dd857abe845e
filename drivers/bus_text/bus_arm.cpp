// SPDX-License-Identifier: Apache-2.0
#include "bus_text/bus_arm.hpp"

namespace plumb::drivers {
namespace {

/// Marks the positions of sliding joints as micrometres. The scale stays: 1 urad and 1 um are both
/// 1e-6 in SI.
void name_units(MessageLayout& message, const BusArm& arm) {
  if (message.kind != MessageKind::kJoints && message.kind != MessageKind::kCommanded) return;
  for (std::size_t i = 0; i < message.signals.size(); ++i)
    if (arm.joints[i] == format::JointType::kPrismatic) message.signals[i].unit = "um";
}

int joints_of(const BusArm& arm) { return static_cast<int>(arm.joints.size()); }

}  // namespace

BusArm bus_arm(const format::Chain& chain, double cycle_s) {
  BusArm out{.joints = {}, .cycle_s = cycle_s};
  for (const auto& row : chain.joints) out.joints.push_back(row.type);
  return out;
}

BusLayout arm_layout(const BusArm& arm, int temperatures, CorrectionForm correction) {
  BusLayout out = default_layout(joints_of(arm), arm.cycle_s, temperatures, correction);
  for (MessageLayout& message : out.messages) name_units(message, arm);
  return out;
}

MessageLayout arm_message(const BusArm& arm, MessageKind kind) {
  MessageLayout out = default_message(kind, joints_of(arm), arm.cycle_s);
  name_units(out, arm);
  return out;
}

}  // namespace plumb::drivers

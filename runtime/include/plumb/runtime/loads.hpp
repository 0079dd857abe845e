// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "plumb/format/model.hpp"
#include "plumb/runtime/chain.hpp"
#include "plumb/runtime/context.hpp"

namespace plumb {

/// What the joints and links carry at one pose: weight of all that is behind them, and the external
/// wrench at the tip. Base frame, [N] and [N m].
struct Loads {
  struct Carried {
    Vector3 force;   // of links j … n - 1, payload and wrench
    Vector3 moment;  // about the origin of joint j
    double torque;   // about the axis of joint j; along it [N] if it slides
  };
  std::array<Carried, kMaxJoints> joint;
  Vector3 payload_force;                          // weight of the payload
  Vector3 payload_at;                             // its centre of mass
  std::array<double, kMaxJoints> payload_torque;  // what the payload alone does to joint j
  std::array<double, kMaxJoints> wrench_torque;   // and the external wrench
  Vector3 gravity;                                // [m/s^2]
};

/// masses: of link j, centre of mass in the frame P_j behind its joint; the payload's in the flange
/// frame. An unknown payload is the nominal one. Cost: fixed, about one chain evaluation.
void weigh(const Chain& chain, const ChainFrames<double>& frames,
           const format::Mechanics& mechanics, const std::array<double, 3>& gravity,
           const Transformd& X_TF, const Context& context, Loads& out) noexcept;

}  // namespace plumb

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "plumb/format/model.hpp"
#include "plumb/runtime/chain.hpp"
#include "plumb/runtime/context.hpp"

namespace plumb {

/// What the joints and links carry at one pose: weight of all that is behind them, and the external
/// wrench at the tip. Base frame, [N] and [N m]. `weigh` gathers what all joints share; force,
/// moment and torque are worked out where a law asks for them, from the chain and frames that were
/// weighed.
struct Loads {
  struct Behind {
    double mass;           // of links j … n - 1 and the payload [kg]
    Vector3 first_moment;  // of those masses about the base [kg m]
  };
  std::array<Behind, kMaxJoints> joint;
  Vector3 payload_force;           // weight of the payload
  Vector3 payload_at;              // its centre of mass
  Vector3 gravity;                 // [m/s^2]
  Vector3 wrench = {0, 0, 0};      // external, on the tip
  Vector3 tip_moment = {0, 0, 0};  // of the same, about the tip

  Vector3 force(int j) const noexcept { return gravity * joint[j].mass + wrench; }

  /// About the origin of joint j.
  Vector3 moment(int j, const ChainFrames<double>& frames) const noexcept {
    const Vector3& origin = frames.joint[j].p;
    const Vector3 arm = joint[j].first_moment - origin * joint[j].mass;
    return cross<double>(arm, gravity) + wrench_moment(j, frames);
  }

  /// About the axis of joint j [N m]; along it [N] if it slides: of all it carries, of the payload
  /// alone, of the external wrench alone.
  double torque(int j, const Chain& chain, const ChainFrames<double>& frames) const noexcept {
    return along(j, chain, frames, force(j), moment(j, frames));
  }
  double payload_torque(int j, const Chain& chain,
                        const ChainFrames<double>& frames) const noexcept {
    return along(j, chain, frames, payload_force,
                 cross<double>(payload_at - frames.joint[j].p, payload_force));
  }
  double wrench_torque(int j, const Chain& chain,
                       const ChainFrames<double>& frames) const noexcept {
    return along(j, chain, frames, wrench, wrench_moment(j, frames));
  }

 private:
  Vector3 wrench_moment(int j, const ChainFrames<double>& frames) const noexcept {
    return cross<double>(frames.tip.p - frames.joint[j].p, wrench) + tip_moment;
  }
  static double along(int j, const Chain& chain, const ChainFrames<double>& frames,
                      const Vector3& force, const Vector3& moment) noexcept {
    return dot(frames.joint[j].R.col(2), chain.revolute(j) ? moment : force);
  }
};

/// masses: of link j, centre of mass in the frame P_j behind its joint; the payload's in the flange
/// frame. An unknown payload is the nominal one. Cost: fixed for given mechanics.
void weigh(const Chain& chain, const ChainFrames<double>& frames,
           const format::Mechanics& mechanics, const std::array<double, 3>& gravity,
           const Transformd& X_TF, const Context& context, Loads& out) noexcept;

}  // namespace plumb

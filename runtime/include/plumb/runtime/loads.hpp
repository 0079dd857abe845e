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
    Vector3 first_moment;  // of links j … n - 1 and the payload about the base [kg m]
    double mass;           // of the same [kg]
  };
  std::array<Behind, kMaxJoints> joint;
  double payload_kg;               // of the payload alone
  Vector3 payload_force;           // its weight
  Vector3 payload_at;              // its centre of mass
  Vector3 gravity;                 // [m/s^2]
  Vector3 wrench = {0, 0, 0};      // external, on the tip
  Vector3 tip_moment = {0, 0, 0};  // of the same, about the tip
  bool pushed = false;             // there is an external wrench

  Vector3 force(int j) const noexcept {
    const Vector3 weight = gravity * joint[j].mass;
    return pushed ? Vector3(weight + wrench) : weight;
  }

  /// About the origin of joint j.
  Vector3 moment(int j, const ChainFrames& frames) const noexcept {
    const Vector3& origin = frames.joint[j].p;
    const Vector3 arm = joint[j].first_moment - origin * joint[j].mass;
    const Vector3 weight = cross<double>(arm, gravity);
    return pushed ? Vector3(weight + wrench_moment(j, frames)) : weight;
  }

  /// About the origin of the base, of all there is.
  Vector3 base_moment(const ChainFrames& frames) const noexcept {
    Vector3 weight = cross<double>(joint[0].first_moment, gravity);
    if (!pushed) return weight;
    return weight + cross<double>(frames.tip.p, wrench) + tip_moment;
  }

  /// About the axis of joint j [N m]; along it [N] if it slides: of all it carries, of the payload
  /// alone, of the external wrench alone.
  double torque(int j, const Chain& chain, const ChainFrames& frames) const noexcept {
    return dot(frames.joint[j].R.col(2), chain.revolute(j) ? moment(j, frames) : force(j));
  }
  double payload_torque(int j, const Chain& chain, const ChainFrames& frames) const noexcept {
    return along(j, chain, frames, payload_force,
                 cross<double>(payload_at - frames.joint[j].p, payload_force));
  }
  double wrench_torque(int j, const Chain& chain, const ChainFrames& frames) const noexcept {
    return along(j, chain, frames, wrench, wrench_moment(j, frames));
  }

 private:
  Vector3 wrench_moment(int j, const ChainFrames& frames) const noexcept {
    if (!pushed) return Vector3::Zero();
    return cross<double>(frames.tip.p - frames.joint[j].p, wrench) + tip_moment;
  }
  static double along(int j, const Chain& chain, const ChainFrames& frames, const Vector3& force,
                      const Vector3& moment) noexcept {
    return dot(frames.joint[j].R.col(2), chain.revolute(j) ? moment : force);
  }
};

/// The masses of a model, ready for the cycle.
class Weights {
 public:
  Weights() = default;

  /// X_TF: the flange in the tool frame, where the payload's centre is given.
  Weights(const format::Mechanics& mechanics, const std::array<double, 3>& gravity,
          const Transformd& X_TF, int joints) noexcept;

  /// Where the mass of link j is in the frame P_j behind its joint.
  const JointPoints& centres() const noexcept { return centres_; }

  /// What stays the same while the context does: where the payload is in the tool frame, and of the
  /// loads all but where they are. An unknown payload is the nominal one.
  void hang(const Context& context, WidePoint& payload_T, Loads& out) const noexcept;

  /// The rest of the loads, with centres and payload in the base frame. Cost: fixed.
  void weigh(const ChainPoints& points_B, Loads& out) const noexcept;

  /// All of it.
  void weigh(const ChainFrames& frames, const Context& context, Loads& out) const noexcept;

 private:
  double payload_kg(const Context& context) const noexcept;

  template <std::size_t kJoints>
  void weigh(const ChainPoints& points_B, Loads& out) const noexcept;

  JointPoints centres_{};
  std::array<Wide, kMaxJoints> mass_{};
  Vector3 gravity_ = Vector3::Zero();
  Transformd X_TF_;
  double payload_kg_ = 0.0;
  Vector3 payload_com_F_ = Vector3::Zero();
  std::size_t joints_ = 0;
};

/// The same for masses that are weighed once.
void weigh(const Chain& chain, const ChainFrames& frames, const format::Mechanics& mechanics,
           const std::array<double, 3>& gravity, const Transformd& X_TF, const Context& context,
           Loads& out) noexcept;

}  // namespace plumb

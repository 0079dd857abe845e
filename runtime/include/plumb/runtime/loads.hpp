// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "plumb/format/model.hpp"
#include "plumb/runtime/chain.hpp"
#include "plumb/runtime/context.hpp"

namespace plumb {

/// Three numbers of the base frame where a register is read: what the fourth is means nothing.
struct alignas(32) Triple {
  Triple() = default;
  Triple(const Vector3& v) : numbers{v(0), v(1), v(2), 0.0} {}               // NOLINT: it is one
  operator Vector3() const { return {numbers[0], numbers[1], numbers[2]}; }  // NOLINT: likewise

  std::array<double, 4> numbers{};
};

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
  Triple payload_force;  // weight of the payload alone
  Triple payload_at;     // its centre of mass
  Triple gravity;        // [m/s^2]
  Triple wrench;         // external, on the tip
  Triple tip_moment;     // of the same, about the tip
  double payload_kg;
  bool pushed = false;  // there is an external wrench

  Vector3 force(int j) const noexcept;

  /// The weight of the payload along the axes of frame C.
  Vector3 payload_force_in(const Transformd& X_BC) const noexcept;

  /// About the origin of joint j.
  Vector3 moment(int j, const ChainFrames& frames) const noexcept;

  /// About the origin of the base, of all there is.
  Vector3 base_moment(const ChainFrames& frames) const noexcept;

  /// About the axis of joint j [N m]; along it [N] if it slides: of all it carries, of the payload
  /// alone, of the external wrench alone.
  double torque(int j, const Chain& chain, const ChainFrames& frames) const noexcept;
  double payload_torque(int j, const Chain& chain, const ChainFrames& frames) const noexcept;
  double wrench_torque(int j, const Chain& chain, const ChainFrames& frames) const noexcept;
};

/// The masses of a model, ready for the cycle.
class Weights {
 public:
  Weights() = default;

  /// X_TF: the flange in the tool frame, where the payload's centre is given.
  Weights(const format::Mechanics& mechanics, const std::array<double, 3>& gravity,
          const Transformd& X_TF, int joints) noexcept;

  /// Stands for the nominal payload.
  void expect_payload(double kg) noexcept { payload_[0] = kg; }

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
  template <std::size_t kJoints>
  void weigh(const ChainPoints& points_B, Loads& out) const noexcept;

  JointPoints centres_{};
  std::array<Wide, kMaxJoints> mass_{};
  alignas(32) std::array<std::array<double, 4>, 4> X_TF_{};  // its columns
  alignas(32) std::array<double, 4> payload_{};              // as a context has it: [kg], x, y, z
  Triple gravity_;
  std::size_t joints_ = 0;
};

/// The same for masses that are weighed once.
void weigh(const Chain& chain, const ChainFrames& frames, const format::Mechanics& mechanics,
           const std::array<double, 3>& gravity, const Transformd& X_TF, const Context& context,
           Loads& out) noexcept;

}  // namespace plumb

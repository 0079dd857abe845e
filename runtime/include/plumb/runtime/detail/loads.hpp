// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "plumb/format/model.hpp"
#include "plumb/runtime/chain.hpp"
#include "plumb/runtime/context.hpp"

namespace plumb {

/// A vector in the base frame, padded to four numbers so that one register reads it. The fourth
/// number is arbitrary.
struct alignas(32) Triple {
  Triple() = default;
  Triple(const Vector3& v) : numbers{v(0), v(1), v(2), 0.0} {}               // NOLINT: it is one
  operator Vector3() const { return {numbers[0], numbers[1], numbers[2]}; }  // NOLINT: likewise

  std::array<double, 4> numbers{};
};

/// The loads on joints and links at one pose: the weight of everything between a joint and the tip,
/// and the external wrench on the tip. Base frame, [N] and [N m]. Weights::weigh fills the members;
/// forces, moments and torques are computed only where a law asks for them. Chain and frames must
/// be those for which weigh was called.
struct Loads {
  struct Behind {
    Vector3 first_moment;  // of links j … n - 1 and payload, about the base's origin [kg m]
    double mass;           // of links j … n - 1 and payload [kg]
  };
  std::array<Behind, kMaxJoints> joint;
  Triple payload_force;  // weight of the payload alone [N]
  Triple payload_at;     // centre of mass of the payload [m]
  Triple gravity;        // [m/s^2]
  Triple wrench;         // external force on the tip [N]
  Triple tip_moment;     // external moment, about the tip [N m]
  double payload_kg;
  bool pushed = false;  // there is an external force or moment

  /// Force on joint j by everything that it carries.
  Vector3 force(int j) const noexcept;

  /// The weight of the payload along the axes of frame C.
  Vector3 payload_force_in(const Transformd& X_BC) const noexcept;

  /// Moment of everything that joint j carries, about the origin of its frame P_j.
  Vector3 moment(int j, const ChainFrames& frames) const noexcept;

  /// Moment of all loads about the origin of the base.
  Vector3 base_moment(const ChainFrames& frames) const noexcept;

  /// Torque about the axis of joint j [N m], or force along it [N] if the joint is prismatic: by
  /// everything that the joint carries, by the payload alone, by the external wrench alone.
  double torque(int j, const Chain& chain, const ChainFrames& frames) const noexcept;
  double payload_torque(int j, const Chain& chain, const ChainFrames& frames) const noexcept;
  double wrench_torque(int j, const Chain& chain, const ChainFrames& frames) const noexcept;
};

/// The masses of a model, ready for the cycle.
class Weights {
 public:
  Weights() = default;

  /// X_TF: pose of the flange in the tool frame; the payload's centre is given in the flange frame.
  Weights(const format::Mechanics& mechanics, const std::array<double, 3>& gravity,
          const Transformd& X_TF, int joints) noexcept;

  /// Replaces the nominal payload, which is used where the context does not know it.
  void expect_payload(double kg) noexcept { payload_[0] = kg; }

  /// Centre of mass of each link j, in the frame P_j of its joint [m].
  const JointPoints& centres() const noexcept { return centres_; }

  /// Computes what depends on the context alone: the payload's centre in the tool frame (payload_T)
  /// and all loads that do not depend on the pose. An unknown payload is the nominal one.
  void attach_payload(const Context& context, WidePoint& payload_T, Loads& out) const noexcept;

  /// Computes the other loads from the centres of links and payload in the base frame. Cost: fixed.
  void weigh(const ChainPoints& points_B, Loads& out) const noexcept;

  /// Computes all loads of one pose.
  void weigh(const ChainFrames& frames, const Context& context, Loads& out) const noexcept;

 private:
  template <std::size_t kJoints>
  void weigh(const ChainPoints& points_B, Loads& out) const noexcept;

  JointPoints centres_{};
  std::array<Wide, kMaxJoints> mass_{};
  alignas(32) std::array<std::array<double, 4>, 4> X_TF_{};  // columns of X_TF
  alignas(32) std::array<double, 4> payload_{};              // mass [kg], x, y, z, as in Context
  Triple gravity_;
  std::size_t joints_ = 0;
};

/// Computes the loads of one pose directly, for callers that need them only once.
void weigh(const Chain& chain, const ChainFrames& frames, const format::Mechanics& mechanics,
           const std::array<double, 3>& gravity, const Transformd& X_TF, const Context& context,
           Loads& out) noexcept;

}  // namespace plumb

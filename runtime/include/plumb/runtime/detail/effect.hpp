// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "plumb/runtime/chain.hpp"
#include "plumb/runtime/context.hpp"
#include "plumb/runtime/detail/loads.hpp"

/// The types that a physical effect is built from. Every law that the cycle evaluates has its own
/// header in effects/ and is listed in effect_library.hpp. Laws of the measurement and of its
/// procedure are not part of the runtime: they are in offline/effects/measurement.
namespace plumb {

/// What causes an effect. A model file contains only effects of the robot, and of the environment
/// if their sensor is read in the cycle. The others are fitted so that they do not distort the
/// rest, and are then discarded.
enum class EffectDomain : std::uint8_t { kRobot, kEnvironment, kProcedure, kMeasurement };

/// The inputs that must be known, and must vary between poses, for an effect to be identifiable.
/// kNeedsOrder (order of the poses), kNeedsSteps (last moves of the joints relative to each other)
/// and kNeedsTracker (position of the tracker) exist only for measured poses; only laws outside the
/// runtime need them.
enum Need : unsigned {
  kNeedsMasses = 1U << 0,
  kNeedsPayload = 1U << 1,
  kNeedsDirection = 1U << 2,
  kNeedsTravel = 1U << 3,
  kNeedsTemperature = 1U << 4,
  kNeedsTime = 1U << 5,
  kNeedsOrder = 1U << 6,
  kNeedsSteps = 1U << 7,
  kNeedsTracker = 1U << 8,
  kNeedsWrench = 1U << 9,
};

/// One parameter of a law, in SI units.
struct EffectParameter {
  const char* name;
  const char* unit;
  double typical;      // 1 sigma of its prior
  double low, high;    // bounds; there are none if both are equal
  bool linear = true;  // the motion is proportional to the parameter
  double start = 0.0;  // start value of a non-linear parameter
};

struct EffectInfo {
  std::string_view name;
  std::uint32_t version;
  const char* title;  // name for the user, for example "joint compliance"
  EffectDomain domain;
  unsigned needs;  // Need bits
  bool per_joint;  // the parameters repeat for every joint listed, joint by joint
  bool repeats;    // a model may contain the effect several times
  std::span<const EffectParameter> parameters;
  std::span<const char* const> constants = {};  // names of numbers that are given, never fitted
  bool constants_per_joint = false;
};

/// The temperatures that an effect reads, as indices into Context::temperature_degC.
class EffectSensors {
 public:
  void add(std::uint8_t place) noexcept {
    if (size_ < places_.size()) places_[size_++] = place;
  }
  std::size_t size() const noexcept { return size_; }
  std::uint8_t operator[](std::size_t i) const noexcept { return places_[i]; }

 private:
  std::array<std::uint8_t, format::kMaxTemperatures> places_{};
  std::size_t size_ = 0;
};

/// The joints that an effect acts on, and its given numbers.
struct EffectShape {
  int arm_joints = 0;
  std::span<const std::uint8_t> joints;
  std::span<const double> constants;
  const format::Formula* formula = nullptr;  // of the effect 'formula'
  EffectSensors sensors = {};
};

/// One pose as a law sees it: joint positions, frames of the calibrated arm without any effect,
/// loads and context.
struct Situation {
  std::span<const double> q;  // [rad] or [m]
  const Chain& chain;
  const ChainFrames& frames;
  const Loads& loads;
  const Context& context;
  const Context& fallbacks = kNothingKnown;  // fallbacks for the inputs unknown in `context`

  double direction(std::size_t j) const noexcept { return either(&Context::direction, j); }
  double travel(std::size_t j) const noexcept { return either(&Context::travel, j); }

  /// The directions, or travels, of joints j and k at once.
  portable::Two directions(std::size_t j, std::size_t k) const noexcept {
    return either(&Context::direction, j, k);
  }
  portable::Two travels(std::size_t j, std::size_t k) const noexcept {
    return either(&Context::travel, j, k);
  }

  double payload_kg() const noexcept { return either(context.payload_kg, fallbacks.payload_kg); }
  double time_s() const noexcept { return either(context.time_s, fallbacks.time_s); }

  /// The temperature of the effect's sensor i; kUnknown if it has no such sensor.
  double temperature_degC(const EffectShape& shape, std::size_t i) const noexcept {
    return i < shape.sensors.size() ? either(&Context::temperature_degC, shape.sensors[i])
                                    : kUnknown;
  }

  /// Torque of all loads about the axis of joint j [N m]; force along it [N] if it is prismatic.
  double torque(int j) const noexcept { return loads.torque(j, chain, frames); }

 private:
  static double either(double x, double fallback) noexcept { return x == x ? x : fallback; }
  template <class Numbers>
  double either(Numbers Context::*of, std::size_t i) const noexcept {
    return either((context.*of)[i], (fallbacks.*of)[i]);
  }
  template <class Numbers>
  portable::Two either(Numbers Context::*of, std::size_t i, std::size_t k) const noexcept {
    const portable::Two known{(context.*of)[i], (context.*of)[k]};
    const portable::Two fallback{(fallbacks.*of)[i], (fallbacks.*of)[k]};
    return known == known ? known : fallback;
  }
};

/// The motion that effects cause, summed over all of them.
template <class S>
struct Motion {
  std::array<S, kMaxJoints> dq{};           // added to the joint positions [rad] or [m]
  Vec3<S> shift_B{S(0.0), S(0.0), S(0.0)};  // displacement of the tip [m]
  Vec3<S> turn_B{S(0.0), S(0.0), S(0.0)};   // rotation of the tip [rad]
  bool undefined = false;                   // a law has no value here and added no motion

  /// Adds the twist (d, e) [m, rad] given in a frame (R, o): the tip at p moves by
  /// R d + (R e) x (p - o) and turns by R e.
  void twist(const Transformd& X_BO, const Vector3& tip_B, const Vec3<S>& d, const Vec3<S>& e) {
    displace(X_BO.R, d);
    Vec3<S> e_B;
    for (int i = 0; i < 3; ++i)
      e_B(i) = e(0) * X_BO.R(i, 0) + e(1) * X_BO.R(i, 1) + e(2) * X_BO.R(i, 2);
    rotate(e_B, tip_B - X_BO.p);
  }

  /// Adds the displacement d [m], given in a frame of orientation R_B.
  void displace(const Matrix3& R_B, const Vec3<S>& d) {
    Vec3<S> d_B;  // summed apart from shift_B, which the compiler would otherwise read again
    for (int i = 0; i < 3; ++i) d_B(i) = d(0) * R_B(i, 0) + d(1) * R_B(i, 1) + d(2) * R_B(i, 2);
    shift_B += d_B;
  }

  /// Adds the rotation e_B [rad] about a point; arm_B [m] leads from that point to the tip.
  void rotate(const Vec3<S>& e_B, const Vector3& arm_B) {
    const Vec3<S> d_B(e_B(1) * arm_B(2) - e_B(2) * arm_B(1), e_B(2) * arm_B(0) - e_B(0) * arm_B(2),
                      e_B(0) * arm_B(1) - e_B(1) * arm_B(0));
    shift_B += d_B;
    turn_B += e_B;
  }
};

namespace effects {

/// Number of parameters of a law: those of its info, once or for every joint. Laws that count
/// differently have a function of their own.
template <class Law>
int default_count(const EffectShape& shape) {
  const int each = static_cast<int>(Law::kInfo.parameters.size());
  return Law::kInfo.per_joint ? each * static_cast<int>(shape.joints.size()) : each;
}

}  // namespace effects
}  // namespace plumb

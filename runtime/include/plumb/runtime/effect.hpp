// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "plumb/runtime/chain.hpp"
#include "plumb/runtime/context.hpp"
#include "plumb/runtime/loads.hpp"

/// What a physical effect is made of. One header a law in effects/; the list of all is
/// effect_library.hpp.
namespace plumb {

/// Whom an effect belongs to. Only robot effects, and environment ones whose sensor is read in the
/// cycle, go into a model file; the others are fitted, so that they do not spoil the rest, and
/// thrown away.
enum class EffectDomain : std::uint8_t { kRobot, kEnvironment, kProcedure, kMeasurement };

/// What must be known, and must vary, for an effect to be seen.
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

/// One number of a law. SI.
struct EffectParameter {
  const char* name;
  const char* unit;
  double typical;      // 1 sigma of its prior
  double low, high;    // bounds; equal: none
  bool linear = true;  // the motion is proportional to it
  double start = 0.0;  // of a non-linear one
};

struct EffectInfo {
  std::string_view name;
  std::uint32_t version;
  const char* title;  // "gear elasticity": what it is called on the screen
  EffectDomain domain;
  unsigned needs;  // Need bits
  bool per_joint;  // parameters repeat for every joint listed, joint by joint
  bool repeats;    // may be listed several times
  std::span<const EffectParameter> parameters;
  std::span<const char* const> constants = {};  // names of what is given and never fitted
  bool constants_per_joint = false;
};

/// Which temperatures of a context an effect reads, by their places in it.
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

/// Which joints an effect acts on and what is given.
struct EffectShape {
  int arm_joints = 0;
  std::span<const std::uint8_t> joints;
  std::span<const double> constants;
  const format::Formula* formula = nullptr;  // of the effect 'formula'
  EffectSensors sensors = {};
};

/// One pose as a law sees it: positions, frames of the calibrated arm before any effect, loads.
struct Situation {
  std::span<const double> q;  // [rad] or [m]
  const Chain& chain;
  const ChainFrames& frames;
  const Loads& loads;
  const Context& context;
  const Context& stand_ins = kNothingKnown;  // for what is unknown in it

  double direction(std::size_t j) const noexcept { return either(&Context::direction, j); }
  double travel(std::size_t j) const noexcept { return either(&Context::travel, j); }

  /// Of two joints at once.
  portable::Two directions(std::size_t j, std::size_t k) const noexcept {
    return either(&Context::direction, j, k);
  }
  portable::Two travels(std::size_t j, std::size_t k) const noexcept {
    return either(&Context::travel, j, k);
  }

  double payload_kg() const noexcept { return either(context.payload_kg, stand_ins.payload_kg); }
  double time_s() const noexcept { return either(context.time_s, stand_ins.time_s); }

  /// Of sensor i of an effect; unknown if it reads no such one.
  double temperature_degC(const EffectShape& shape, std::size_t i) const noexcept {
    return i < shape.sensors.size() ? either(&Context::temperature_degC, shape.sensors[i])
                                    : kUnknown;
  }

  /// About the axis of joint j [N m]; along it [N] if it slides.
  double torque(int j) const noexcept { return loads.torque(j, chain, frames); }

 private:
  static double either(double x, double stand_in) noexcept { return x == x ? x : stand_in; }
  template <class Numbers>
  double either(Numbers Context::*of, std::size_t i) const noexcept {
    return either((context.*of)[i], (stand_ins.*of)[i]);
  }
  template <class Numbers>
  portable::Two either(Numbers Context::*of, std::size_t i, std::size_t k) const noexcept {
    const portable::Two known{(context.*of)[i], (context.*of)[k]};
    const portable::Two stand_in{(stand_ins.*of)[i], (stand_ins.*of)[k]};
    return known == known ? known : stand_in;
  }
};

/// Motion caused by effects, gathered over all of them.
template <class S>
struct Motion {
  std::array<S, kMaxJoints> dq{};           // joint positions [rad] or [m]
  Vec3<S> shift_B{S(0.0), S(0.0), S(0.0)};  // of the tip [m]
  Vec3<S> turn_B{S(0.0), S(0.0), S(0.0)};   // of the tip [rad]
  bool undefined = false;                   // a law has no value here, and moved nothing

  /// Twist (d, e) [m, rad] in a frame (R, o): moves the tip at p by R d + (R e) x (p - o).
  void twist(const Transformd& X_BO, const Vector3& tip_B, const Vec3<S>& d, const Vec3<S>& e) {
    displace(X_BO.R, d);
    Vec3<S> e_B;
    for (int i = 0; i < 3; ++i)
      e_B(i) = e(0) * X_BO.R(i, 0) + e(1) * X_BO.R(i, 1) + e(2) * X_BO.R(i, 2);
    rotate(e_B, tip_B - X_BO.p);
  }

  /// Displacement d in a frame of orientation R_B [m].
  void displace(const Matrix3& R_B, const Vec3<S>& d) {
    Vec3<S> d_B;  // written at once: what is written might be read again
    for (int i = 0; i < 3; ++i) d_B(i) = d(0) * R_B(i, 0) + d(1) * R_B(i, 1) + d(2) * R_B(i, 2);
    shift_B += d_B;
  }

  /// Rotation e_B [rad] about a point from which the tip is at arm_B [m].
  void rotate(const Vec3<S>& e_B, const Vector3& arm_B) {
    const Vec3<S> d_B(e_B(1) * arm_B(2) - e_B(2) * arm_B(1), e_B(2) * arm_B(0) - e_B(0) * arm_B(2),
                      e_B(0) * arm_B(1) - e_B(1) * arm_B(0));
    shift_B += d_B;
    turn_B += e_B;
  }
};

namespace effects {

/// Parameters of a law: those of its info, once or for every joint. Laws with others say so.
template <class Law>
int default_count(const EffectShape& shape) {
  const int each = static_cast<int>(Law::kInfo.parameters.size());
  return Law::kInfo.per_joint ? each * static_cast<int>(shape.joints.size()) : each;
}

}  // namespace effects
}  // namespace plumb

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "plumb/drivers/bus_message.hpp"
#include "simulate/arm.hpp"

namespace plumb::offline::twin {

using sim::Isometry3d;
using sim::Vector3d;

/// A correction on top of a target: p_c = p_d + translation, R_c = Exp(rotation) R_d, base frame.
struct Offset {
  Vector3d translation = Vector3d::Zero();  // [m]
  Vector3d rotation = Vector3d::Zero();     // rotation vector [rad]
};

Offset offset_between(const Isometry3d& X_BD, const Isometry3d& X_BC);
Isometry3d applied(const Offset& offset, const Isometry3d& X_BD);

/// What a controller that receives corrections must do, so that neither a fault of the bus nor the
/// death of the sender moves the robot wrongly. It is the reference for an implementation in the
/// language of a robot controller:
///
///   1  A correction says which target it belongs to by its counter. Its age is the time since
///      that target was sent, not since the answer came: a late answer is an old one.
///   2  What is applied is the difference from that target, on top of the present target. A
///      corrected pose is never driven to as such: the target has moved on.
///   3  Older than the limit, larger than the limit, not finite, or for a target never sent: not
///      used, and counted.
///   4  Nothing usable for longer than the limit: the goal is zero.
///   5  What is applied moves towards the goal at a limited speed, always: in, out and in between.
class Receiver {
 public:
  struct Settings {
    double fresh_s = 0.1;
    double most_m = 0.010;
    double most_rad = 0.030;
    double slew_m_per_s = 0.03;
    double slew_rad_per_s = 0.1;
  };

  struct Counters {
    std::uint64_t used = 0;
    std::uint64_t stale = 0;      // for an old target, or for one that was never sent
    std::uint64_t too_large = 0;  // or not finite
    std::uint64_t overtaken = 0;  // for a target that is older than the one used last
    double oldest_s = 0.0;        // largest age on arrival of a correction that was used
  };

  explicit Receiver(const Settings& settings) : settings_(settings) {}

  /// Remembers the target that is sent with this counter.
  void sent(std::uint16_t counter, const Isometry3d& X_BD, std::int64_t now_ns);

  /// Takes a message of the kind kCorrected or kOffset; other kinds are ignored.
  void hear(const drivers::BusMessage& message, std::int64_t now_ns);

  /// Returns the correction to apply now. To be called once in every cycle.
  const Offset& step(std::int64_t now_ns, double dt_s);

  const Offset& present() const { return present_; }
  bool fresh(std::int64_t now_ns) const;
  const Counters& counters() const { return counters_; }

  /// Forgets all sent targets, as after a restart. The applied correction does not change.
  void forget();

 private:
  struct Sent {
    bool known = false;
    std::int64_t time_ns = 0;
    Isometry3d X_BD = Isometry3d::Identity();
  };
  std::optional<Offset> offset_in(const drivers::BusMessage& message, const Sent& target) const;

  Settings settings_;
  std::array<Sent, 256> sent_{};  // by the eight bits of the counter that every bus transmits
  Offset goal_, present_;
  bool has_goal_ = false;
  std::int64_t goal_ns_ = 0;  // when the target that the goal belongs to was sent
  Counters counters_;
};

}  // namespace plumb::offline::twin

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "plumb/drivers/bus_content.hpp"
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
/// language of a robot controller, and does what docs/safety.md says of the controller's side,
/// sentence by sentence; tests/twin/receiver_test.cpp compares the two.
///
/// Thread: one. Cost: fixed. Errors: by counters only.
class Receiver {
 public:
  /// Limits on what is applied, beside those of plumb-rt; docs/safety.md has the sentences.
  struct Settings {
    double fresh_s = 0.1;     // longest age of a correction, from the sending of its target on
    double most_m = 0.010;    // a larger correction is refused
    double most_rad = 0.030;  // so is one that turns by more
    double slew_m_per_s = 0.03;
    double slew_rad_per_s = 0.1;
  };

  /// The largest number of sent targets that are remembered.
  static constexpr unsigned kRemembered = 64;

  /// The state of the controller itself, on which the offset depends.
  struct Own {
    bool drives_on = true;
    bool automatic = true;
    bool acknowledge = false;  // the operator's button
  };

  struct Counters {
    std::uint64_t used = 0;
    std::uint64_t stale = 0;      // for an old target, or for one that is not remembered
    std::uint64_t too_large = 0;  // or not finite
    std::uint64_t overtaken = 0;  // for a target that is older than the one used last
    double oldest_s = 0.0;        // largest age on arrival of a correction that was used
  };

  explicit Receiver(const Settings& settings) : settings_(settings) {}

  /// Remembers the target that is sent with this counter.
  void sent(std::uint16_t counter, const Isometry3d& X_BD, std::int64_t now_ns);

  /// Takes a message whose check sum was right, of the kind kCorrected, kOffset or kStatus; other
  /// kinds are ignored.
  void hear(const drivers::BusMessage& message, std::int64_t now_ns);

  /// Returns the correction to apply now. To be called once in every cycle, also with drives off.
  const Offset& step(std::int64_t now_ns, double dt_s, const Own& own);

  const Offset& present() const { return present_; }
  bool fresh(std::int64_t now_ns) const;  // what is wanted is not too old
  bool alive(std::int64_t now_ns) const;  // plumb-rt's heart beats
  const Counters& counters() const { return counters_; }

  /// Begins anew, as after a restart or when the program is changed: no target, no answer and no
  /// status is known, and the offset is zero.
  void restart();

 private:
  struct Sent {
    bool known = false;
    std::int64_t time_ns = 0;
    Isometry3d X_BD = Isometry3d::Identity();
  };
  const Sent* remembered(std::uint16_t counter) const;
  bool applies(std::int64_t now_ns) const;
  void see_button(bool pressed);
  void hear_status(const drivers::BusMessage& message, std::int64_t now_ns);
  void hear_answer(const drivers::BusMessage& message, std::int64_t now_ns);
  std::optional<Offset> offset_in(const drivers::BusMessage& message, const Sent& target) const;

  Settings settings_;
  std::array<Sent, 256> sent_{};  // by the eight bits of the counter that every bus transmits
  std::uint16_t last_sent_ = 0;
  Offset wanted_, present_;
  bool has_wanted_ = false;
  std::int64_t wanted_ns_ = 0;  // when the target that it belongs to was sent
  drivers::SessionStatus status_;
  std::uint16_t status_counter_ = 0;
  bool has_status_ = false;
  bool has_beat_ = false;
  bool faulted_ = false;       // a status said FAULT, and since then no other state counts
  bool acknowledged_ = false;  // and the operator has acknowledged that
  bool pressed_ = false;
  std::int64_t beat_ns_ = 0;  // when a status with another counter than before came
  Counters counters_;
};

}  // namespace plumb::offline::twin

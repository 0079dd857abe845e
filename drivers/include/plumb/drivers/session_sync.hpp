// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "plumb/drivers/bus_message.hpp"
#include "plumb/runtime/chain.hpp"

namespace plumb::drivers {

struct SyncSettings {
  int poses = 50;             // consecutive poses that must agree
  double position_m = 50e-6;  // largest difference of poses that agree
  double rotation_rad = 50e-6;
  int mismatches = 3;      // consecutive mismatches that are a fault; a controller may slip a cycle
  double moved = 1e-3;     // motion of a joint [rad] or [m] from which on a pose is a distinct one
  double within_s = 0.05;  // longest time between the two messages of a pose
};

/// Counters that only grow, except that restart() resets `agreed`, `distinct`, `mismatched_in_row`
/// and the worst differences.
struct SyncCounters {
  std::uint64_t compared = 0;
  std::uint64_t mismatched = 0;
  int agreed = 0;    // consecutive poses that agreed, counted up to SyncSettings::poses
  int distinct = 0;  // those of them before which the arm had moved (it may stand still, see below)
  int mismatched_in_row = 0;
  double last_m = 0.0;  // difference of the last pose compared
  double last_rad = 0.0;
  double worst_m = 0.0;  // largest difference since restart()
  double worst_rad = 0.0;
};

/// Checks that the controller computes with the arm that the model contains as the nominal one.
///
/// The pose that the controller shows (kActual) is compared with N(q) for the joints with the same
/// counter. Another tool, another user frame or the controller's own absolute-accuracy option is
/// detected here, before anything is corrected twice.
///
/// The arm may stand still meanwhile, because another frame or tool is visible at any pose. Poses
/// are compared for the whole life of the session, so differences that appear only elsewhere are
/// found when the arm gets there. `distinct` tells how many different poses SYNC was based on.
///
/// Heap: none. Thread: one. Cost: one nominal forward kinematics for a complete pair. Errors: none;
/// invalid poses and joint states are not compared.
class SyncCheck {
 public:
  explicit SyncCheck(const SyncSettings& settings) noexcept : settings_(settings) {}

  void hear(const BusMessage& message, const Chain& nominal) noexcept;
  void restart() noexcept;

  bool agreed() const noexcept { return counters_.agreed >= settings_.poses; }
  bool mismatched() const noexcept { return counters_.mismatched_in_row >= settings_.mismatches; }
  const SyncCounters& counters() const noexcept { return counters_; }

 private:
  using Values = std::array<double, kMaxMessageValues>;

  /// Number of joint states kept, for actual poses that arrive later than their joints.
  static constexpr std::size_t kKept = 8;

  bool paired(const BusMessage& joints) const noexcept;
  void compare(const BusMessage& joints, const Chain& nominal) noexcept;
  void count(bool agrees, std::span<const double> q) noexcept;
  bool moved(std::span<const double> q) const noexcept;

  SyncSettings settings_;
  std::array<BusMessage, kKept> joints_;  // a ring; size 0: none
  std::size_t next_ = 0;
  BusMessage actual_;  // an actual pose not compared yet; size 0: none
  Values q_distinct_ = BusMessage::unknown();
  SyncCounters counters_;
};

}  // namespace plumb::drivers

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "plumb/drivers/bus_message.hpp"
#include "plumb/runtime/chain.hpp"
#include "plumb/runtime/detail/age.hpp"

namespace plumb::drivers {

/// The largest number of distinct poses that are remembered.
inline constexpr int kMostDistinct = 16;

struct SyncSettings {
  int poses = 50;             // consecutive poses that must agree
  double position_m = 50e-6;  // largest difference of poses that agree
  double rotation_rad = 50e-6;
  int mismatches = 3;      // consecutive mismatches that are a fault; a controller may slip a cycle
  int distinct = 3;        // distinct poses among those that must agree, 1 .. kMostDistinct
  double moved = 0.1;      // a joint's distance [rad] or [m] from which on two poses are distinct
  double within_s = 0.05;  // longest time between the two messages of a pose
  double silence_s = 1.0;  // longest time without a compared pose
};

/// Counters that only grow, except that restart() resets `agreed`, `distinct`, `mismatched_in_row`
/// and the worst differences.
struct SyncCounters {
  std::uint64_t compared = 0;
  std::uint64_t mismatched = 0;
  int agreed = 0;    // consecutive poses that agreed, counted up to SyncSettings::poses
  int distinct = 0;  // how many of them are apart from each other, counted up to kMostDistinct
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
/// Another frame or tool is visible at any pose. The controller's own correction may be small at
/// one pose, so several distinct poses must agree. That correction changes by about 1 mm per radian
/// of a joint, which is twice the limit of 50 um over `moved`, the distance from which on poses
/// count as distinct. Poses are compared for the whole life of the session, so differences that
/// appear only elsewhere are found when the arm gets there.
///
/// Heap: none. Thread: one. Cost: one nominal forward kinematics for a complete pair. Errors: none;
/// invalid poses and joint states are not compared.
class SyncCheck {
 public:
  explicit SyncCheck(const SyncSettings& settings) noexcept : settings_(settings) {}

  void hear(const BusMessage& message, const Chain& nominal) noexcept;
  void restart() noexcept;

  /// To be called once a cycle: the last comparison becomes older by ageing_s [s].
  void step(double ageing_s) noexcept { compared_.advance(ageing_s); }

  bool agreed() const noexcept {
    return counters_.agreed >= settings_.poses && counters_.distinct >= settings_.distinct;
  }
  /// True if no pose was compared for too long: messages are missing or their counters do not pair.
  bool silent() const noexcept { return !compared_.within(settings_.silence_s); }
  bool mismatched() const noexcept { return counters_.mismatched_in_row >= settings_.mismatches; }
  const SyncCounters& counters() const noexcept { return counters_; }

 private:
  using Values = std::array<double, kMaxMessageValues>;

  /// Number of joint states kept, for actual poses that arrive later than their joints.
  static constexpr std::size_t kKept = 8;

  bool paired(const BusMessage& joints) const noexcept;
  void compare(const BusMessage& joints, const Chain& nominal) noexcept;
  void count(bool agrees, std::span<const double> q) noexcept;
  bool apart(std::span<const double> q, const Values& from) const noexcept;
  bool is_distinct(std::span<const double> q) const noexcept;

  SyncSettings settings_;
  std::array<BusMessage, kKept> joints_;  // a ring; size 0: none
  std::size_t next_ = 0;
  BusMessage actual_;                             // an actual pose not compared yet; size 0: none
  std::array<Values, kMostDistinct> distinct_{};  // as many as counters_.distinct
  Age compared_;
  SyncCounters counters_;
};

}  // namespace plumb::drivers

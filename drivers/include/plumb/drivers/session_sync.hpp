// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "plumb/drivers/bus_message.hpp"
#include "plumb/runtime/chain.hpp"

namespace plumb::drivers {

struct SyncSettings {
  int poses = 50;             // that must agree, one after the other
  double position_m = 50e-6;  // agreement
  double rotation_rad = 50e-6;
  int mismatches = 3;      // in a row that are a fault: one may be a controller's slip of a cycle
  double moved = 1e-3;     // [rad] or [m] of a joint from which on a pose is another one
  double within_s = 0.05;  // between the two messages of a pose
};

/// Monotone, but for `agreed`, `distinct` and `mismatched_in_row`, which begin anew with restart().
struct SyncCounters {
  std::uint64_t compared = 0;
  std::uint64_t mismatched = 0;
  int agreed = 0;    // in a row, counted up to SyncSettings::poses
  int distinct = 0;  // of those, in which the arm had moved; standing still is allowed, see below
  int mismatched_in_row = 0;
  double last_m = 0.0;  // of the last pose compared
  double last_rad = 0.0;
  double worst_m = 0.0;  // since restart()
  double worst_rad = 0.0;
};

/// Is what the controller takes for its arm what the model takes for the nominal arm?
///
/// The pose it shows (kActual) is compared with N(q) for the joints of the same counter. Another
/// tool, another user frame or the controller's own absolute-accuracy option shows here, before
/// anything is corrected twice.
///
/// An arm may stand still while it is compared: another frame or tool shows at any one pose, and
/// comparing goes on for as long as the session lives, so that what shows only elsewhere is met
/// where it shows. `distinct` says how much the poses of SYNC were worth.
///
/// Heap: none. Thread: one. Cost: one nominal forward for a complete pair. Errors: what is no pose
/// and no joint state is not compared.
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

  /// How many joint states are kept for an actual pose that comes later than its own.
  static constexpr std::size_t kKept = 8;

  bool paired(const BusMessage& joints) const noexcept;
  void compare(const BusMessage& joints, const Chain& nominal) noexcept;
  void count(bool agrees, std::span<const double> q) noexcept;
  bool moved(std::span<const double> q) const noexcept;

  SyncSettings settings_;
  std::array<BusMessage, kKept> joints_;  // a ring; size 0: none
  std::size_t next_ = 0;
  BusMessage actual_;  // not compared yet; size 0: none
  Values q_distinct_ = BusMessage::unknown();
  SyncCounters counters_;
};

}  // namespace plumb::drivers

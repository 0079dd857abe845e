// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "plumb/drivers/bus_content.hpp"

namespace plumb::drivers {

/// Why a session went to FAULT.
enum class FaultCause : std::uint8_t {
  kNone,
  kPoseMismatch,   // the controller's poses differ from those of the model's nominal arm
  kOtherRobot,     // the robot on the bus is not the one of the model
  kForeignSender,  // another sender uses our identifiers
};
inline constexpr int kFaultCauses = 4;

/// Stable lower-case words: "init", "pose-mismatch", "shadow".
const char* to_string(SessionState state) noexcept;
const char* to_string(FaultCause cause) noexcept;
const char* to_string(CorrectionMode mode) noexcept;

/// The facts of a cycle on which the next state depends.
struct SessionFacts {
  FaultCause fault = FaultCause::kNone;  // the fault that is present now
  bool heard = false;         // joints, actual pose, controller and robot arrived recently
  bool synced = false;        // enough poses agreed, and the robot is the model's
  bool permitted = false;     // all inputs have allowed a correction for SessionSettings::rearm_s
  bool lost = true;           // at least one input does not allow a correction now
  bool at_zero = true;        // the correction on the target is zero
  bool acknowledged = false;  // an operator acknowledged in this cycle
  bool stopping = false;      // plumb-rt was told to end
  CorrectionMode mode = CorrectionMode::kShadow;
};

/// The state of the next cycle. There is at most one transition per cycle, by the first row whose
/// condition is true:
///
///     from      to       when
///     not FAULT FAULT    a fault holds
///     FAULT     INIT     acknowledged, no fault holds any more, no correction is left
///     INIT      SYNC     heard
///     SYNC      INIT     not heard
///     SYNC      SHADOW   synced
///     SHADOW    INIT     not heard
///     SHADOW    ACTIVE   permitted, not lost, mode limited or full, not stopping
///     ACTIVE    HOLD     lost, or mode shadow, or stopping
///     HOLD      INIT     not heard, no correction is left
///     HOLD      SHADOW   mode shadow or stopping, no correction is left
///     HOLD      ACTIVE   permitted, not lost, mode limited or full, not stopping
///
/// Pure; any thread.
SessionState next_state(SessionState state, const SessionFacts& facts) noexcept;

/// True in the states in which a correction is computed; in all others it is taken to zero.
constexpr bool computes(SessionState state) noexcept {
  return state == SessionState::kShadow || state == SessionState::kActive;
}

}  // namespace plumb::drivers

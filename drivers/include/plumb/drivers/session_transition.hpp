// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "plumb/drivers/bus_content.hpp"

namespace plumb::drivers {

/// Why a session went to FAULT.
enum class FaultCause : std::uint8_t {
  kNone,
  kPoseMismatch,   // the controller's poses are not those of the model's nominal arm
  kOtherRobot,     // the robot on the bus is not the one of the model
  kForeignSender,  // someone else sends our identifiers
};

/// Stable lower-case words: "init", "pose-mismatch", "shadow".
const char* to_string(SessionState state) noexcept;
const char* to_string(FaultCause cause) noexcept;
const char* to_string(CorrectionMode mode) noexcept;

/// What a cycle knows when it asks where to go.
struct SessionFacts {
  FaultCause fault = FaultCause::kNone;  // that holds now
  bool heard = false;                    // joints, actual pose, controller and robot came recently
  bool synced = false;                   // enough poses agreed, and the robot is the model's
  bool permitted = false;     // every input that allows a correction has done so for a while
  bool lost = true;           // one of them does not allow it now
  bool at_zero = true;        // there is no correction on the target
  bool acknowledged = false;  // an operator's acknowledgement began with this cycle
  bool stopping = false;      // plumb-rt was told to end
  CorrectionMode mode = CorrectionMode::kShadow;
};

/// The state of the next cycle. One transition a cycle at most; the first row that holds:
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

/// The correction is taken to zero in every state but these.
constexpr bool computes(SessionState state) noexcept {
  return state == SessionState::kShadow || state == SessionState::kActive;
}

}  // namespace plumb::drivers

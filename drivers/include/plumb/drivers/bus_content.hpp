// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "plumb/drivers/bus_message.hpp"
#include "plumb/runtime/status.hpp"
#include "plumb/runtime/transform.hpp"

namespace plumb::drivers {

/// The states of plumb-rt; their numbers are sent on the bus.
enum class SessionState : std::uint8_t {
  kInit = 0,
  kSync = 1,    // compares the controller's poses with the nominal model
  kShadow = 2,  // computes and reports, sends no correction
  kActive = 3,
  kHold = 4,   // the correction ramps out because an input is lost or an enable is off
  kFault = 5,  // the correction is ramped out until an operator acknowledges
};

enum class CorrectionMode : std::uint8_t { kShadow = 0, kLimited = 1, kFull = 2 };

/// The state of the controller as it reports it. If one value of the message is impossible, all
/// members have their safe values, which are the defaults below.
struct ControllerState {
  bool drives_on = false;
  bool automatic = false;  // operating mode automatic
  bool protective_stop = true;
  bool correction_enabled = false;  // the enable signal of the cell
  bool acknowledge = false;         // an operator's button (session_acknowledgement.hpp)
  std::uint8_t tool = 0;            // active tool, frame and payload, in the controller's numbers
  std::uint8_t frame = 0;
  std::uint8_t payload = 0;
};

/// Bits of the value "flags" of message kController.
enum ControllerFlag : unsigned {
  kDrivesOn = 1,
  kAutomatic = 2,
  kProtectiveStop = 4,
  kCorrectionEnabled = 8,
  kAcknowledge = 16,
};

struct SessionStatus {
  SessionState state = SessionState::kInit;
  CorrectionMode mode = CorrectionMode::kShadow;
  Status status = Status::kNoModel;
  bool asks = false;  // for an acknowledgement; the status is then not sent
  bool has_output = false;
  std::uint16_t refused = 0;  // lower 16 bits of the guard's counters
  std::uint16_t limited = 0;
  std::uint16_t stale = 0;
};

/// The number of value "status" that asks the controller for an acknowledgement; no number of
/// Status.
inline constexpr int kAsksForAcknowledgement = 6;
static_assert(kAsksForAcknowledgement > static_cast<int>(Status::kPartial));

/// Conversion to and from messages. Positions [m] and rotation vectors [rad] are in the base frame,
/// joints in [rad] or [m]. An offset (d, r) to a desired pose D gives p = p_D + d and
/// R = exp(r) R_D; an offset with a value that is not finite changes nothing.
BusMessage pose_message(MessageKind kind, const Transformd& pose, std::uint16_t counter);
std::optional<Transformd> pose_in(const BusMessage& message);  // none: not finite
BusMessage offset_message(const Transformd& desired, const Transformd& corrected,
                          std::uint16_t counter);
Transformd add_offset(const Transformd& desired, const BusMessage& offset);
BusMessage joints_message(MessageKind kind, std::span<const double> q, std::uint16_t counter);
BusMessage controller_message(const ControllerState& state, std::uint16_t counter);
std::optional<ControllerState> possible_controller(const BusMessage& message);  // none: impossible
ControllerState controller_in(const BusMessage& message);
BusMessage status_message(const SessionStatus& status, std::uint16_t counter);
SessionStatus status_in(const BusMessage& message);

/// A number from 1 to 2^23 - 1, which every number format on the bus holds exactly. It identifies a
/// robot by its serial number, and a model file by its SHA-256 in hexadecimal. It is not taken of
/// the file itself: a file ends in a checksum of the same polynomial, so all files would have the
/// same fingerprint.
std::uint32_t fingerprint(std::string_view text);
BusMessage robot_message(std::uint32_t fingerprint, std::uint16_t counter);
BusMessage signature_message(std::uint32_t model, std::uint32_t robot, std::uint16_t counter);

}  // namespace plumb::drivers

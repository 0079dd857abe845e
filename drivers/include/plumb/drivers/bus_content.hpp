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

/// What plumb-rt goes through; the number is on the bus.
enum class SessionState : std::uint8_t {
  kInit = 0,
  kSync = 1,    // compares the controller's poses with the nominal model
  kShadow = 2,  // computes and reports, sends no correction
  kActive = 3,
  kHold = 4,   // the correction ramps out: an input is lost, or an enable is off
  kFault = 5,  // ramped out, until an operator acknowledges
};

enum class CorrectionMode : std::uint8_t { kShadow = 0, kLimited = 1, kFull = 2 };

/// What the controller says of itself. If a value of the message is none that can be, all of it
/// counts as the safe side.
struct ControllerState {
  bool drives_on = false;
  bool automatic = false;  // operating mode automatic
  bool protective_stop = true;
  bool correction_enabled = false;  // the cell's own enable
  bool acknowledge = false;         // an operator's acknowledgement: counts on its rising edge
  std::uint8_t tool = 0;            // active tool, frame, payload as the controller numbers them
  std::uint8_t frame = 0;
  std::uint8_t payload = 0;
};

/// The value "flags" of kController.
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
  bool has_output = false;
  std::uint16_t refused = 0;  // counters, the lower bits of them
  std::uint16_t limited = 0;
  std::uint16_t stale = 0;
};

/// Positions [m] and rotation vectors [rad] in the base frame; joints [rad] or [m]. An offset is
/// added to the position, and its rotation is about the axes of the base frame: R = exp(r) R_D. One
/// with a value that is not finite adds nothing.
BusMessage pose_message(MessageKind kind, const Transformd& pose, std::uint16_t counter);
std::optional<Transformd> pose_in(const BusMessage& message);  // none: not finite
BusMessage offset_message(const Transformd& desired, const Transformd& corrected,
                          std::uint16_t counter);
Transformd add_offset(const Transformd& desired, const BusMessage& offset);
BusMessage joints_message(MessageKind kind, std::span<const double> q, std::uint16_t counter);
BusMessage controller_message(const ControllerState& state, std::uint16_t counter);
ControllerState controller_in(const BusMessage& message);
BusMessage status_message(const SessionStatus& status, std::uint16_t counter);
SessionStatus status_in(const BusMessage& message);

/// 1 to 2^23 - 1, exact in every number the bus has: stands for a robot's serial number and, taken
/// of its SHA-256 in hexadecimal, for a model file. Not of the file itself: that ends in a check
/// sum of the same polynomial, which makes all files alike.
std::uint32_t fingerprint(std::string_view text);
BusMessage robot_message(std::uint32_t fingerprint, std::uint16_t counter);
BusMessage signature_message(std::uint32_t model, std::uint32_t robot, std::uint16_t counter);

}  // namespace plumb::drivers

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "plumb/drivers/bus_content.hpp"
#include "plumb/drivers/session_inbox.hpp"

namespace plumb::drivers {

/// The reasons that prevent a correction, as bits; several may be set at once.
enum class Lost : std::uint32_t {
  kNothing = 0,
  kTarget = 1 << 0,        // no valid target for too long
  kJoints = 1 << 1,        // no joint state for too long
  kController = 1 << 2,    // no message of the controller's state for too long
  kDrives = 1 << 3,        // the drives are off
  kManual = 1 << 4,        // the operating mode is not automatic
  kStop = 1 << 5,          // a protective stop is active
  kDisabled = 1 << 6,      // the enable signal of the cell is off
  kTool = 1 << 7,          // another tool than the expected one is active
  kFrame = 1 << 8,         // another frame than the expected one is active
  kPayload = 1 << 9,       // another payload than the expected one is active
  kMotion = 1 << 10,       // a target exceeded its limits of step or speed
  kRobot = 1 << 11,        // no message of the robot's identity for too long
  kComparison = 1 << 12,   // no pose of the controller was compared for too long
  kArmAway = 1 << 13,      // the arm is not where the targets are
  kArmStill = 1 << 14,     // the targets move, and the joints do not
  kStall = 1 << 15,        // plumb-rt missed its cycles for too long
  kAcknowledge = 1 << 16,  // an operator must acknowledge before the first correction
  kRestart = 1 << 17,      // the controller has been restarted in this cycle
  kAnswers = 1 << 18,      // the controller refuses what is written to it
};
inline constexpr int kLostBits = 19;

constexpr Lost operator|(Lost a, Lost b) noexcept {
  return static_cast<Lost>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}
constexpr Lost operator&(Lost a, Lost b) noexcept {
  return static_cast<Lost>(static_cast<unsigned>(a) & static_cast<unsigned>(b));
}
constexpr bool has(Lost set, Lost one) noexcept { return (set & one) != Lost::kNothing; }

/// Stable lower-case words for one bit: "target", "drives", "arm-away".
const char* to_string(Lost one) noexcept;

struct InputSettings {
  double limit_s = 0.1;                   // longest age of target, joints, controller and status
  double robot_s = 1.0;                   // longest age of messages robot and actual
  std::optional<std::uint8_t> tool = {};  // expected number at the controller; none: any
  std::optional<std::uint8_t> frame = {};
  std::optional<std::uint8_t> payload = {};
};

/// How long a message may be absent before the session treats it as lost [s]; infinite if it is
/// never treated so. This includes `status`, for which the receiver at the other end waits as long.
/// Pure; any thread.
double longest_silence_s(MessageKind kind, const InputSettings& settings = {}) noexcept;

/// The reasons in the messages that now prevent a correction. Pure.
Lost find_lost(const SessionInbox& inbox, const InputSettings& settings) noexcept;

/// True if all of these are positions [rad] or [m] that a joint of an arm can have. Pure.
bool is_joint_state(std::span<const double> q) noexcept;

/// True if joints, actual pose, controller and robot arrived recently, so that a controller is
/// there.
bool is_heard(const SessionInbox& inbox, const InputSettings& settings) noexcept;

}  // namespace plumb::drivers

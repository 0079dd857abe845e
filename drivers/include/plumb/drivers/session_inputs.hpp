// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "plumb/drivers/bus_content.hpp"
#include "plumb/drivers/session_inbox.hpp"

namespace plumb::drivers {

/// What stands against a correction; bits, several at once.
enum class Lost : std::uint16_t {
  kNothing = 0,
  kTarget = 1 << 0,      // no sound target for too long
  kJoints = 1 << 1,      // no joint state for too long
  kController = 1 << 2,  // nothing heard of the controller's state for too long
  kDrives = 1 << 3,      // off
  kManual = 1 << 4,      // operating mode is not automatic
  kStop = 1 << 5,        // protective stop
  kDisabled = 1 << 6,    // the cell's own enable is off
  kTool = 1 << 7,        // another than expected is active
  kFrame = 1 << 8,
  kPayload = 1 << 9,
  kMotion = 1 << 10,  // a target was beyond its limits of step or speed
};
inline constexpr int kLostBits = 11;

constexpr Lost operator|(Lost a, Lost b) noexcept {
  return static_cast<Lost>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}
constexpr bool has(Lost set, Lost one) noexcept {
  return (static_cast<unsigned>(set) & static_cast<unsigned>(one)) != 0;
}

/// Stable lower-case words for one bit: "target", "drives", "manual".
const char* to_string(Lost one) noexcept;

struct InputSettings {
  double limit_s = 0.1;                   // age of target, joints, controller; also of the status
  double robot_s = 1.0;                   // age of the robot's name and of the actual pose
  std::optional<std::uint8_t> tool = {};  // the controller's numbers; none: any
  std::optional<std::uint8_t> frame = {};
  std::optional<std::uint8_t> payload = {};
};

/// For how long a message may not come before the session goes without it [s]; infinite: for ever.
/// `status` counts too: the receiver at the other end waits as long for it. Pure; any thread.
double longest_silence_s(MessageKind kind, const InputSettings& settings = {}) noexcept;

/// What the messages say against a correction now. Pure.
Lost find_lost(const SessionInbox& inbox, const InputSettings& settings) noexcept;

/// Joints, actual pose, controller and robot came recently: there is a controller to speak to.
bool is_heard(const SessionInbox& inbox, const InputSettings& settings) noexcept;

}  // namespace plumb::drivers

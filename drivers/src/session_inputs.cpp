// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/session_inputs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumb::drivers {
namespace {

constexpr double kMostJoint = 1e4;  // [rad] or [m]: larger than any joint position of an arm

constexpr Lost unless(bool good, Lost lost) noexcept { return good ? Lost::kNothing : lost; }

bool as_expected(const std::optional<std::uint8_t>& expected, std::uint8_t active) noexcept {
  return !expected || *expected == active;
}

bool comes(MessageKind kind, const SessionInbox& inbox, const InputSettings& settings) noexcept {
  return inbox.within(kind, longest_silence_s(kind, settings));
}

}  // namespace

double longest_silence_s(MessageKind kind, const InputSettings& settings) noexcept {
  switch (kind) {
    case MessageKind::kTarget:
    case MessageKind::kJoints:
    case MessageKind::kController:
    case MessageKind::kStatus:
      return settings.limit_s;
    case MessageKind::kActual:
    case MessageKind::kRobot:
      return settings.robot_s;
    default:
      return std::numeric_limits<double>::infinity();
  }
}

Lost find_lost(const SessionInbox& inbox, const InputSettings& settings) noexcept {
  const bool controller = comes(MessageKind::kController, inbox, settings);
  const ControllerState said = controller_in(inbox.last(MessageKind::kController));
  const Lost silent = unless(comes(MessageKind::kTarget, inbox, settings), Lost::kTarget) |
                      unless(comes(MessageKind::kJoints, inbox, settings), Lost::kJoints) |
                      unless(comes(MessageKind::kRobot, inbox, settings), Lost::kRobot);
  if (!controller) return silent | Lost::kController;
  return silent | unless(said.drives_on, Lost::kDrives) | unless(said.automatic, Lost::kManual) |
         unless(!said.protective_stop, Lost::kStop) |
         unless(said.correction_enabled, Lost::kDisabled) |
         unless(as_expected(settings.tool, said.tool), Lost::kTool) |
         unless(as_expected(settings.frame, said.frame), Lost::kFrame) |
         unless(as_expected(settings.payload, said.payload), Lost::kPayload);
}

bool is_heard(const SessionInbox& inbox, const InputSettings& settings) noexcept {
  return comes(MessageKind::kJoints, inbox, settings) &&
         comes(MessageKind::kController, inbox, settings) &&
         comes(MessageKind::kActual, inbox, settings) &&
         comes(MessageKind::kRobot, inbox, settings);
}

bool is_joint_state(std::span<const double> q) noexcept {
  return std::all_of(q.begin(), q.end(), [](double x) { return std::abs(x) <= kMostJoint; });
}

const char* to_string(Lost one) noexcept {
  switch (one) {
    case Lost::kNothing:
      return "nothing";
    case Lost::kTarget:
      return "target";
    case Lost::kJoints:
      return "joints";
    case Lost::kController:
      return "controller";
    case Lost::kDrives:
      return "drives";
    case Lost::kManual:
      return "manual";
    case Lost::kStop:
      return "stop";
    case Lost::kDisabled:
      return "disabled";
    case Lost::kTool:
      return "tool";
    case Lost::kFrame:
      return "frame";
    case Lost::kPayload:
      return "payload";
    case Lost::kMotion:
      return "motion";
    case Lost::kRobot:
      return "robot";
    case Lost::kComparison:
      return "comparison";
    case Lost::kArmAway:
      return "arm-away";
    case Lost::kArmStill:
      return "arm-still";
    case Lost::kStall:
      return "stall";
    case Lost::kAcknowledge:
      return "acknowledge";
    case Lost::kRestart:
      return "restart";
    case Lost::kAnswers:
      return "answers";
  }
  return "several";
}

}  // namespace plumb::drivers

// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/bus_content.hpp"

#include <algorithm>
#include <cmath>

#include "crc.hpp"

namespace plumb::drivers {
namespace {

BusMessage message_of(MessageKind kind, std::initializer_list<double> values,
                      std::uint16_t counter) {
  BusMessage out;
  out.kind = kind;
  out.counter = counter;
  for (const double value : values) out.values[out.size++] = value;
  return out;
}

BusMessage six(MessageKind kind, const Vector3& p, const Vector3& r, std::uint16_t counter) {
  return message_of(kind, {p(0), p(1), p(2), r(0), r(1), r(2)}, counter);
}

/// The pose in a message of six values, three of position and three of a rotation vector. Nothing
/// if a value is not finite.
std::optional<Transformd> motion_in(const BusMessage& message) {
  const auto& v = message.values;
  if (message.size < 6 ||
      !std::all_of(v.begin(), v.begin() + 6, [](double x) { return std::isfinite(x); }))
    return std::nullopt;
  Transformd out = exp(format::Twist{.d = {0.0, 0.0, 0.0}, .e = {v[3], v[4], v[5]}});
  out.p = {v[0], v[1], v[2]};
  return out;
}

/// Value `i` if it is a whole number between `least` and `most`.
std::optional<int> whole(const BusMessage& message, std::size_t i, int least, int most) {
  const double value = message.values[i];
  if (i >= message.size || !(value >= least && value <= most) || value != std::floor(value))
    return std::nullopt;
  return static_cast<int>(value);
}

}  // namespace

BusMessage pose_message(MessageKind kind, const Transformd& pose, std::uint16_t counter) {
  return six(kind, pose.p, rotation_vector(pose.R), counter);
}

std::optional<Transformd> pose_in(const BusMessage& message) { return motion_in(message); }

BusMessage offset_message(const Transformd& desired, const Transformd& corrected,
                          std::uint16_t counter) {
  return six(MessageKind::kOffset, corrected.p - desired.p,
             rotation_vector(times_transposed(corrected.R, desired.R)), counter);
}

Transformd add_offset(const Transformd& desired, const BusMessage& offset) {
  const auto motion = motion_in(offset);
  if (!motion) return desired;
  const Transformd turned = Transformd{.R = motion->R, .p = Vector3::Zero()} * desired;
  return {.R = turned.R, .p = desired.p + motion->p};
}

BusMessage joints_message(MessageKind kind, std::span<const double> q, std::uint16_t counter) {
  BusMessage out = message_of(kind, {}, counter);
  for (const double value : q.first(std::min(q.size(), kMaxMessageValues)))
    out.values[out.size++] = value;
  return out;
}

BusMessage controller_message(const ControllerState& state, std::uint16_t counter) {
  const unsigned flags = (state.drives_on ? kDrivesOn : 0U) | (state.automatic ? kAutomatic : 0U) |
                         (state.protective_stop ? kProtectiveStop : 0U) |
                         (state.correction_enabled ? kCorrectionEnabled : 0U) |
                         (state.acknowledge ? kAcknowledge : 0U);
  return message_of(MessageKind::kController,
                    {static_cast<double>(flags), static_cast<double>(state.tool),
                     static_cast<double>(state.frame), static_cast<double>(state.payload)},
                    counter);
}

std::optional<ControllerState> possible_controller(const BusMessage& message) {
  const auto word = whole(message, 0, 0, (1 << 23) - 1);
  const auto tool = whole(message, 1, 0, 255), frame = whole(message, 2, 0, 255),
             payload = whole(message, 3, 0, 255);
  if (!word || !tool || !frame || !payload) return std::nullopt;
  const auto flags = static_cast<unsigned>(*word);
  return ControllerState{.drives_on = (flags & kDrivesOn) != 0,
                         .automatic = (flags & kAutomatic) != 0,
                         .protective_stop = (flags & kProtectiveStop) != 0,
                         .correction_enabled = (flags & kCorrectionEnabled) != 0,
                         .acknowledge = (flags & kAcknowledge) != 0,
                         .tool = static_cast<std::uint8_t>(*tool),
                         .frame = static_cast<std::uint8_t>(*frame),
                         .payload = static_cast<std::uint8_t>(*payload)};
}

ControllerState controller_in(const BusMessage& message) {
  return possible_controller(message).value_or(ControllerState{});
}

BusMessage status_message(const SessionStatus& status, std::uint16_t counter) {
  return message_of(
      MessageKind::kStatus,
      {static_cast<double>(status.state), static_cast<double>(status.mode),
       static_cast<double>(status.asks ? kAsksForAcknowledgement : static_cast<int>(status.status)),
       status.has_output ? 1.0 : 0.0, static_cast<double>(status.refused),
       static_cast<double>(status.limited), static_cast<double>(status.stale)},
      counter);
}

SessionStatus status_in(const BusMessage& message) {
  const auto state = whole(message, 0, 0, 5), mode = whole(message, 1, 0, 2),
             status = whole(message, 2, static_cast<int>(Status::kStale), kAsksForAcknowledgement),
             output = whole(message, 3, 0, 1);
  if (!state || !mode || !status || !output) return {};
  const bool asks = *status == kAsksForAcknowledgement;
  const auto counter = [&](std::size_t i) {
    return static_cast<std::uint16_t>(whole(message, i, 0, 0xFFFF).value_or(0));
  };
  return {.state = static_cast<SessionState>(*state),
          .mode = static_cast<CorrectionMode>(*mode),
          .status = asks ? Status::kOk : static_cast<Status>(*status),
          .asks = asks,
          .has_output = *output == 1,
          .refused = counter(4),
          .limited = counter(5),
          .stale = counter(6)};
}

std::uint32_t fingerprint(std::string_view text) {
  Crc32P4 crc;
  for (const char c : text) crc.add(static_cast<std::uint8_t>(c));
  return 1U + crc.value() % 0x7FFFFFU;
}

BusMessage robot_message(std::uint32_t fingerprint, std::uint16_t counter) {
  return message_of(MessageKind::kRobot, {static_cast<double>(fingerprint)}, counter);
}

BusMessage signature_message(std::uint32_t model, std::uint32_t robot, std::uint16_t counter) {
  return message_of(MessageKind::kSignature,
                    {static_cast<double>(model), static_cast<double>(robot)}, counter);
}

}  // namespace plumb::drivers

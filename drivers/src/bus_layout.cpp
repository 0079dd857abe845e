// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/bus_layout.hpp"

#include <algorithm>
#include <cmath>

namespace plumb::drivers {
namespace {

constexpr double kMicro = 1e-6;
constexpr std::uint16_t kOwnerRegister = 1288;

/// Identifier and registers of a message in the default layout. The identifiers lie between
/// CANopen's time stamp and its first process data. Lower identifiers win the bus, so the most
/// urgent messages have the lowest. Everything the controller sends, except the context, can be
/// read with one Modbus request of 125 registers.
struct DefaultMessage {  // NOLINT(clang-analyzer-optin.performance.Padding): in the order of its
                         // table
  MessageKind kind;
  const char* name;
  Sender sender;
  std::uint32_t can_id;
  std::uint16_t first_register;
  double period_s;  // 0 means every cycle
};

constexpr DefaultMessage kDefaultMessages[] = {
    {MessageKind::kController, "controller", Sender::kController, 0x110, 1096, 0.004},
    {MessageKind::kTarget, "target", Sender::kController, 0x118, 1048, 0.0},
    {MessageKind::kJoints, "joints", Sender::kController, 0x120, 1000, 0.0},
    {MessageKind::kCommanded, "commanded", Sender::kController, 0x128, 1024, 0.0},
    {MessageKind::kCorrected, "corrected", Sender::kPlumb, 0x130, 1200, 0.0},
    {MessageKind::kOffset, "offset", Sender::kPlumb, 0x138, 1224, 0.0},
    {MessageKind::kStatus, "status", Sender::kPlumb, 0x140, 1248, 0.020},
    {MessageKind::kActual, "actual", Sender::kController, 0x148, 1072, 0.020},
    {MessageKind::kRobot, "robot", Sender::kController, 0x150, 1112, 0.200},
    {MessageKind::kContext, "context", Sender::kController, 0x158, 1128, 0.200},
    {MessageKind::kSignature, "signature", Sender::kPlumb, 0x160, 1272, 0.200},
};

const DefaultMessage& default_of(MessageKind kind) noexcept {
  return *std::find_if(std::begin(kDefaultMessages), std::end(kDefaultMessages),
                       [&](const DefaultMessage& p) { return p.kind == kind; });
}

std::vector<Signal> numbers(std::initializer_list<const char*> names) {
  std::vector<Signal> out;
  for (const char* name : names) out.push_back({name, "", 1.0});
  return out;
}

std::vector<Signal> lengths_and_angles(std::initializer_list<const char*> lengths,
                                       std::initializer_list<const char*> angles, double length) {
  std::vector<Signal> out;
  for (const char* name : lengths) out.push_back({name, "um", length});
  for (const char* name : angles) out.push_back({name, "urad", kMicro});
  return out;
}

std::vector<Signal> joint_signals(int joints) {
  std::vector<Signal> out;
  for (int i = 1; i <= joints; ++i) out.push_back({"q" + std::to_string(i), "urad", kMicro});
  return out;
}

/// The values of the context message. In 24 bits their scales reach 8 t, 8 m, 23 hours and 8000
/// degC.
std::vector<Signal> context_signals(int temperatures) {
  std::vector<Signal> out{{"payload", "kg", 1e-3}};
  for (const char* name : {"com_x", "com_y", "com_z"}) out.push_back({name, "um", kMicro});
  out.push_back({"time", "s", 1e-2});
  for (int i = 1; i <= temperatures; ++i) out.push_back({"t" + std::to_string(i), "degC", 1e-3});
  return out;
}

std::vector<Signal> signals_of(MessageKind kind, int joints, int temperatures) {
  switch (kind) {
    case MessageKind::kJoints:
    case MessageKind::kCommanded:
      return joint_signals(joints);
    case MessageKind::kController:
      return numbers({"flags", "tool", "frame", "payload"});
    case MessageKind::kRobot:
      return numbers({"serial"});
    case MessageKind::kContext:
      return context_signals(temperatures);
    case MessageKind::kOffset:  // an int16 of 0.1 um reaches 3.2 mm, of 1 urad 1.8 degrees
      return lengths_and_angles({"dx", "dy", "dz"}, {"drx", "dry", "drz"}, 0.1 * kMicro);
    case MessageKind::kStatus:
      return numbers({"state", "mode", "status", "output", "refused", "limited", "stale"});
    case MessageKind::kSignature:
      return numbers({"model", "robot"});
    default:
      return lengths_and_angles({"x", "y", "z"}, {"rx", "ry", "rz"}, kMicro);
  }
}

/// The period rounded up to a whole number of cycles; a period of 0 becomes one cycle.
double whole_cycles(double period_s, double cycle_s) {
  return cycle_s * std::max(1.0, std::ceil(period_s / cycle_s - 1e-9));
}

}  // namespace

const MessageLayout* BusLayout::find(MessageKind kind) const {
  const auto found = std::find_if(messages.begin(), messages.end(),
                                  [&](const MessageLayout& m) { return m.kind == kind; });
  return found == messages.end() ? nullptr : &*found;
}

const char* name_of(MessageKind kind) noexcept { return default_of(kind).name; }

double si_per_unit(const std::string& unit) {
  return unit == "um" || unit == "urad" ? kMicro : 1.0;
}

MessageLayout default_message(MessageKind kind, int joints, double cycle_s, int temperatures) {
  const DefaultMessage& usual = default_of(kind);
  return {.kind = kind,
          .name = usual.name,
          .sender = usual.sender,
          .signals = signals_of(kind, joints, temperatures),
          .can_id = usual.can_id,
          .first_register = usual.first_register,
          .period_s = whole_cycles(usual.period_s, cycle_s)};
}

BusLayout default_layout(int joints, double cycle_s, int temperatures, CorrectionForm correction) {
  const bool offset = correction == CorrectionForm::kOffset;
  BusLayout out;
  out.correction = correction;
  out.owner_register = kOwnerRegister;
  for (const DefaultMessage& usual : kDefaultMessages) {
    if (usual.kind == MessageKind::kCommanded && joints <= 6) continue;
    if (usual.kind == (offset ? MessageKind::kCorrected : MessageKind::kOffset)) continue;
    out.messages.push_back(default_message(usual.kind, joints, cycle_s, temperatures));
  }
  return out;
}

std::size_t modbus_registers(const MessageLayout& message) {
  return 2 * message.signals.size() + 3;
}

std::size_t modbus_registers(const BusLayout& layout) {
  std::size_t out = layout.owner_register ? kOwnerRegisters : 0U;
  for (const MessageLayout& message : layout.messages) out += modbus_registers(message);
  return out;
}

}  // namespace plumb::drivers

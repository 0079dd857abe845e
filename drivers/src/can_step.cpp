// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/can_step.hpp"

#include <cerrno>
#include <cmath>
#include <cstring>

namespace plumb::drivers {
namespace {

/// True for virtual interfaces such as vcan0 and vxcan1, which have no bit rate.
bool is_virtual(const std::string& interface) {
  return interface.starts_with("vcan") || interface.starts_with("vxcan");
}

std::string whole(double rate) { return std::to_string(std::llround(rate)); }

std::string name(const CanStep& step) { return step.interface.data(); }

std::string what(const CanStep& step) {
  switch (step.kind) {
    case CanStepKind::kSocket:
      return "CAN socket";
    case CanStepKind::kInterface:
      return "CAN interface";
    case CanStepKind::kUp:
      return "interface up";
    case CanStepKind::kFormat:
      return "CAN FD";
    case CanStepKind::kOptions:
      return "socket options";
    case CanStepKind::kFilters:
      return "filters";
    case CanStepKind::kBind:
      return "bind";
  }
  return "CAN";
}

std::string why(const CanStep& step) {
  const std::string reason = std::strerror(step.error);
  switch (step.kind) {
    case CanStepKind::kSocket:
      return "socket(PF_CAN, SOCK_RAW, CAN_RAW): " + reason;
    case CanStepKind::kInterface:
      if (step.error == ENODEV) return "there is no interface " + name(step);
      if (step.error == EPFNOSUPPORT) return name(step) + " is no CAN interface";
      return name(step) + ": " + reason;
    case CanStepKind::kUp:
      return name(step) + " is down";
    case CanStepKind::kFormat:
      return name(step) + " carries classic frames only, and the layout is CAN FD";
    default:
      return name(step) + ": " + reason;
  }
}

std::string remedy(const CanStep& step) {
  switch (step.kind) {
    case CanStepKind::kSocket:
      return "sudo modprobe can_raw";
    case CanStepKind::kInterface:
      return "ip -details link show type can";
    case CanStepKind::kUp:
    case CanStepKind::kFormat:
      return set_up_command(name(step), step.format, 0.0, 0.0);
    default:
      return "ip -details link show " + name(step);
  }
}

}  // namespace

std::string set_up_command(const std::string& interface, CanFrame::Format format, double bit_rate,
                           double data_bit_rate) {
  const bool fd = format == CanFrame::Format::kFd;
  if (is_virtual(interface)) return "sudo ip link set " + interface + (fd ? " mtu 72" : "") + " up";
  std::string out = "sudo ip link set " + interface + " down && sudo ip link set " + interface +
                    " up type can bitrate " + whole(bit_rate > 0.0 ? bit_rate : 1e6);
  if (fd) out += " dbitrate " + whole(data_bit_rate > 0.0 ? data_bit_rate : 4e6) + " fd on";
  return out + " restart-ms 100";
}

Finding describe(const CanStep& step) {
  Finding out{.what = what(step), .grant = step.grant, .why = "not asked for", .remedy = ""};
  if (step.grant == Grant::kGranted) out.why = name(step) + " is open";
  if (step.grant != Grant::kDenied) return out;
  out.why = why(step);
  out.remedy = remedy(step);
  return out;
}

}  // namespace plumb::drivers

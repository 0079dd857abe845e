// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <linux/can.h>
#include <net/if.h>

#include <cstdlib>

#include "plumb/drivers/can_step.hpp"
#include "rt/check.hpp"

namespace plumb::drivers::rt {
namespace {

constexpr const char* kArphrdCan = "280";  // linux/if_arp.h

/// 0 if the file is not there or holds none; hexadecimal with 0x.
unsigned long number(const MachineFiles& files, const std::string& file) {
  return std::strtoul(files.read(file).value_or("").c_str(), nullptr, 0);
}

std::string rate(const CanInterface& interface) {
  if (!interface.bit_rate)
    return interface.kind == "can"  ? "no bit rate set"
           : interface.kind.empty() ? "bit rate unknown"
                                    : interface.kind + ", without a bit rate";
  std::string out = fmt::format("{} bit/s", *interface.bit_rate);
  if (interface.data_bit_rate) out += fmt::format(", data {} bit/s", *interface.data_bit_rate);
  return out;
}

std::string restart(const CanInterface& interface) {
  if (interface.kind != "can" || !interface.restart_ms) return "";
  return *interface.restart_ms == 0
             ? ", stays bus-off until someone restarts it"
             : fmt::format(", restarts {} ms after bus-off", *interface.restart_ms);
}

std::string remedy(const CanInterface& interface) {
  switch (state_of(interface)) {
    case CanState::kUp:
      return "";
    case CanState::kDown:
      return set_up_command(interface.name,
                            interface.fd ? CanFrame::Format::kFd : CanFrame::Format::kClassic,
                            interface.bit_rate.value_or(0), interface.data_bit_rate.value_or(0));
    case CanState::kBusOff:
      return "sudo ip link set " + interface.name + " type can restart";
  }
  return "";
}

Check check_of(const CanInterface& interface) {
  const CanState state = state_of(interface);
  return {.id = "can:" + interface.name,
          .need = Need::kAdvice,
          .finding = {.what = interface.name,
                      .grant = state == CanState::kUp ? Grant::kGranted : Grant::kDenied,
                      .why = fmt::format("{}, {}, {}{}", to_string(state),
                                         interface.fd ? "CAN FD" : "classic CAN", rate(interface),
                                         restart(interface)),
                      .remedy = remedy(interface)}};
}

}  // namespace

const char* to_string(CanState state) {
  switch (state) {
    case CanState::kUp:
      return "up";
    case CanState::kDown:
      return "down";
    case CanState::kBusOff:
      return "bus-off";
  }
  return "down";
}

CanState state_of(const CanInterface& interface) {
  if (!interface.up) return CanState::kDown;
  return interface.carrier ? CanState::kUp : CanState::kBusOff;
}

std::vector<CanInterface> can_interfaces(const MachineFiles& files) {
  std::vector<CanInterface> out;
  for (const std::string& name : files.names("sys/class/net")) {
    const std::string folder = "sys/class/net/" + name;
    if (files.read(folder + "/type") != kArphrdCan) continue;
    out.push_back({.name = name,
                   .kind = "",
                   .up = (number(files, folder + "/flags") & IFF_UP) != 0,
                   .carrier = number(files, folder + "/carrier") == 1,
                   .fd = number(files, folder + "/mtu") >= CANFD_MTU});
  }
  return out;
}

std::vector<Check> can_checks(std::span<const CanInterface> interfaces) {
  std::vector<Check> out;
  for (const CanInterface& interface : interfaces) out.push_back(check_of(interface));
  if (out.empty())
    out.push_back({.id = "can",
                   .need = Need::kAdvice,
                   .finding = {.what = "CAN interfaces",
                               .grant = Grant::kSkipped,
                               .why = "none; not needed with Modbus"}});
  return out;
}

}  // namespace plumb::drivers::rt

// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "plumb/drivers/can_interface.hpp"
#include "plumb/drivers/can_step.hpp"

namespace plumb::drivers {
namespace {

/// True if the rates differ by at most 0.5 %. CAN controllers divide a clock and meet most rates
/// only approximately.
bool same_rate(double asked, double set) { return std::abs(asked - set) <= 5e-3 * asked; }

std::string bits(double rate) { return std::to_string(std::llround(rate)) + " bit/s"; }

std::string mismatch(const std::string& which, double asked, double set) {
  return "the " + which + " is " + bits(set) + ", the layout says " + bits(asked);
}

}  // namespace

std::vector<Finding> misfits(const BusLayout& layout, const CanInterface& interface) {
  std::vector<Finding> out;
  const std::string remedy =
      set_up_command(interface.name, layout.can_format, layout.bit_rate, layout.data_bit_rate);
  const auto say = [&](Grant grant, std::string why) {
    out.push_back(
        {.what = interface.name, .grant = grant, .why = std::move(why), .remedy = remedy});
  };
  const bool fd = layout.can_format == CanFrame::Format::kFd;
  if (!interface.up) say(Grant::kDenied, interface.name + " is down");
  if (fd && !interface.fd)
    say(Grant::kDenied, interface.name + " carries classic frames only, and the layout is CAN FD");
  if (interface.bit_rate && !same_rate(layout.bit_rate, *interface.bit_rate))
    say(Grant::kDenied, mismatch("bit rate", layout.bit_rate, *interface.bit_rate));
  if (fd && interface.data_bit_rate && !same_rate(layout.data_bit_rate, *interface.data_bit_rate))
    say(Grant::kDenied,
        mismatch("bit rate of the data phase", layout.data_bit_rate, *interface.data_bit_rate));
  if (interface.restart_ms == 0U && interface.kind == "can")
    say(Grant::kSkipped, interface.name + " stays bus-off until someone restarts it");
  return out;
}

}  // namespace plumb::drivers

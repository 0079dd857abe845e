// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "plumb/drivers/can_frame.hpp"
#include "plumb/drivers/finding.hpp"

namespace plumb::drivers {

/// The steps that open a CAN interface, in the order in which they are taken.
enum class CanStepKind : std::uint8_t {
  kSocket,     // the kernel supports CAN and grants a socket
  kInterface,  // the interface exists and is a CAN interface
  kUp,
  kFormat,  // the interface carries the frames that the layout asks for
  kOptions,
  kFilters,
  kBind,
};

/// The last step that was taken. If it was granted all steps succeeded, else this one was denied.
struct CanStep {
  CanStepKind kind = CanStepKind::kSocket;
  Grant grant = Grant::kSkipped;
  int error = 0;                        // errno of a denial
  std::array<char, 16> interface = {};  // "can0", ends with 0
  CanFrame::Format format = CanFrame::Format::kClassic;
};

/// Describes the step in words.
Finding describe(const CanStep& step);

/// The shell command that sets up an interface in this format and with these bit rates [bit/s]; 0
/// means the default of BusLayout.
std::string set_up_command(const std::string& interface, CanFrame::Format format, double bit_rate,
                           double data_bit_rate);

}  // namespace plumb::drivers

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "plumb/drivers/can_frame.hpp"
#include "plumb/drivers/finding.hpp"

namespace plumb::drivers {

/// The steps that open a CAN interface, in the order in which they are taken.
enum class CanStepKind : std::uint8_t {
  kSocket,     // the kernel speaks CAN, and lets us
  kInterface,  // it is there, and a CAN interface
  kUp,
  kFormat,  // it carries the frames that the layout asks for
  kOptions,
  kFilters,
  kBind,
};

/// The last step that was taken: granted, all went well; else, this one was denied.
struct CanStep {
  CanStepKind kind = CanStepKind::kSocket;
  Grant grant = Grant::kSkipped;
  int error = 0;                        // errno of a denial
  std::array<char, 16> interface = {};  // "can0", ends with 0
  CanFrame::Format format = CanFrame::Format::kClassic;
};

/// The step in words.
Finding describe(const CanStep& step);

/// The command that sets an interface up as the layout asks; rates of 0 stand for any.
std::string set_up_command(const std::string& interface, CanFrame::Format format, double bit_rate,
                           double data_bit_rate);

}  // namespace plumb::drivers

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "plumb/drivers/bus_layout.hpp"
#include "plumb/drivers/finding.hpp"

namespace plumb::drivers {

/// What the kernel tells of a CAN interface.
struct CanInterface {
  std::string name;
  std::string kind;  // "can": a controller; "vcan", "vxcan": no wire and no bit rate
  bool up = false;
  bool carrier = false;                        // not bus-off
  bool fd = false;                             // CAN FD frames fit (MTU 72)
  std::optional<std::uint32_t> bit_rate = {};  // [bit/s]; none: not set, or there is none
  std::optional<std::uint32_t> data_bit_rate = {};
  std::optional<std::uint32_t> restart_ms = {};  // 0: stays bus-off
};

/// All CAN interfaces of this machine, by their index; asks the kernel (rtnetlink). Slow, needs no
/// rights. None if it does not answer.
std::vector<CanInterface> read_can_interfaces();

/// Nothing if there is no CAN interface of this name.
std::optional<CanInterface> read_can_interface(const std::string& name);

/// Why this layout cannot be spoken over this interface: down, classic only, another bit rate, and,
/// as findings that are skipped instead of denied, what only deserves a word: no automatic restart.
/// Empty: it fits.
std::vector<Finding> misfits(const BusLayout& layout, const CanInterface& interface);

}  // namespace plumb::drivers

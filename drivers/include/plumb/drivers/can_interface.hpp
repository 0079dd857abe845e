// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "plumb/drivers/bus_layout.hpp"
#include "plumb/drivers/finding.hpp"

namespace plumb::drivers {

/// The properties of a CAN interface as the kernel reports them.
struct CanInterface {
  std::string name;
  std::string kind;  // "can": a controller; "vcan", "vxcan": no wire and no bit rate
  bool up = false;
  bool carrier = false;                        // false if bus-off
  bool fd = false;                             // the interface carries CAN FD frames (MTU 72)
  std::optional<std::uint32_t> bit_rate = {};  // [bit/s]; none if not set or not applicable
  std::optional<std::uint32_t> data_bit_rate = {};
  std::optional<std::uint32_t> restart_ms = {};  // restart after bus-off; 0: no restart
};

/// All CAN interfaces of this machine, ordered by index, from the kernel (rtnetlink). Slow; needs
/// no privileges. Empty if the kernel does not answer.
std::vector<CanInterface> read_can_interfaces();

/// The CAN interface of this name, or none.
std::optional<CanInterface> read_can_interface(const std::string& name);

/// Why this layout cannot be used over this interface: it is down, carries classic frames only, or
/// has another bit rate. A missing automatic restart is only a remark and has Grant::kSkipped
/// instead of kDenied. Empty if all is well.
std::vector<Finding> misfits(const BusLayout& layout, const CanInterface& interface);

}  // namespace plumb::drivers

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "plumb/format/model.hpp"

namespace plumb {

/// Why one model cannot take the place of another in a running cycle.
enum class BindingFault : std::uint8_t {
  kNone,
  kSerial,   // made for another robot
  kNominal,  // the controller's own chain, base or tool differs
  kSensors   // its temperature sensors are counted in another order
};

/// Finds out whether `next` may replace `running`. The serial number and everything the controller
/// computes with (nominal chain, base, tool) must be equal; names and limits of joints may differ.
/// One model may have more temperature sensors than the other, if the common ones are in the same
/// order.
/// Heap: none. Thread: any. Cost: grows with joints and sensors; load phase. Errors: none.
BindingFault find_binding_fault(const format::Model& running, const format::Model& next) noexcept;

/// The fault in plain English, for example "made for another robot: the serial differs".
const char* to_string(BindingFault fault) noexcept;

}  // namespace plumb

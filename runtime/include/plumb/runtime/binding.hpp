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

/// Names and limits of joints may differ; what the controller computes with may not. Sensors may
/// be more or fewer, in the same order.
/// Heap: none. Thread: any. Cost: grows with joints and sensors; load phase. Errors: none.
BindingFault find_binding_fault(const format::Model& running, const format::Model& next) noexcept;

/// Plain English, for example "made for another robot".
const char* to_string(BindingFault fault) noexcept;

}  // namespace plumb

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/drivers/sensor_places.hpp"
#include "plumb/drivers/session_inbox.hpp"
#include "plumb/runtime/context_inputs.hpp"

namespace plumb::drivers {

/// The readings of a context message that arrived in this cycle, each as old as the message; there
/// are none if no message arrived or a value is unknown. Temperatures are in the model's order.
/// Pure. Heap: none. Cost: fixed.
ContextReadings context_in(const SessionInbox& inbox, const SensorPlaces& sensors) noexcept;

}  // namespace plumb::drivers

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/drivers/sensor_places.hpp"
#include "plumb/drivers/session_inbox.hpp"
#include "plumb/runtime/context_inputs.hpp"

namespace plumb::drivers {

/// What a context message that is new in this cycle tells the model, each reading as old as its
/// message; nothing if none came, and of a value that is not known. Temperatures as the model
/// counts them. Pure; heap: none; cost: fixed.
ContextReadings context_in(const SessionInbox& inbox, const SensorPlaces& sensors) noexcept;

}  // namespace plumb::drivers

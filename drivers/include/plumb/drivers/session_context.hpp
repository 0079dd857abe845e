// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/drivers/session_inbox.hpp"
#include "plumb/runtime/context_inputs.hpp"

namespace plumb::drivers {

/// What a context message that is new in this cycle tells the model, each reading as old as its
/// message; nothing if none came, and of a value that is not known. Temperatures in the order of
/// the message. Pure; heap: none; cost: fixed.
ContextReadings context_in(const SessionInbox& inbox) noexcept;

}  // namespace plumb::drivers

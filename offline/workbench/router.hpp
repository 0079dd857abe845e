// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "workbench/access.hpp"
#include "workbench/request.hpp"
#include "workbench/response.hpp"
#include "workbench/services.hpp"

namespace plumb::offline::workbench {

/// The answer to any request, whatever its bytes: a refusal, what `services` say, or their failure
/// as {"error": ...}. Never throws. Nothing but `services` touches a file or a process.
Response answer(const Request& request, const Access& access, Services& services);

}  // namespace plumb::offline::workbench

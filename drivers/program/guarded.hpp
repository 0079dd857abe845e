// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "program/outcome.hpp"

namespace plumb {

/// Runs `work`; whatever it throws becomes errors and exit code of `outcome`: a Failure its own, a
/// file system error kEnvironment, no memory kEnvironment, anything else a bug of
/// `program`, kBug.
void guarded(const std::string& program, const std::function<void()>& work, Outcome& outcome);

}  // namespace plumb

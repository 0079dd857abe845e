// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "cli/outcome.hpp"

namespace plumb::offline::cli {

/// Runs `work`; whatever it throws becomes errors and exit code of `outcome`: a Failure its own, a
/// file system error kEnvironment, no memory kEnvironment, anything else kBug.
void guarded(const std::function<void()>& work, Outcome& outcome);

}  // namespace plumb::offline::cli

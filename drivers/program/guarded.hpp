// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "program/outcome.hpp"

namespace plumb {

/// Runs `work` and turns an exception into errors and exit code of `outcome`: a Failure into its
/// own, a file system error or lack of memory into kEnvironment, anything else into kBug, a bug of
/// `program`.
void guarded(const std::string& program, const std::function<void()>& work, Outcome& outcome);

}  // namespace plumb

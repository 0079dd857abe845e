// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/outcome.hpp"

namespace plumb::offline::cli {

/// The one object of --json: {schema, ok, command, version, inputs, warnings, result, error}.
Json envelope(const std::string& verb, const Outcome& outcome);

/// Remarks and errors on stderr, the result on stdout. Returns the exit code: that of the outcome,
/// or kEnvironment if stdout cannot be written.
int report(const std::string& verb, const Globals& globals, const Outcome& outcome);

}  // namespace plumb::offline::cli

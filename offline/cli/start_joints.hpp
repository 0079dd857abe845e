// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plumb/format/model.hpp"

namespace plumb::offline::cli {

/// The joint angles [rad] or travels [m] of --start, given as the controller counts, in deg or mm;
/// none without the option. Throws Failure (kUsage).
std::vector<double> start_of(const std::optional<std::string>& text, const format::Chain& chain);

}  // namespace plumb::offline::cli

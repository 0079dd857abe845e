// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "plumb/format/model.hpp"

namespace plumb::format::internal {

/// Why the formula of an effect cannot be run or shown. Empty if it can, or if there is no formula.
std::optional<std::string> unsound_formula(const Effect& effect, std::size_t joints);

}  // namespace plumb::format::internal

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace plumb::offline {

/// One --map option with all wishes, "Goal x=nx_m", quoted so that a shell takes it as one word.
std::string map_option(const std::vector<std::string>& wishes);

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace plumb::offline::show {

/// "geometry, gear_ripple x58": each name once, in the order in which they first stand.
std::string counted(const std::vector<std::string>& names);

}  // namespace plumb::offline::show

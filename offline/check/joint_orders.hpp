// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace plumb::offline {

/// Other orders in which the columns of these joints may stand: all of up to six joints; of more,
/// two of them swapped, and neighbours moved on by one place or reversed.
std::vector<std::vector<int>> joint_orders(const std::vector<int>& joints);

}  // namespace plumb::offline

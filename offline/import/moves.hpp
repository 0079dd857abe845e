// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace plumb::offline {

/// How one joint arrived at each row, if rows are consecutive moves.
struct Arrivals {
  std::vector<int> direction;  // +1, -1; 0 before its first move
  std::vector<double> travel;  // size of its last move, in the unit of q
};

/// An unchanged joint (less than `still`) keeps its last direction and travel.
Arrivals arrivals_from_order(const std::vector<double>& q, double still);

}  // namespace plumb::offline

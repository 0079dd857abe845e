// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <vector>

#include "solve/fit_data.hpp"

namespace plumb::offline {

/// At most `most` of the rows, evenly picked. Set-ups of few readings stay whole, or what is left
/// of them could no longer tell where their tracker stands; so there may be some more.
std::vector<int> thinned(const Measurements& measured, const std::vector<int>& rows, int most);
inline std::vector<int> thinned(const FitData& data, int most) {
  return thinned(*data.measured, data.rows, most);
}

/// How many of the rows are of each set-up.
std::map<int, int> rows_by_setup(const Measurements& measured, const std::vector<int>& rows);

}  // namespace plumb::offline

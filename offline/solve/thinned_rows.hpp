// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <vector>

#include "solve/fit_data.hpp"

namespace plumb::offline {

/// About `most` of the rows, picked evenly. Set-ups of few readings keep all of them, since fewer
/// might not tell where their tracker stands; the result may therefore be longer than `most`.
std::vector<int> thinned(const Measurements& measured, const std::vector<int>& rows, int most);
inline std::vector<int> thinned(const FitData& data, int most) {
  return thinned(*data.measured, data.rows, most);
}

/// Number of rows of each set-up.
std::map<int, int> rows_by_setup(const Measurements& measured, const std::vector<int>& rows);

}  // namespace plumb::offline

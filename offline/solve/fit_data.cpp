// SPDX-License-Identifier: Apache-2.0
#include "solve/fit_data.hpp"

namespace plumb::offline {

int FitData::residual_count() const {
  int out = 0;
  for (const int row : rows) out += reading(row).lines();
  return out;
}

LineTable FitData::line_table() const {
  std::vector<int> counts;
  counts.reserve(rows.size());
  for (const int row : rows) counts.push_back(reading(row).lines());
  return LineTable(counts);
}

}  // namespace plumb::offline

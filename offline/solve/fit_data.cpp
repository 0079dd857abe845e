// SPDX-License-Identifier: Apache-2.0
#include "solve/fit_data.hpp"

namespace plumb::offline {

int FitData::lines_of(int) const {
  int lines = sigma_rad > 0.0 ? 3 : 0;
  for (const bool has : measured->has_axis) lines += has ? 1 : 0;
  return lines;
}

int FitData::residual_count() const {
  int out = 0;
  for (const int row : rows) out += lines_of(row);
  return out;
}

LineTable FitData::line_table() const {
  std::vector<int> counts;
  counts.reserve(rows.size());
  for (const int row : rows) counts.push_back(lines_of(row));
  return LineTable(counts);
}

}  // namespace plumb::offline

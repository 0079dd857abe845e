// SPDX-License-Identifier: Apache-2.0
#include "solve/outlier.hpp"

#include <unordered_set>

namespace plumb::offline {

std::vector<int> without_outliers(std::vector<int> rows, const std::vector<Outlier>& outliers) {
  std::unordered_set<int> out;
  for (const auto& outlier : outliers) out.insert(outlier.row);
  std::erase_if(rows, [&](int row) { return out.contains(row); });
  return rows;
}

}  // namespace plumb::offline

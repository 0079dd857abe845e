// SPDX-License-Identifier: Apache-2.0
#include "solve/thinned_rows.hpp"

#include <algorithm>

#include "arm/arm_state.hpp"
#include "solve/constants.hpp"

namespace plumb::offline {
std::map<int, int> rows_by_setup(const Measurements& measured, const std::vector<int>& rows) {
  std::map<int, int> out;
  for (const int row : rows) ++out[setup_of(measured, row)];
  return out;
}

std::vector<int> thinned(const Measurements& measured, const std::vector<int>& rows, int most) {
  if (static_cast<int>(rows.size()) <= most) return rows;
  std::map<int, int> count = rows_by_setup(measured, rows);
  std::vector<int> out, many;
  for (const int row : rows)
    (count[setup_of(measured, row)] <= kFewOfSetup ? out : many).push_back(row);
  const std::size_t room =
      std::min(many.size(),
               static_cast<std::size_t>(std::max(most / 2, most - static_cast<int>(out.size()))));
  for (std::size_t i = 0; i < room; ++i) out.push_back(many[many.size() * i / room]);
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <span>
#include <vector>

namespace plumb::offline {

/// Calls visit(rows of one group, in their order) for group after group. group: of each row of a
/// table; rows: those to look at. Memory: two numbers a row.
template <class Visit>
void visit_groups(const std::vector<int>& group, std::vector<int> rows, const Visit& visit) {
  const auto of = [&](int row) { return group[static_cast<std::size_t>(row)]; };
  std::stable_sort(rows.begin(), rows.end(), [&](int a, int b) { return of(a) < of(b); });
  for (auto begin = rows.begin(), end = begin; begin != rows.end(); begin = end) {
    end = std::find_if(begin, rows.end(), [&](int row) { return of(row) != of(*begin); });
    visit(std::span<const int>(begin, end));
  }
}

/// How many groups there are if they are numbered 0, 1, 2 ...
inline std::size_t count_groups(const std::vector<int>& group) {
  return group.empty()
             ? 0
             : 1 + static_cast<std::size_t>(*std::max_element(group.begin(), group.end()));
}

}  // namespace plumb::offline

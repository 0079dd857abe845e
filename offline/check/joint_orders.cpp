// SPDX-License-Identifier: Apache-2.0
#include "check/joint_orders.hpp"

#include <algorithm>
#include <cstddef>

#include "check/constants.hpp"

namespace plumb::offline {

std::vector<std::vector<int>> joint_orders(const std::vector<int>& joints) {
  std::vector<std::vector<int>> out;
  std::vector<int> order = joints;
  if (joints.size() <= check::kAllOrders) {
    while (std::next_permutation(order.begin(), order.end())) out.push_back(order);
    return out;
  }
  for (std::size_t from = 0; from < joints.size(); ++from)
    for (std::size_t to = from + 1; to < joints.size(); ++to) {
      const auto begin = static_cast<std::ptrdiff_t>(from), end = static_cast<std::ptrdiff_t>(to);
      order = joints;
      std::swap(order[from], order[to]);
      out.push_back(order);
      if (to == from + 1) continue;
      order = joints;
      std::rotate(order.begin() + begin, order.begin() + begin + 1, order.begin() + end + 1);
      out.push_back(order);
      order = joints;
      std::rotate(order.begin() + begin, order.begin() + end, order.begin() + end + 1);
      out.push_back(order);
      if (to == from + 2) continue;  // reversed, these are swapped
      order = joints;
      std::reverse(order.begin() + begin, order.begin() + end + 1);
      out.push_back(order);
    }
  return out;
}

}  // namespace plumb::offline

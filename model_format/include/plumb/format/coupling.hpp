// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include "plumb/format/model.hpp"

namespace plumb::format {

/// Puts couplings in such an order that the angle of a joint depends only on values that the
/// couplings ahead of it have settled. False if there is none, because two joints depend on each
/// other.
inline bool put_in_order(std::span<JointCoupling> couplings) noexcept {
  while (!couplings.empty()) {
    const auto settled = [&](const JointCoupling& one) {
      return std::none_of(couplings.begin(), couplings.end(),
                          [&](const JointCoupling& other) { return other.joint == one.by; });
    };
    const auto next = std::find_if(couplings.begin(), couplings.end(), settled);
    if (next == couplings.end()) return false;
    std::swap(*next, couplings.front());
    couplings = couplings.subspan(1);
  }
  return true;
}

}  // namespace plumb::format

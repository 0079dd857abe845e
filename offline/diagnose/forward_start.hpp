// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "check/effect_rules.hpp"

namespace plumb::offline {

/// What a selection works on; the cell's own effects are the start. The measurements must outlive
/// the selection.
struct ForwardStart {
  Cell cell;
  const Measurements& measured;
  std::vector<int> fit;  // rows
  std::vector<std::string> not_testable;
  std::function<void(const std::string&)> tell;  // progress; may be empty
  std::vector<Testable> excluded = {};  // not_testable, and why; empty: nobody asks for look-alikes
};

}  // namespace plumb::offline

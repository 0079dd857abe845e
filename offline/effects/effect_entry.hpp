// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <variant>
#include <vector>

#include "program/problem.hpp"

namespace plumb::offline {

/// One entry of [effects]; `geometry` comes first unless the file says `geometry = false`.
struct EffectEntry {
  using Value = std::variant<bool, double, std::string, std::vector<std::string>>;
  std::string name;
  std::vector<int> joints;  // zero-based, empty = all
  std::map<std::string, Value> options;
  Place place;
};

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plumb::offline::workbench {

/// Where a request goes, decoded: "/fig/order.svg?run=3" is {"fig", "order.svg"} and {run: "3"}.
struct Target {
  std::vector<std::string> path;             // no part is empty, "." or "..", or holds a slash
  std::map<std::string, std::string> query;  // no name occurs twice
};

inline constexpr std::size_t kLongestTarget = 2048;  // [bytes], as sent

/// Nothing if the text is not such a path: too long, not decodable, not UTF-8, with a control
/// character, or with a part that leads to another folder. Cost: its length.
std::optional<Target> parse_target(std::string_view text);

}  // namespace plumb::offline::workbench

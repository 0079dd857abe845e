// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace plumb::offline {

/// [bytes] Longer ones say nothing, and std::regex recurses over each of their letters.
inline constexpr std::size_t kLongestHeading = 1000;

/// A heading as people write it, "alpha [°]", "x(mm)", "Joint 1 / deg": its name, and its unit as
/// plumb writes it, or one that plumb does not convert.
struct WrittenHeading {
  std::string name, unit, foreign;
};

/// The one reader of headings, of measurements and of tables of an arm.
WrittenHeading read_heading(const std::string& text);

/// "X, Y, Z"; of more than four the first two and the last.
std::string in_short(const std::vector<std::string>& names);

}  // namespace plumb::offline

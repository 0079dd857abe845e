// SPDX-License-Identifier: Apache-2.0
#include "show/counted.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace plumb::offline::show {

std::string counted(const std::vector<std::string>& names) {
  std::string out;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto here = names.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::find(names.begin(), here, *here) != here) continue;
    const auto times = std::count(names.begin(), names.end(), *here);
    out += (out.empty() ? "" : ", ") + *here + (times > 1 ? fmt::format(" x{}", times) : "");
  }
  return out;
}

}  // namespace plumb::offline::show

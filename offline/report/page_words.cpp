// SPDX-License-Identifier: Apache-2.0
#include "report/page_words.hpp"

#include <fmt/format.h>

namespace plumb::offline::report {

std::string counted_words(std::size_t n, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

std::string listed_words(const std::vector<std::string>& names) {
  std::string out;
  for (std::size_t i = 0; i < names.size(); ++i)
    out += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return out;
}

std::string percent_words(double share) { return fmt::format("{:.0f} %", 100.0 * share); }

}  // namespace plumb::offline::report

// SPDX-License-Identifier: Apache-2.0
#include "report/page_words.hpp"

#include <fmt/format.h>

namespace plumb::offline::report {

std::string listed_words(const std::vector<std::string>& names) {
  std::string out;
  for (std::size_t i = 0; i < names.size(); ++i)
    out += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return out;
}

const char* verdict_mark(std::string_view verdict_class) {
  return verdict_class == "good"     ? "✓"
         : verdict_class == "partly" ? "◐"
         : verdict_class == "bad"    ? "✗"
                                     : "?";
}

std::string percent_words(double share) { return fmt::format("{:.0f} %", 100.0 * share); }

}  // namespace plumb::offline::report

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace plumb::offline::report {

/// "J2, J3 and J5".
std::string listed_words(const std::vector<std::string>& names);

/// The sign before a verdict of that class, for those who see no colours: "✓", "◐", "✗", "?".
const char* verdict_mark(std::string_view verdict_class);

/// "42 %".
std::string percent_words(double share);

}  // namespace plumb::offline::report

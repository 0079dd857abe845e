// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace plumb::offline::report {

/// "1 pose", "3 poses".
std::string counted_words(std::size_t n, std::string_view one, std::string_view many);

/// "J2, J3 and J5".
std::string listed_words(const std::vector<std::string>& names);

/// "42 %".
std::string percent_words(double share);

}  // namespace plumb::offline::report

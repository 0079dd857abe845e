// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <ostream>
#include <string>

#include "plumb/format/model.hpp"

namespace plumb::format {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInf = std::numeric_limits<double>::infinity();

/// One way to make the six-axis golden model unsound, and what the finding must say about it.
struct Rule {
  std::string name;
  std::string says;
  std::function<void(Model&)> break_it;
};

inline void PrintTo(const Rule& rule, std::ostream* out) { *out << rule.name; }

class SemanticRule : public ::testing::TestWithParam<Rule> {};

inline std::string name_of(const ::testing::TestParamInfo<Rule>& info) { return info.param.name; }

}  // namespace plumb::format

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/blind/hidden_case.hpp"

namespace plumb::tests {

/// Case `number` of the study of narrow measurements with that seed: a six-axis arm whose tool was
/// measured along a line, along half a circle or over a square, in turn, with nothing hidden in one
/// of three cases and one effect of the library, of 5 sigma over all poses of the arm, in two.
HiddenCase draw_narrow_case(std::uint64_t study_seed, int number);

/// "along a line", "along a curve", "over a surface".
const std::vector<std::string>& narrow_kinds();

}  // namespace plumb::tests

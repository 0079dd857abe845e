// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/blind/hidden_case.hpp"

namespace plumb::tests {

/// Case `number` of the study of measured orientations with that seed. In turn one arm is measured
/// with orientations that scatter as stated, that scatter by twenty times as much, that err by
/// place, and without any. A quarter of the arms hides nothing, the others one effect of 2 or 5
/// sigma.
HiddenCase draw_orientation_case(std::uint64_t study_seed, int number);

/// "as stated", "scatter by more", "wrong by place", "points alone".
const std::vector<std::string>& orientation_kinds();

}  // namespace plumb::tests

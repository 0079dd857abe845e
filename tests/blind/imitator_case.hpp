// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/blind/hidden_case.hpp"

namespace plumb::tests {

/// Case `number` of the study of imitators with that seed: a six-axis arm in which one cause is
/// hidden that looks like another, in turn, with 2 or 5 sigma.
HiddenCase draw_imitator_case(std::uint64_t study_seed, int number);

/// "wrong counts at all joints", "axial play of J1" ...
const std::vector<std::string>& imitator_kinds();

}  // namespace plumb::tests

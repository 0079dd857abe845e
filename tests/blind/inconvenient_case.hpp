// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/blind/hidden_case.hpp"

namespace plumb::tests {

/// Case `number` of the study of inconvenient arms with that seed: an arm of one of the kinds
/// below, in turn, with nothing else hidden, with one effect that the library knows, or with one
/// that it does not. 30 to 1,500 poses; every other case visits a tenth of them again.
HiddenCase draw_inconvenient_case(std::uint64_t study_seed, int number);

/// The kinds of arms, set-ups and records: "joint scatter", "rounded encoders" ...
const std::vector<std::string>& inconvenient_kinds();

/// One without any of this, to compare with.
inline constexpr const char* kConvenient = "convenient";

}  // namespace plumb::tests

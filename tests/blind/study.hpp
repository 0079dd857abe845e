// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "tests/blind/score.hpp"

namespace plumb::tests {

/// The first `cases` of a study, in order, on all cores; `draw` gives the case of a number. `done`
/// hears how many are finished, from any thread but never from two at once.
std::vector<Score> run_study(const std::function<HiddenCase(int)>& draw, int cases,
                             const std::function<void(int)>& done);

/// The same for the study with that seed.
std::vector<Score> run_study(std::uint64_t seed, int cases, const std::function<void(int)>& done);

}  // namespace plumb::tests

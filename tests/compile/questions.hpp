// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "plumb/format/model.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::tests {

using Question = std::vector<double>;

/// `count` joint positions of a model: most inside its trained domain, the rest up to four spans
/// outside it, some joints exactly at the border or the last number before or behind it.
std::vector<Question> questions(const format::Model& model, int count, Random& random);

/// One joint after the other at NaN, infinities, the smallest and the largest numbers, and at the
/// last position that is taken and the first that is not.
std::vector<Question> hostile_questions(const format::Model& model);

/// Where a node of an axis-parallel tree goes the other way: at its threshold and next to it.
std::vector<Question> border_questions(const format::Model& model, Random& random);

}  // namespace plumb::tests

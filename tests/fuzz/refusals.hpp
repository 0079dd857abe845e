// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "program/problem.hpp"
#include "tests/fuzz/require.hpp"

namespace plumb::tests {

/// A refusal is of the user's input, and says what and how.
inline void require_helpful(const Failure& failure) {
  require(failure.exit_code() == Exit::kInput || failure.exit_code() == Exit::kUsage,
          "a bad file is exit 3 or 2");
  require(!failure.problems().empty(), "a refusal has a reason");
  for (const auto& problem : failure.problems()) {
    require(!problem.code.empty() && !problem.message.empty(), "a reason has a code and words");
    (void)render(problem);
  }
}

}  // namespace plumb::tests

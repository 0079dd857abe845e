// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "program/problem.hpp"

namespace plumb {

/// What one exit code means; docs/exit-codes.md says the same, which a test holds.
struct ExitRow {
  Exit code;
  std::string means;
  enum class Of { kEveryProgram, kBusPrograms } of = Of::kEveryProgram;
};

const std::vector<ExitRow>& exit_codes();

}  // namespace plumb

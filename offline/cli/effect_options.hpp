// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "cell/cell.hpp"

namespace plumb::offline::cli {

/// An effect on the command line: NAME [--joints J2,J3] [--set KEY=VALUE ...].
struct EffectOptions {
  std::string name;
  std::vector<std::string> joints;
  std::vector<std::string> set;

  void add_to(CLI::App& verb);

  /// As it would stand in the cell file. Throws Failure (kUsage) with "did you mean".
  EffectEntry entry(const Cell& cell) const;
};

}  // namespace plumb::offline::cli

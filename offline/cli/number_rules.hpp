// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

/// What the numbers of the command line may be, in words short enough to be read.
namespace plumb::offline::cli {

/// Finite and greater than 0: a gate or a duration.
CLI::Validator greater_than_zero();

/// A whole number from 0 to 2^53, as [measurement] seed in cell.toml.
CLI::Validator seed_number();

}  // namespace plumb::offline::cli

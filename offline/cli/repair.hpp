// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "check/check.hpp"
#include "program/output_files.hpp"

namespace plumb::offline::cli {

/// Writes what the check found of the conventions: cell.toml is edited in place, measurement files
/// are written anew beside the old ones (NAME_fixed.csv), which stay. Adds `files` and `dry_run` to
/// the result. Returns what was done, for people.
std::string repair(const Cell& cell, const MeasurementFiles& measured, const Check& check,
                   const WriteOptions& options, Outcome& outcome);

}  // namespace plumb::offline::cli

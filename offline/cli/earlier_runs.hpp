// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "fit/run_store.hpp"

namespace plumb::offline::cli {

/// Runs before this one that are of the same data and can be read, oldest first: the steps by which
/// a model may have grown.
std::vector<Run> earlier_runs(const Run& last, const Cell& cell, const MeasurementFiles& measured);

}  // namespace plumb::offline::cli

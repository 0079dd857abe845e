// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "bench/benchmark.hpp"

/// How long the cycle takes and what costs the time, on the machine that timed it. Each returns one
/// SVG file, `width` px wide (320 to 4000).
namespace plumb::offline::figures {

/// Histogram of the whole step, in the caches and out of them, each worst call marked, beside the
/// cycle time. Both axes are logarithmic: one late call in a million is seen as well as the
/// million.
std::string latency_figure(const bench::Benchmark& found, double width);

/// What the kinematics, each effect and the trees add to a prediction, and what the inverse and the
/// guard take, dearest effects first.
std::string cost_figure(const bench::Benchmark& found, double width);

}  // namespace plumb::offline::figures

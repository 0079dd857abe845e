// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "bench/benchmark.hpp"
#include "show/json.hpp"

namespace plumb::offline::show {

/// result of `bench`: the whole cycle, every kernel each way, and the conditions.
Json bench_json(const bench::Benchmark& found);

/// Verdict first: median, its share of the cycle, and whether this machine may judge; then a table.
std::string bench_text(const bench::Benchmark& found);

}  // namespace plumb::offline::show

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace plumb::offline::bench {

/// How often this thread has allocated memory from the C library's heap, which operator new and
/// Eigen use as well. It never decreases. In a program that uses this function, malloc and its
/// relatives are counted from the start, at the cost of one addition per call.
std::uint64_t allocations() noexcept;

}  // namespace plumb::offline::bench

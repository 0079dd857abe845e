// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace plumb::offline::bench {

/// How often this thread has taken memory from the C library's heap, on which operator new and
/// Eigen stand too. Monotone. A program that calls this has its malloc family counted from its
/// start on: one addition a call.
std::uint64_t allocations() noexcept;

}  // namespace plumb::offline::bench

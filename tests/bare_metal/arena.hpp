// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

/// Memory of the load phase: operator new takes it from one fixed piece, and nothing is given back.
/// The board has no other heap. Once sealed, who asks for memory ends the program with kAllocated.
namespace plumb::bare_metal {

inline constexpr std::size_t kArenaBytes = std::size_t{256} << 10;

/// The load phase is over.
void seal_arena() noexcept;

std::size_t arena_bytes_used() noexcept;

}  // namespace plumb::bare_metal

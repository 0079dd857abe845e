// SPDX-License-Identifier: Apache-2.0
#include "tests/bare_metal/arena.hpp"

#include <new>

#include "tests/bare_metal/machine.hpp"

namespace plumb::bare_metal {
namespace {

alignas(std::max_align_t) std::byte arena[kArenaBytes];
std::size_t used = 0;
bool sealed = false;

[[noreturn]] void refuse(const char* why) noexcept {
  write(why);
  leave(kAllocated);
}

void* take(std::size_t bytes) noexcept {
  if (sealed) refuse("allocation in the cycle\n");
  constexpr std::size_t kAlign = alignof(std::max_align_t);
  const std::size_t whole = (bytes + kAlign - 1) / kAlign * kAlign;
  if (whole < bytes || whole > kArenaBytes - used) refuse("the arena is full\n");
  void* const out = arena + used;
  used += whole;
  return out;
}

}  // namespace

void seal_arena() noexcept { sealed = true; }
std::size_t arena_bytes_used() noexcept { return used; }

}  // namespace plumb::bare_metal

void* operator new(std::size_t bytes) { return plumb::bare_metal::take(bytes); }
void* operator new[](std::size_t bytes) { return plumb::bare_metal::take(bytes); }
void operator delete(void*) noexcept {}
void operator delete(void*, std::size_t) noexcept {}
void operator delete[](void*) noexcept {}
void operator delete[](void*, std::size_t) noexcept {}

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cerrno>
#include <cstddef>

#include "tests/drivers/watched_calls.hpp"

/// The heap of a program in which a thread is watched, operator new included, which stands on it.
/// In one source file a program only.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* p, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* p);

void* malloc(std::size_t size) noexcept {
  plumb::tests::note_heap();
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) noexcept {
  plumb::tests::note_heap();
  return __libc_calloc(count, size);
}
void* realloc(void* p, std::size_t size) noexcept {
  plumb::tests::note_heap();
  return __libc_realloc(p, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  plumb::tests::note_heap();
  return __libc_memalign(alignment, size);
}
void* memalign(std::size_t alignment, std::size_t size) noexcept {
  plumb::tests::note_heap();
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** p, std::size_t alignment, std::size_t size) noexcept {
  plumb::tests::note_heap();
  *p = __libc_memalign(alignment, size);
  return *p == nullptr ? ENOMEM : 0;
}
void free(void* p) noexcept {
  plumb::tests::note_heap();
  __libc_free(p);
}
}

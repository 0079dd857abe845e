// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cerrno>
#include <cstdlib>
#if __has_include(<mm_malloc.h>)
#include <mm_malloc.h>  // of clang: it declares posix_memalign, and must come before ours
#endif

/// Counts every call of the C library's heap functions, by any thread of the program; operator new
/// uses them. To be included by only one source file of a program, and not with a sanitizer that
/// has a heap of its own.
namespace plumb::tests {

inline std::atomic<long> heap_calls{0};
inline std::atomic<long> heap_bytes{0};  // asked for, whether or not given back
/// A counter for the calls of this thread alone, if one is set.
inline thread_local std::atomic<long>* heap_calls_here = nullptr;

inline void note_heap_call(std::size_t bytes = 0) noexcept {
  ++heap_calls;
  heap_bytes += static_cast<long>(bytes);
  if (heap_calls_here != nullptr) ++*heap_calls_here;
}

template <class F>
long heap_calls_of(F work) {
  const long before = heap_calls;
  work();
  return heap_calls - before;
}

template <class F>
long heap_bytes_of(F work) {
  const long before = heap_bytes;
  work();
  return heap_bytes - before;
}

}  // namespace plumb::tests

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* p, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* p);

void* malloc(std::size_t size) noexcept {
  plumb::tests::note_heap_call(size);
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) noexcept {
  plumb::tests::note_heap_call(count * size);
  return __libc_calloc(count, size);
}
void* realloc(void* p, std::size_t size) noexcept {
  plumb::tests::note_heap_call(size);
  return __libc_realloc(p, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  plumb::tests::note_heap_call(size);
  return __libc_memalign(alignment, size);
}
void* memalign(std::size_t alignment, std::size_t size) noexcept {
  plumb::tests::note_heap_call(size);
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** p, std::size_t alignment, std::size_t size) noexcept {
  plumb::tests::note_heap_call(size);
  *p = __libc_memalign(alignment, size);
  return *p == nullptr ? ENOMEM : 0;
}
void free(void* p) noexcept {
  plumb::tests::note_heap_call();
  __libc_free(p);
}
}

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdlib>

/// Every malloc of the program is counted, operator new included. In one source file a program
/// only.
namespace plumb::tests {

inline std::atomic<long> allocations{0};

template <class F>
long allocations_of(F work) {
  const long before = allocations;
  work();
  return allocations - before;
}

}  // namespace plumb::tests

extern "C" {
void* __libc_malloc(std::size_t size);
void* malloc(std::size_t size) {
  ++plumb::tests::allocations;
  return __libc_malloc(size);
}
}

// SPDX-License-Identifier: Apache-2.0
// A violation that the gate on the image's symbols must catch.
#include <cstddef>
#include <cstdlib>

#include "tests/bare_metal/machine.hpp"

int plumb::bare_metal::run_program() {
  void* const volatile planted = std::malloc(8);
  return planted == nullptr ? 1 : 0;
}

extern "C" void* _sbrk(std::ptrdiff_t) { return nullptr; }

// SPDX-License-Identifier: Apache-2.0
// A violation that the sealed arena must catch.
#include "tests/bare_metal/arena.hpp"
#include "tests/bare_metal/machine.hpp"

int plumb::bare_metal::run_program() {
  seal_arena();
  const int* const volatile planted = new int(1);
  return *planted - 1;
}

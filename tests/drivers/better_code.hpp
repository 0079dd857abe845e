// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "program/machine_code.hpp"

namespace plumb::tests {

/// Whether this processor could run the program that is compiled for better ones than this program.
inline bool could_run_better_code() {
#if defined(__x86_64__) && !defined(__clang__)
  __builtin_cpu_init();
  return std::string(machine_code()) == "x86-64" && __builtin_cpu_supports("x86-64-v3") != 0;
#else
  return false;
#endif
}

}  // namespace plumb::tests

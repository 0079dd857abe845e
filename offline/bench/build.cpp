// SPDX-License-Identifier: Apache-2.0
#include "bench/build.hpp"

#include "program/machine_code.hpp"

namespace plumb::offline::bench {
namespace {

constexpr bool optimised() {
#if defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  return true;
#else
  return false;
#endif
}

std::string compiler() {
#if defined(__clang__)
  return "clang++ " __clang_version__;
#else
  return "g++ " __VERSION__;
#endif
}

}  // namespace

Build this_build() {
  return {.instructions = machine_code(), .compiler = compiler(), .optimised = optimised()};
}

}  // namespace plumb::offline::bench

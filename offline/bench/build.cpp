// SPDX-License-Identifier: Apache-2.0
#include "bench/build.hpp"

namespace plumb::offline::bench {
namespace {

const char* instructions() {
#if defined(__AVX2__) && defined(__FMA__) && defined(__BMI2__)
  return "x86-64-v3";
#elif defined(__x86_64__)
  return "x86-64";
#elif defined(__aarch64__)
  return "aarch64";
#elif defined(__arm__)
  return "arm";
#else
  return "unknown";
#endif
}

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
  return {.instructions = instructions(), .compiler = compiler(), .optimised = optimised()};
}

}  // namespace plumb::offline::bench

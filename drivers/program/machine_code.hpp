// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace plumb {

/// The instructions for which the calling file is compiled: "x86-64" (runs everywhere), "x86-64-v3"
/// (needs AVX2, FMA and BMI2), or the architecture.
constexpr const char* machine_code() {
#if defined(__AVX2__) && defined(__FMA__) && defined(__BMI2__)
  return "x86-64-v3";
#elif defined(__x86_64__)
  return "x86-64";
#elif defined(__aarch64__)
  return "aarch64";
#elif defined(__arm__)
  return "arm";
#else
  return "other";
#endif
}

}  // namespace plumb

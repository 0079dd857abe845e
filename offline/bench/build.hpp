// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace plumb::offline::bench {

/// How this program, and the runtime with it, was compiled.
struct Build {
  std::string instructions;  // "x86-64", "x86-64-v3", "aarch64"
  std::string compiler;      // "g++ 12.2.0"
  bool optimised = false;    // and no sanitizer
};
Build this_build();

}  // namespace plumb::offline::bench

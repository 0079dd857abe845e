// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>

#include "plumb/runtime/transform.hpp"

namespace plumb::tests {

/// FNV-1a over the bits of doubles: one number that says whether two machines agree.
class BitHash {
 public:
  void add(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    for (int shift = 0; shift < 64; shift += 8) {
      value_ ^= (bits >> shift) & 0xFF;
      value_ *= 0x100000001b3U;
    }
  }
  void add(const Transformd& X) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) add(X.R(i, j));
      add(X.p(i));
    }
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

}  // namespace plumb::tests

// SPDX-License-Identifier: Apache-2.0
#include "numbers/product_tiles.hpp"

namespace plumb::offline {
namespace {

/// Adds two numbers at once, as every processor of 64 bits can.
struct AnyMachine {
  static constexpr int kTileOfA = 2, kTileOfB = 2;
  using Two = double __attribute__((vector_size(16)));
  struct Four {
    Two low, high;
  };
  static Two two_of(const double* at) {
    Two out;
    __builtin_memcpy(&out, at, sizeof out);  // one unaligned load
    return out;
  }
  static Four four_of(const double* at) { return {two_of(at), two_of(at + 2)}; }
  static void add_product(Four& sum, const Four& a, const Four& b) {
    sum.low += a.low * b.low;
    sum.high += a.high * b.high;
  }
  static void put(const Four& sum, double* out) {
    __builtin_memcpy(out, &sum.low, sizeof sum.low);
    __builtin_memcpy(out + 2, &sum.high, sizeof sum.high);
  }
};

}  // namespace

const ProductKernels kProductsOfAnyMachine{ProductTiles<AnyMachine, false>::add,
                                           ProductTiles<AnyMachine, true>::add};

}  // namespace plumb::offline

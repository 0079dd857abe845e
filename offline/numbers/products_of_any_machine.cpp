// SPDX-License-Identifier: Apache-2.0
#include "numbers/product_tiles.hpp"

namespace plumb::offline {
namespace {

/// Adds two numbers at once, as every processor of 64 bits can.
struct AnyMachine {
  static constexpr int kTileOfA = 2, kTileOfB = 2;
  using Two = double __attribute__((vector_size(16)));
  using TwoAnywhere = double __attribute__((vector_size(16), aligned(8), may_alias));
  struct Four {
    Two low, high;
  };
  static Four four_of(const double* at) {
    return {*reinterpret_cast<const TwoAnywhere*>(at),
            *reinterpret_cast<const TwoAnywhere*>(at + 2)};
  }
  static void add_product(Four& sum, const Four& a, const Four& b) {
    sum.low += a.low * b.low;
    sum.high += a.high * b.high;
  }
  static void put(const Four& sum, double* out) {
    *reinterpret_cast<TwoAnywhere*>(out) = sum.low;
    *reinterpret_cast<TwoAnywhere*>(out + 2) = sum.high;
  }
};

}  // namespace

const ProductKernels kProductsOfAnyMachine{ProductTiles<AnyMachine, false>::add,
                                           ProductTiles<AnyMachine, true>::add};

}  // namespace plumb::offline

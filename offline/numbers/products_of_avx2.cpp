// SPDX-License-Identifier: Apache-2.0
// Compiled for AVX2. It includes nothing that other files compile too, because the linker keeps one
// copy only of such a function, and might keep that which other processors cannot run.
#include "numbers/product_tiles.hpp"

namespace plumb::offline {
namespace {

/// Adds four numbers at once. Products are not fused with sums: every machine gives the same bits.
struct Avx2 {
  static constexpr int kTileOfA = 3, kTileOfB = 3;
  using Four = double __attribute__((vector_size(32)));
  /// One unaligned load. (A pointer to a vector type of lower alignment is no substitute: clang
  /// takes it for an aligned one.)
  static Four four_of(const double* at) {
    Four out;
    __builtin_memcpy(&out, at, sizeof out);
    return out;
  }
  static void add_product(Four& sum, const Four& a, const Four& b) { sum += a * b; }
  static void put(const Four& sum, double* out) { __builtin_memcpy(out, &sum, sizeof sum); }
};

}  // namespace

const ProductKernels kProductsOfAvx2{ProductTiles<Avx2, false>::add, ProductTiles<Avx2, true>::add};

}  // namespace plumb::offline

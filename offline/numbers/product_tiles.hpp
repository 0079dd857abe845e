// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace plumb::offline {

/// A matrix stored column by column, `stride` numbers from one column to the next.
struct ColumnsView {
  const double* data;
  std::ptrdiff_t stride, columns;
};

constexpr std::ptrdiff_t kRowsAtOnce = 256;  // of both matrices; the processor's cache holds them

/// Adds A^T B to `sums`, shape (A.columns, B.columns), stored column by column, tile by tile. If
/// kLowerHalf, only what is on the diagonal and below it is computed, and a few numbers beside it.
///
/// Four sums are kept of each number, of every fourth row each, up to the end of a block of rows;
/// then they are added. So the order of the additions, and every bit of the result, depends on the
/// rows alone: neither on the size of the tiles nor on how many numbers the machine adds at once.
///
/// Machine: has a type Four of four numbers and its operations. It is a type of the source file's
/// own: each such file is compiled for another machine, and the linker must not take the code of
/// one for that of another.
template <class Machine, bool kLowerHalf>
class ProductTiles {
 public:
  static void add(const ColumnsView& A, const ColumnsView& B, std::ptrdiff_t rows, double* sums) {
    for (std::ptrdiff_t first = 0; first < rows; first += kRowsAtOnce) {
      const Block block{A, B, first, rows - first < kRowsAtOnce ? rows - first : kRowsAtOnce, sums};
      std::ptrdiff_t k = 0;
      for (; k + kB <= B.columns; k += kB) add_strip<kB>(block, k);
      for (; k < B.columns; ++k) add_strip<1>(block, k);
    }
  }

 private:
  using Four = typename Machine::Four;
  static constexpr int kA = Machine::kTileOfA, kB = Machine::kTileOfB;

  struct Block {
    const ColumnsView &A, &B;
    std::ptrdiff_t first, rows;
    double* sums;
  };

  static const double* column(const ColumnsView& of, std::ptrdiff_t c) {
    return of.data + c * of.stride;
  }

  /// All tiles of columns k to k + width - 1 of B.
  template <int width>
  static void add_strip(const Block& block, std::ptrdiff_t k) {
    std::ptrdiff_t i = kLowerHalf ? k : 0;
    for (; i + kA <= block.A.columns; i += kA) add_tile<kA, width>(block, i, k);
    for (; i < block.A.columns; ++i) add_tile<1, width>(block, i, k);
  }

  template <int height, int width>
  static void add_tile(const Block& block, std::ptrdiff_t i, std::ptrdiff_t k) {
    const double *a[height], *b[width];
    for (int r = 0; r < height; ++r) a[r] = column(block.A, i + r) + block.first;
    for (int c = 0; c < width; ++c) b[c] = column(block.B, k + c) + block.first;
    Four sum[height][width];
    for (int r = 0; r < height; ++r)
      for (int c = 0; c < width; ++c) sum[r][c] = Four{};
    std::ptrdiff_t row = 0;
    for (; row + 4 <= block.rows; row += 4) {
      Four left[height];
      for (int r = 0; r < height; ++r) left[r] = Machine::four_of(a[r] + row);
      for (int c = 0; c < width; ++c) {
        const Four right = Machine::four_of(b[c] + row);
        for (int r = 0; r < height; ++r) Machine::add_product(sum[r][c], left[r], right);
      }
    }
    for (int c = 0; c < width; ++c)
      for (int r = 0; r < height; ++r) {
        double four[4];
        Machine::put(sum[r][c], four);
        for (std::ptrdiff_t last = row; last < block.rows; ++last)
          four[last - row] += a[r][last] * b[c][last];
        block.sums[(k + c) * block.A.columns + i + r] += (four[0] + four[2]) + (four[1] + four[3]);
      }
  }
};

/// The products of one machine. Those of AVX2 may be called only where the processor has it.
using AddProduct = void (*)(const ColumnsView& A, const ColumnsView& B, std::ptrdiff_t rows,
                            double* sums);
struct ProductKernels {
  AddProduct whole, lower_half;
};
extern const ProductKernels kProductsOfAnyMachine;
extern const ProductKernels kProductsOfAvx2;

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#include "numbers/products.hpp"

#include "numbers/product_tiles.hpp"

namespace plumb::offline {
namespace {

using Lines = Eigen::Ref<const Eigen::MatrixXd>;

const ProductKernels& kernels() {
#ifdef __x86_64__
  static const bool has_avx2 = __builtin_cpu_supports("avx2") != 0;
  if (has_avx2) return kProductsOfAvx2;
#endif
  return kProductsOfAnyMachine;
}

Eigen::MatrixXd product_by(AddProduct add, const Lines& A, const Lines& B) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(A.cols(), B.cols());
  add({A.data(), A.outerStride(), A.cols()}, {B.data(), B.outerStride(), B.cols()}, A.rows(),
      out.data());
  return out;
}

}  // namespace

Eigen::MatrixXd transposed_product(const Lines& A, const Lines& B) {
  return product_by(kernels().whole, A, B);
}

Eigen::MatrixXd symmetric_product(const Lines& A, const Lines& B) {
  const Eigen::MatrixXd lower = product_by(kernels().lower_half, A, B);
  return lower.selfadjointView<Eigen::Lower>();
}

}  // namespace plumb::offline

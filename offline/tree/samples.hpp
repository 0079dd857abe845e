// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>

#include "plumb/format/limits.hpp"

namespace plumb::offline {

/// Rows are samples. Inputs u in [-1, 1], shape (n, p); outputs y, shape (n, 1 .. 3) [m].
using Samples = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic>;

/// One sample as a contiguous row, as the runtime needs it.
class SampleRow {
 public:
  SampleRow(const Samples& u, Eigen::Index row) : size_(static_cast<std::size_t>(u.cols())) {
    for (Eigen::Index k = 0; k < u.cols(); ++k) values_[k] = u(row, k);
  }
  std::span<const double> span() const { return {values_.data(), size_}; }

 private:
  std::array<double, format::kMaxJoints> values_;
  std::size_t size_;
};

}  // namespace plumb::offline

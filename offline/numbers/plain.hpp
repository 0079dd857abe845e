// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <type_traits>

namespace plumb::offline {

/// What an expression is evaluated to before a function of this room works on it: a column stays a
/// column, everything else is a matrix. So each function is compiled for those two alone.
template <class B>
using Plain = std::conditional_t<B::ColsAtCompileTime == 1, Eigen::VectorXd, Eigen::MatrixXd>;

}  // namespace plumb::offline

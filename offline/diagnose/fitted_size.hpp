// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "diagnose/regressor_score.hpp"
#include "effects/descriptor.hpp"

namespace plumb::offline {

/// Sizes of the columns of a regressor, 1 = typical, as a refit with it would find them. The sizes
/// behind a Bayes factor are drawn towards 0 by the prior that the evidence chose, which shrinks
/// what geometry nearly imitates many times; a refit has only the wide prior of the fit.
struct FittedSize {
  Eigen::VectorXd theta;  // 0 where the sign of a column holds it
  Eigen::VectorXd std;
};

/// @param prior  1 sigma of the fit's prior of each column, 1 = typical; 0: none.
FittedSize fitted_size(const RegressorScore& scored, const Eigen::VectorXd& prior,
                       PriorTail tail = PriorTail::kHeavy);

}  // namespace plumb::offline

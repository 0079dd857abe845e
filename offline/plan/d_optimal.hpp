// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "plan/information.hpp"

namespace plumb::offline {

/// A weighted sum of ln det M over some groups of parameters. All parameters with weight 1 is
/// D-optimality. With weight 1 on all and -1 on the rest it is what one effect tells beyond the
/// rest: D_s-optimality, the part of its motion that the rest cannot reproduce.
struct DesignCriterion {
  struct Term {
    std::vector<Eigen::Index> columns;  // parameters
    double weight = 1.0;
  };
  std::vector<Term> terms;

  static DesignCriterion all(Eigen::Index parameters);
};

/// Which candidates to measure.
struct Design {
  std::vector<int> chosen;  // of the candidates, ascending
  double value = 0.0;       // of the criterion, over what was known before
  int exchanges = 0;        // that improved the greedy choice
};

/// Greedy, then one candidate at a time exchanged for the best other one until nothing improves
/// (at most 20 rounds) [Fedorov 1972]. candidates: whitened derivatives of each, shape (rows,
/// parameters); known: rows measured already; prior: information of each parameter, > 0. No
/// candidate is taken twice. Cost: n * candidates * parameters^2 a round.
Design d_optimal(const std::vector<Eigen::MatrixXd>& candidates, const Eigen::MatrixXd& known,
                 const Eigen::VectorXd& prior, int n, const DesignCriterion& criterion);

}  // namespace plumb::offline

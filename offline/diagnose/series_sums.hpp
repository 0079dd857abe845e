// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "diagnose/regressor_score.hpp"

namespace plumb::offline {

/// Series of some joints at a whitened fit, fold by fold: their products with the model, with the
/// residual and with each other. Columns per radian, all waves of a joint together.
struct SeriesProducts {
  std::vector<int> joints;
  int waves = 0;
  std::vector<Products> folds;
  Products all;  // over the folds

  Eigen::Index columns() const { return all.Xy.size(); }
  /// Of some of the joints alone.
  SeriesProducts of(const std::vector<int>& some) const;
};

/// Makes these products. What was summed for a joint, or for two of them, is kept and serves again.
/// Cost of a pair of joints: poses * (2 waves)^2.
class SeriesSums {
 public:
  /// Keeps a reference to `whitened`.
  SeriesSums(const WhitenedFit& whitened, int waves) : whitened_(whitened), waves_(waves) {}

  SeriesProducts of(const std::vector<int>& joints);

 private:
  struct OfJoint {
    Eigen::MatrixXd waves;            // (poses, 2 waves)
    std::vector<Eigen::MatrixXd> UX;  // of each fold
    std::vector<Eigen::VectorXd> Xy;
  };
  const OfJoint& of_joint(int joint);
  const std::vector<Eigen::MatrixXd>& of_pair(int a, int b);

  const WhitenedFit& whitened_;
  int waves_;
  std::map<int, OfJoint> joints_;
  std::map<std::pair<int, int>, std::vector<Eigen::MatrixXd>> pairs_;  // of each fold
};

/// Waves of one joint at all poses, shape (poses, count).
Eigen::MatrixXd waves_of_joint(const WhitenedFit& whitened, int joint, int count);

}  // namespace plumb::offline

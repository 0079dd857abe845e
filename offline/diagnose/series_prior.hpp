// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnose/evidence_scale.hpp"
#include "diagnose/series_sums.hpp"

namespace plumb::offline {

/// The prior of a series: wave k has a standard deviation of ratio k^-slope times the scatter of a
/// whitened coordinate [rad].
struct SeriesPrior {
  double ratio = 1.0, slope = 1.0;
};

/// What a series with such a prior explains.
struct SeriesEvidence {
  SeriesPrior prior;
  double ln_bayes = kImpossible;
  double scatter = 0.0;  // of what is left, whitened
};

/// Chooses the prior of a series of some joints.
class SeriesPriorSearch {
 public:
  /// Keeps a reference to `scorer`.
  SeriesPriorSearch(const Scorer& scorer, SeriesProducts products);

  SeriesPriorSearch of(const std::vector<int>& some) const;
  const std::vector<int>& joints() const { return products_.joints; }
  const SeriesProducts& products() const { return products_; }

  SeriesEvidence evidence_with(const SeriesPrior& prior) const;

  /// The prior of the largest evidence, uphill on a grid of sizes and slopes. What choosing it
  /// costs is paid: ln of the number of priors on the grid. Cost: columns^3 / 3 for each tried.
  SeriesEvidence best_prior() const;

  /// Of priors no wider than `most`: the one with the smallest waves that predicts the folds, each
  /// from the others, as well as the best within one standard error. [Hastie et al. 2009, 7.10]
  ///
  /// Where poses leave a range of a joint out nothing but the prior holds a series, and evidence
  /// does not see it: it asks how large waves are where the poses are.
  SeriesEvidence narrowest_prior(const SeriesEvidence& most) const;

 private:
  struct HeldOut {
    SeriesPrior prior;
    double error = 0.0, standard_error = 0.0;  // mean square of a line over the folds
  };
  HeldOut held_out(const SeriesPrior& prior) const;
  Eigen::VectorXd ratios(const SeriesPrior& prior) const;

  const Scorer* scorer_;
  SeriesProducts products_;
  Eigen::MatrixXd gram_;  // cleared of the model
  double unit_ = 1.0;     // ratio that counts as size 1
};

}  // namespace plumb::offline

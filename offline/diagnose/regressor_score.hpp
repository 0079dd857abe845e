// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnose/evidence.hpp"
#include "diagnose/regressor.hpp"

namespace plumb::offline {

/// Products of a regressor with itself, the model and the residual over one segment of poses.
struct Products {
  Eigen::MatrixXd XX;  // (b, b)
  Eigen::MatrixXd UX;  // (rank, b)
  Eigen::VectorXd Xy;  // (b,)
};

/// Over all of these segments; there is one at least.
Products sum_of(const std::vector<Products>& segments);

/// How far a held-out error falls, fold by fold inside the fit poses: in whitened lines where
/// effects are chosen, in lengths where it is reported.
struct Gain {
  double share = 0.0;     // of the RMS
  double share_se = 0.0;  // standard error of that, as a prediction of the fall on other poses
  double standard_errors = 0.0;  // of the folds, by which their sum of squares falls
  bool clear = false;            // more than 1 %, and more than one standard error of the folds
};

/// Of sums of squares of the held-out error of each fold, without and with an effect.
Gain gain_of(const std::vector<double>& before, const std::vector<double>& after);

/// A regressor scored at a whitened fit.
struct RegressorScore {
  std::vector<Products> folds;
  Evidence evidence;
  double variance = 1.0;             // of a line, with the regressor in the model
  double explained = 0.0;            // share of the residual's sum of squares
  double absorbed = 0.0;             // share of the motion that the model can imitate
  Eigen::VectorXd theta;             // fitted size of each column, 1 = typical
  std::vector<Eigen::Index> active;  // columns that are not held at 0 by their sign
};

/// Mean square of the residuals over that of the noise; 1 if the noise is unknown.
double times_noise(const WhitenedFit& whitened);

/// The value of times_noise up to which only noise is left, given how well the repeats tell the
/// noise.
double at_noise(const WhitenedFit& whitened);

/// Whether a regressor reduces residuals that are clearly above the noise to the noise. Then it is
/// an effect, however small it is beside others.
bool reaches_noise(const WhitenedFit& whitened, const RegressorScore& scored);

/// Scores regressors at one whitened fit. Cost of a regressor: its columns times (rank + columns) a
/// pose; a held-out gain costs no pass over the poses.
class Scorer {
 public:
  explicit Scorer(const WhitenedFit& whitened);

  RegressorScore score(const Regressor& regressor) const;

  /// Over all fit poses.
  Products products(const Regressor& regressor) const;

  /// The same over each fold.
  std::vector<Products> products_by_fold(const Regressor& regressor) const;

  /// Products over all folds but one, cleared of the model as these folds fit it; the residual's
  /// sum of squares, and the scale of evidence there.
  struct Cleared {
    Eigen::MatrixXd XX;
    Eigen::VectorXd Xy;
    double Q = 0.0;
    EvidenceScale scale;
  };
  Cleared cleared_without(std::size_t fold, const std::vector<Products>& by_fold) const;

  /// K-fold gain: model and regressor refitted without each fold, all from products.
  Gain gain(const RegressorScore& scored) const;
  /// The same of a regressor that each fold has chosen for itself; one without columns adds
  /// nothing.
  Gain gain(const std::vector<RegressorScore>& by_fold) const;

  /// Sizes fitted without one fold: of the model's columns U, and of the regressor's.
  struct Without {
    Eigen::VectorXd model, regressor;
  };
  Without without(std::size_t fold) const;
  Without without(std::size_t fold, const RegressorScore& scored) const;

  const WhitenedFit& whitened() const { return whitened_; }
  EvidenceScale scale() const { return scale_; }

 private:
  struct Fold {
    Eigen::MatrixXd UU;  // (rank, rank) of the fold
    Eigen::VectorXd Uy;  // (rank,)
    double yy = 0.0;
    Eigen::MatrixXd without;  // (U^T U of the others)^-1
    double error = 0.0;       // held-out sum of squares of the model alone
  };
  double held_out_with(std::size_t fold, const RegressorScore& scored) const;
  double variance_with(const Eigen::MatrixXd& gram, const Eigen::VectorXd& v, double width) const;

  const WhitenedFit& whitened_;
  EvidenceScale scale_;
  std::vector<Fold> folds_;
};

}  // namespace plumb::offline

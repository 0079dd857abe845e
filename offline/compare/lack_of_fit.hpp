// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cell/measurements.hpp"
#include "fit/fit.hpp"

namespace plumb::offline::compare {

/// Whether the residuals of the fitted poses exceed the noise.
struct LackOfFit {
  enum class Basis { kNone, kRepeats, kSigma } basis = Basis::kNone;
  double ratio = 0.0;       // F: mean square of the means of the poses over that of the repeats; or
                            // mean square of all residuals over sigma^2
  int dof_model = 0;        // coordinates of distinct poses minus parameters
  int dof_noise = 0;        // degrees of freedom of the repeats; 0: sigma is stated
  double ln_p = 0.0;        // ln of the probability of such a ratio if the model were complete
  double systematic = 0.0;  // share of the mean square of a single reading that is not noise
  /// Whether chance makes it less than once in a thousand.
  bool significant() const;
};

/// F test of lack of fit against pure error [Draper & Smith 1998, 2.1]: with e_gi the residuals of
/// pose g and E_g their mean, compares sum n_g |E_g|^2 with sum |e_gi - E_g|^2. With fewer than
/// five repeats, compares the residuals with the stated sigma. fit_error_M: in-sample errors, shape
/// (all rows, 3); rows: the fitted rows; parameters: how many numbers were fitted.
LackOfFit lack_of_fit(const Measurements& measured, const Rows3& fit_error_M,
                      const std::vector<int>& rows, int parameters, const NoiseFloor& floor);

}  // namespace plumb::offline::compare

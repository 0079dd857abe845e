// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cell/measurements.hpp"
#include "fit/fit.hpp"

namespace plumb::offline::compare {

/// Whether what the model leaves is more than noise, judged where it was fitted.
struct LackOfFit {
  enum class Basis { kNone, kRepeats, kSigma } basis = Basis::kNone;
  double ratio = 0.0;       // mean square of the poses' means over that of repeats (F); or of all
                            // residuals over sigma^2
  int dof_model = 0;        // coordinates of distinct poses less parameters
  int dof_noise = 0;        // of the repeats; 0: sigma is stated, not estimated
  double ln_p = 0.0;        // ln of the probability of such a ratio if the model were complete
  double systematic = 0.0;  // share of the mean square of a single reading that is not noise
  bool significant() const { return basis != Basis::kNone && ln_p < -6.9; }  // 1 in 1000
};

/// F test of lack of fit against pure error [Draper & Smith 1998, 2.1]: with e_gi the residuals of
/// pose g and E_g their mean, sum n_g |E_g|^2 against sum |e_gi - E_g|^2. Without five repeats, the
/// residuals against the stated sigma. fit_error_M: in-sample, shape (all rows, 3); rows: those
/// that were fitted; parameters: fitted numbers.
LackOfFit lack_of_fit(const Measurements& measured, const Rows3& fit_error_M,
                      const std::vector<int>& rows, int parameters, const NoiseFloor& floor);

}  // namespace plumb::offline::compare

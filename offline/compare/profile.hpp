// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace plumb::offline::compare {

/// Errors of the poses at which a quantity lies between `from` and `to`. Fitted poses are counted
/// separately, because their error is in-sample. Errors are in [m], those of orientations in [rad].
struct ErrorBin {
  double from = 0.0, to = 0.0;  // SI, [degC], or rows of the file
  int n = 0;                    // poses of the judged set
  double mean = 0.0;            // their mean error; 0 if n == 0
  int fit_n = 0;                // fitted poses
  double fit_mean = 0.0;
};

/// How the error depends on one quantity.
struct ErrorProfile {
  enum class Kind { kJoint, kRegion, kLoad, kContext, kOrder, kSetup } kind = Kind::kJoint;
  std::string name;  // "J2", "reach", "payload", "J2 torque", "J2 direction", "temp", "order"
  enum class Unit {
    kLength,
    kAngle,
    kMass,
    kTorque,
    kTemperature,
    kTime,
    kSign,
    kRow,
    kName
  } unit = Unit::kAngle;
  std::vector<ErrorBin> bins;
  std::vector<std::string> names = {};  // kName: of the values 0, 1, 2 ...
  double explained = 0.0;  // share of the variance of the error size that the bins explain
  double ln_p = 0.0;       // ln of its probability if the error did not depend on the quantity
  bool matters = false;    // beyond chance, corrected for the number of profiles

  /// Highest bin mean over the lowest; 1 if fewer than two bins are filled.
  double contrast() const;
};

/// A pose and the size of its error.
struct Sample {
  double value = 0.0;  // of the quantity
  double error = 0.0;
  enum class Set { kJudged, kFitted, kBoth } set = Set::kJudged;
  double fit_error = 0.0;  // of kFitted and kBoth: in-sample
  bool repeat = false;     // another sample is of the same pose, so this one is no evidence
};

/// Fills bins of equal width between the extremes of the quantity: at most 6, with at least 8 poses
/// each on average. With `labels`, one bin for each of these values instead. Samples without a
/// value (NaN) are left out. `explained` and `ln_p` come from a one-way analysis of variance of
/// error over all samples except repeats.
ErrorProfile profile(ErrorProfile empty, const std::vector<Sample>& samples,
                     const std::vector<double>& labels = {});

/// Sets `matters` of profiles whose probability by chance is below 1 % over the number of profiles
/// [Bonferroni].
void set_matters(std::vector<ErrorProfile>& profiles);

}  // namespace plumb::offline::compare

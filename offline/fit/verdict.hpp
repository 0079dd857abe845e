// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>

#include "fit/fit.hpp"
#include "fit/held_out_excess.hpp"

namespace plumb::offline {

/// The held-out readings that stand out, if they are at most one in seven and so may be single bad
/// readings; else none.
std::span<const Outlier> single_bad(const Fit& fit);

/// The held-out errors that every headline uses: those without `single_bad`.
const ErrorStats& usual_held(const Fit& fit);

/// " (without 3 readings that stand out)" if `usual_held` leaves out some; else empty.
std::string without_words(const Fit& fit);

/// The quality of a calibration. It is within tolerance if 95 % of the held-out errors are, and
/// none exceeds three times the tolerance, by `usual_held`.
enum class Quality {
  kNotHeldOut,        // no pose was held out
  kGood,              // within tolerance, and at the noise floor or as few poses make unavoidable
  kRepeatsDisagree,   // within tolerance, but repeats of a pose differ by more than the error
  kSigmaTooLarge,     // the same, but the noise is stated and not measured
  kGoodNoiseUnknown,  // within tolerance; no noise floor is known
  kGoodNotComplete,   // within tolerance, but clearly above the noise floor
  kGoodButTurned,     // within tolerance, but the orientations are clearly above their noise floor
  kGoodButForSome,    // good, but only without the readings that stand out
  kWorstPoseIsFar,    // 95 % within tolerance, but the worst pose is far beyond it
  kLimitedByNoise,    // beyond tolerance, at the noise floor
  kPerhapsLimitedByJoints,  // beyond tolerance, by no more than the scatter of the joints, which is
                            // inferred and not measured, would cause
  kBeyondSigmaTooLarge,     // beyond tolerance, and clearly below the noise as it is stated
  kBeyondAndTurned,    // beyond tolerance; the points show no more than noise and few poses do,
                       // but the orientations are clearly above their noise floor
  kTooFewPoses,        // beyond tolerance, by no more than few poses make unavoidable
  kBeyond,             // beyond tolerance, clearly above the noise floor
  kBeyondNoiseUnknown  // beyond tolerance; no noise floor is known
};

Quality quality(const Fit& fit, double tolerance_m);

/// The quality in four steps, which every screen shows as a colour.
enum class Grade {
  kGood,
  kPartly,  // good, but not everywhere or not complete; or limited by the measurement
  kBad,
  kUnknown  // nothing was held out
};
Grade grade(const Fit& fit, double tolerance_m);
const char* name_of(Grade grade);  // "good", "partly", "bad", "unknown"

/// The quality in few words: "Good", "Not good everywhere", "Limited by the measurement".
std::string verdict_head(const Fit& fit, double tolerance_m);

/// The held-out error beside the unavoidable one, by `usual_held`. Nothing without held-out poses
/// or a noise floor.
std::optional<HeldOutExcess> held_out_excess_of(const Fit& fit);

/// The same of the measured orientations. Nothing where they are not fitted.
std::optional<HeldOutExcess> turn_excess_of(const Fit& fit);

/// The quality with its figures in one sentence. compare/full_verdict.hpp, which also needs the
/// readings, adds another possible cause.
std::string verdict(const Fit& fit, double tolerance_m);

/// The verb of `plumb` to run next, with a comment that says why: "compile   # ...".
std::string next_step(const Fit& fit, double tolerance_m);

/// Whether these held-out errors are within a tolerance.
bool keeps(const ErrorStats& held, double tolerance_m);

}  // namespace plumb::offline

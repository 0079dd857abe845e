// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>

#include "fit/fit.hpp"
#include "fit/held_out_excess.hpp"

namespace plumb::offline {

/// The held-out readings that stand out, unless they are more than one in seven, which would be no
/// single bad readings any more: then none.
std::span<const Outlier> single_bad(const Fit& fit);

/// The held-out errors that every headline rests on: without those of `single_bad`.
const ErrorStats& usual_held(const Fit& fit);

/// " (without 3 readings that stand out)" where `usual_held` leaves so many out; else nothing.
std::string without_words(const Fit& fit);

/// What a calibration comes to. Within tolerance: at 95 % of the held-out poses and nowhere three
/// times beyond it, by `usual_held`.
enum class Quality {
  kNotHeldOut,       // no pose was held out
  kGood,             // within tolerance, and at the noise floor or as few poses leave it
  kRepeatsDisagree,  // within tolerance, but repeats of a pose differ by more than the model misses
  kSigmaTooLarge,    // the same, but the noise is stated and not measured
  kGoodNoiseUnknown,        // within tolerance; no noise floor is known
  kGoodNotComplete,         // within tolerance, but clearly above the noise floor
  kGoodButForSome,          // one of the good ones, but for readings that stand out
  kWorstPoseIsFar,          // within tolerance but for single poses that do not even stand out
  kLimitedByNoise,          // beyond tolerance, at the noise floor
  kPerhapsLimitedByJoints,  // beyond tolerance, as the scatter of the joints would leave it, which
                            // is inferred and not measured
  kBeyondSigmaTooLarge,     // beyond tolerance, and clearly below the noise as it is stated
  kTooFewPoses,             // beyond tolerance, as few poses leave it
  kBeyond,                  // beyond tolerance, clearly above the noise floor
  kBeyondNoiseUnknown       // beyond tolerance; no noise floor is known
};

Quality quality(const Fit& fit, double tolerance_m);

/// The colour of the answer, the same in terminal, report, page and JSON.
enum class Grade {
  kGood,
  kPartly,  // good, but not everywhere, or something is missing; or the measurement sets the limit
  kBad,
  kUnknown  // nothing was held out
};
Grade grade(const Fit& fit, double tolerance_m);
const char* name_of(Grade grade);  // "good", "partly", "bad", "unknown"

/// The answer in few words: "Good", "Not good everywhere", "Limited by the measurement".
std::string verdict_head(const Fit& fit, double tolerance_m);

/// What the calibrated arm leaves on the held-out poses, by `usual_held`: single bad readings say
/// nothing about physics. Nothing without held-out poses or a noise floor.
std::optional<HeldOutExcess> held_out_excess_of(const Fit& fit);

/// "Is my calibration good?" in one sentence. Where the readings are at hand,
/// compare/full_verdict.hpp says it with what else may be the cause.
std::string verdict(const Fit& fit, double tolerance_m);

/// What `plumb` should be told next, with a comment that says why: "compile   # ...".
std::string next_step(const Fit& fit, double tolerance_m);

/// Whether these held-out figures keep a tolerance.
bool keeps(const ErrorStats& held, double tolerance_m);

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <numbers>

/// Every number by which a fit is set up and judged, and where each comes from:
///
///   textbook  a value of the literature, named beside it
///   arms      the size that such an error has in industrial arms
///   odds      a prior belief or a scale of odds, stated rather than tuned
///   study     the marks of a study were passed with it; no study varied it
///   outside   set after an outside test with simulators of its own (842 cases, 2026-11-22 and 23)
///   data      the least from which it can be told at all
///   cost      bounds the time of a fit
///   contract  users are told it, in a message or in docs/
///   chosen    chosen by judgement; no study varied it, and no record says that one set it
///
/// Limits of outliers and of what the poses can tell stand in solve/constants.hpp. What only keeps
/// the arithmetic sound stands where it is used.
namespace plumb::offline {

// What the poses tell apart.

/// Share of a column that must be independent of those before it: before the scatter is known, and
/// once it is known, when only rounding errors have to be excluded. chosen.
inline constexpr double kCoarseIndependence = 1e-3, kIndependence = 1e-7;
/// Rows from which the scatter of a model, and a start for all rows, are found. cost.
inline constexpr int kScatterRows = 4000;
/// A second placement whose scatter is below so many times that of the best one is told as just as
/// possible. chosen; contract (W-FIT-AMBIGUOUS).
inline constexpr double kNearlyAsGood = 1.5;

// How far an arm is from nominal.

/// A parameter of the arm this far from nominal [m, rad] makes the nominal value doubtful. arms;
/// contract (W-FIT-FAR).
inline constexpr double kFar_m = 20e-3, kFar_rad = 2.0 * std::numbers::pi / 180.0;
/// This far from nominal, the fit describes another arm. arms; contract (E-FIT-FAR).
inline constexpr double kAnotherArm_m = 100e-3, kAnotherArm_rad = 10.0 * std::numbers::pi / 180.0;
/// Standard deviations by which an effect must lie outside the bounds of its law. textbook: a
/// normal number is so far off in 0.3 % of all cases.
inline constexpr double kSureBeyond_sigma = 3.0;
/// Mean square of the distances of an arm from the mean of its fleet, in standard deviations of the
/// fleet, above which it is told as unlike; its expectation is 1. study (docs/fleet-study.md).
inline constexpr double kUnlikeSisters = 2.0;

// An earlier arm.

/// Spread of two arms, as a share of what arms differ from nominal, with which a first fit and a
/// search for bad readings take the earlier arm as known. chosen.
inline constexpr double kHardlyLike = 1.0, kMuchLike = 0.05;
/// Share of the standard deviation to which the final fit holds the numbers at the values that were
/// concluded from both arms. chosen: small enough to hold them.
inline constexpr double kPinned = 1e-3;
/// The hypotheses: spread of the two arms and scale of all differences from nominal, both as
/// multiples of the prior, and noise as a multiple of the one that is known. study
/// (docs/transfer-study.md); cost.
inline constexpr double kSpreads[] = {0.0, 0.01, 0.02, 0.04, 0.08, 0.15, 0.3, 0.5, 0.7, 0.85, 1.0};
inline constexpr double kScales[] = {0.25, 0.5, 1.0, 2.0, 4.0};
inline constexpr double kNoises[] = {0.5,  0.6,  0.7,  0.8,   0.9,   1.0,   1.1, 1.2,
                                     1.4,  1.7,  2.0,  2.5,   3.0,   4.0,   6.0, 9.0,
                                     14.0, 25.0, 50.0, 100.0, 250.0, 1000.0};
/// Prior probability that it is the same arm. odds.
inline constexpr double kSameArmPrior = 0.5;
/// Prior of ln(noise / known noise): a t distribution with 2 degrees of freedom and this scale. The
/// earlier run has seen the noise, but another instrument may be far worse. odds.
inline constexpr double kNoiseScale = 0.2;
/// Prior probability that one number has changed, and the same for the offsets of all joints. odds.
inline constexpr double kChangeChance = 0.1;
/// Size of such a change, in what arms differ from nominal. odds.
inline constexpr double kChangeTimes = 4.0;
/// Spread of the two arms up to which a single change can be seen. data.
inline constexpr double kMostWithChange = 0.1;
/// Spread up to which two arms are as good as the same, and from which on they have little in
/// common. study (docs/transfer-study.md).
inline constexpr double kSameSpread = 0.04, kUnlikeSpread = 0.85;
/// Posterior probability at which something is stated about the two arms: 9 to 1. odds.
inline constexpr double kSureLikeness = 0.9;
/// Posterior probability below which a hypothesis is dropped. cost.
inline constexpr double kNegligible = 1e-7;
/// Standard deviation of what arms differ from nominal [m or rad]: at most, whatever the cell says,
/// and where the cell sets its prior to 0. arms; the latter is the default of [fit] prior_mm.
inline constexpr double kMostBuilt = 10e-3, kUnsetPrior = 0.5e-3;
/// Nominal values are the same within this [SI]: a rounding of the files. data.
inline constexpr double kSameNominal = 1e-9;
/// The largest share of the fitted readings that the earlier run may have seen. chosen; contract
/// (E-FIT-EARLIER).
inline constexpr double kSeenShare = 0.1;
/// Share of the readings that may be taken out as contradicting the earlier arm. chosen.
inline constexpr std::size_t kOneOddOf = 10;

// Held-out poses.

/// Folds of held_out = "auto", up to so many poses. Of more, this share is held out, because folds
/// take time and a fifth of so many poses is no loss. Of fewer it is: with folds the error of a
/// real arm fell from 0.040 to 0.035 mm (2026-11-24). contract (docs/cell-file.md).
inline constexpr int kFolds = 5, kFoldsUpTo = 500;
inline constexpr double kHeldShare = 0.2;
/// A set-up of fewer poses is fitted as a whole: it has up to nine numbers of its own. data.
inline constexpr std::size_t kFewestOfSetup = 8;
/// Coordinates beyond its own numbers that a set-up must have: two readings. data; contract
/// (W-FIT-SETUP-TIGHT).
inline constexpr int kSpareOfSetup = 6;
/// Standard deviations of the sampling error of a mean square that few poses are allowed. textbook:
/// 97.7 % of a normal number.
inline constexpr double kAllowedSigma = 2.0;
/// Quantile of Student's t for the interval of a mean error: 95 %, two-sided. textbook.
inline constexpr double kTwoSided95 = 0.975;
/// Poses below which a mean error has no interval. data.
inline constexpr std::size_t kFewestForInterval = 3;

// The verdict [noise floors, unless stated].

/// Up to here an error is at the noise floor. chosen.
inline constexpr double kAtTheFloor = 1.3;
/// The same for what an earlier arm leaves open. chosen.
inline constexpr double kOpenByChance = 1.3;
/// Below this the poses are not few: their number alone adds so little. outside.
inline constexpr double kFewPoses = 1.15;
/// Clearly below the noise floor, which then is not only noise. chosen.
inline constexpr double kBelowTheFloor = 0.75;
/// An arm whose readings say nothing may err by this much: no error is then called a lack of fit.
/// chosen: more than any error.
inline constexpr double kAnyError = 1e3;
/// The largest held-out error, in tolerances, of a calibration that keeps the tolerance. outside;
/// contract (fit/verdict.hpp).
inline constexpr double kWorstPose = 3.0;

// Still joints.

/// A joint that moves less [rad or m] stands still. data.
inline constexpr double kStill = 1e-3;
/// Poses in which no joint moves more [rad or m] are one pose. data; contract (E-FIT-ONE-POSE).
inline constexpr double kOnePose = 5e-3;
/// Points farther apart [m] are not of one pose: the units of the joints are wrong. arms.
inline constexpr double kArmMoved_m = 0.2;
/// Axes at a smaller angle are parallel [rad]. data.
inline constexpr double kParallel_rad = 1e-3;

// Measured orientations.

/// Rows that are judged: they tell a scatter to 4 % and cost less than the fit. cost.
inline constexpr int kJudgedRows = 500;
/// Rows and repeats below which nothing is said. data.
inline constexpr int kFewestJudged = 6;
inline constexpr std::size_t kFewestOrientationRepeats = 5;
/// Times the stated error up to which orientations are as stated. chosen.
inline constexpr double kAsStatedTimes = 2.0;
/// Another reading of the columns explains them if it leaves less than this share of the error as
/// labelled, and less than this angle. chosen.
inline constexpr double kClearlyLess = 0.2, kMeant_rad = 20e-3;
/// As labelled, a smaller error is no misreading: every wrong reading leaves more. chosen.
inline constexpr double kMisread_rad = 5e-3;
/// No instrument errs by more. arms.
inline constexpr double kNoMeasurement_rad = 0.1;
/// Readings whose error is within so many times the smallest are equally good. chosen.
inline constexpr double kAlike = 1.5;
/// Orientations are those of the nominal arm if their error against it is below this share of that
/// against the arm that the points give. chosen.
inline constexpr double kCopied = 0.1;
/// Rounding of orientations in files. data.
inline constexpr double kRounding_rad = 5e-6;
/// Orientations that differ by less are the same; an arm that turns its tool by more must show it.
/// data.
inline constexpr double kSameOrientation_rad = 1e-5, kTurns_rad = 0.02;
/// Orientations contradict the points if fitting both multiplies the error of the points by more.
/// chosen.
inline constexpr double kHarm = 1.5;

// Error against the number of poses.

/// Largest share of the poses that is fitted; the others judge. chosen.
inline constexpr double kMostFittedShare = 0.8;
/// Random choices of each size. cost.
inline constexpr int kDraws = 5;

}  // namespace plumb::offline

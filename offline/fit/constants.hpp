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
/// W-FIT-AMBIGUOUS is given if the scatter of a second placement is below this multiple of that of
/// the best one. chosen; contract (W-FIT-AMBIGUOUS).
inline constexpr double kNearlyAsGood = 1.5;
/// A fit with all numbers of the arm held near nominal explains the readings as well as one that
/// ended far from it if it leaves less than this multiple of the RMS. chosen: held numbers follow
/// the noise less, which lowers the RMS of the other by a few percent.
inline constexpr double kAsGood = 1.05;

// How far an arm is from nominal.

/// A nominal value is doubtful if its parameter ends this far from it [m, rad]. arms;
/// contract (W-FIT-FAR).
inline constexpr double kFar_m = 20e-3, kFar_rad = 2.0 * std::numbers::pi / 180.0;
/// A parameter this far from nominal describes another arm. arms; contract (E-FIT-FAR).
inline constexpr double kAnotherArm_m = 100e-3, kAnotherArm_rad = 10.0 * std::numbers::pi / 180.0;
/// Standard deviations by which an effect must lie outside the bounds of its law. textbook: a
/// normal number is so far off, on one side, in 0.13 % of all cases.
inline constexpr double kSureBeyond_sigma = 3.0;
/// Mean square of the distances of an arm from the mean of its fleet, in standard deviations of the
/// fleet, above which the user is told that it is unlike; its expectation is 1. study
/// (docs/fleet-study.md).
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
/// Standard deviations among arms beyond which the common scale of all lengths is doubted; with
/// fewer lengths it is not judged. chosen; set on 2026-11-29.
inline constexpr double kUnusualScale = 5.0;
inline constexpr int kFewestLengths = 4;
/// Nominal values are the same within this [SI]: a rounding of the files. data.
inline constexpr double kSameNominal = 1e-9;
/// The largest share of the fitted readings that the earlier run may have seen. chosen; contract
/// (E-FIT-EARLIER).
inline constexpr double kSeenShare = 0.1;
/// At most one in so many readings is taken out because it contradicts the earlier arm. chosen.
inline constexpr std::size_t kOneOddOf = 10;
/// Different poses from which on it is their kind, and not their number, that leaves open where the
/// reflector is. data: 24 coordinates for nine numbers; contract (E-FIT-FEW).
inline constexpr std::size_t kFewestPlacing = 8;

// Held-out poses.

/// held_out = "auto" makes kAutoFolds folds of up to kFoldsUpTo poses, and holds out kHeldShare of
/// more. Folds fit all poses, which lowered the error of a real arm from 0.040 to 0.035 mm
/// (2026-11-24); of many poses a fifth is no loss, and folds would take time. contract
/// (docs/cell-file.md).
inline constexpr int kAutoFolds = 5, kFoldsUpTo = 500;
inline constexpr double kHeldShare = 0.2;
/// A set-up of fewer poses is fitted as a whole: it has up to nine numbers of its own. data.
inline constexpr std::size_t kFewestOfSetup = 8;
/// Whole placements of an artefact are held out if there are this many, in folds up to so many.
/// With fewer, too little is left to calibrate an arm. chosen; contract
/// (docs/without-a-tracker.md).
inline constexpr std::size_t kFewestPlacements = 4;
inline constexpr int kMostPlacementFolds = 10;
/// A touched point has moved if the means of its earlier and later readings are this many standard
/// deviations of their difference apart, and as many of one reading, and the readings next to the
/// cut, so many on each side, show so much of it. chosen: the best of n places to cut is beyond 6
/// by chance in less than one point of 100,000; what a missing effect leaves changes slowly.
inline constexpr double kPointMoved = 6.0, kPointMovedBeside = 3.0, kMovedAtOnce = 0.6;
inline constexpr int kTouchesBeside = 4;
/// Two touched points this near to each other are one [m]. chosen: no two sockets are so near.
inline constexpr double kSamePoint_m = 1e-3;
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
inline constexpr double kFloorTimes = 1.3;
/// Allowance for the sampling error where the uncertainty of an earlier arm raises the expected
/// error. chosen.
inline constexpr double kOpenByChance = 1.3;
/// The poses are few if their number alone raises the error of a correct model to more. outside.
inline constexpr double kFewPosesTimes = 1.15;
/// An error below this contradicts the noise floor, which then contains more than noise. chosen.
inline constexpr double kBelowTheFloor = 0.75;
/// Unavoidable ratio if the readings cannot judge the model, so that no error is called a lack of
/// fit. chosen: larger than any error.
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
/// Rows below which nothing is judged. data.
inline constexpr int kFewestJudged = 6;
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

// Sizes of effects.

/// Times the typical size: hardly any arm has an effect that large. study.
inline constexpr double kMostTimesUsual = 20.0;
/// Standard deviations that are taken off before a size is called large. odds.
inline constexpr double kSureSigma = 3.0;

// Error against the number of poses.

/// Largest share of the poses that is fitted; the others judge. chosen.
inline constexpr double kMostFittedShare = 0.8;
/// Random choices of each size. cost.
inline constexpr int kDraws = 5;

}  // namespace plumb::offline

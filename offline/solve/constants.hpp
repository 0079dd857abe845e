// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

/// Every number that a solution of a fit is judged by, and where each comes from:
///
///   textbook  a value of the literature, named beside it
///   arms      the size that such an error has in industrial arms
///   data      the least from which it can be told at all
///   cost      bounds the time or the memory of a fit
///   contract  users are told it, in a message or in docs/
///   chosen    chosen by judgement; no study varied it, and no record says that one set it
///
/// What only keeps the arithmetic sound (ridges, dampings, ranks) stands where it is used.
namespace plumb::offline {

// Outliers.

/// A reading is an outlier if it misses by more than so many times the usual scatter of the others:
/// in a fit, among held-out poses, and among repeats of a pose. Normal noise puts seven of 10^8
/// readings with three axes beyond it. chosen; contract (docs/glossary.md).
inline constexpr double kOutlierTimes = 6.0;
/// Median length of a vector of k independent standard normal numbers, k = 0 to 6: the square root
/// of the median of chi-square with k degrees of freedom. textbook.
inline constexpr double kMedianChi[] = {0.0, 0.6745, 1.1774, 1.5382, 1.8321, 2.086, 2.3127};
/// Outliers nearer than this share of the farthest one wait for the next solution, because they may
/// only look far on account of it. chosen.
inline constexpr double kFarthestFirst = 0.3;
/// Largest share of the poses that may be outliers; more of them contradict the model. Set above
/// one in ten, because a fold may hold a few more than the whole. chosen.
inline constexpr double kMostOutlierShare = 0.125;
/// Largest share of the poses of one set-up: the rest must still contradict a wrong pose. chosen.
inline constexpr double kMostOfSetup = 0.34;
/// Of many rows, a solution without the outliers starts from the last one if these made less than
/// this share of its cost. cost.
inline constexpr double kLittleOfCost = 0.5;
/// Free coordinates below which the scatter of the other poses is not known. data.
inline constexpr double kFewestLines = 6.0;
/// A pose decides a parameter alone if the smallest pivot of I - H, with H its block of the hat
/// matrix, is no larger than this: its residual is then zero whatever was read. data.
inline constexpr double kDecidesAlone = 1e-6;

// Whether the model is that of the arm.

/// No error of an arm moves its points by this share of the reach, 10 mm at one metre: more is a
/// wrong unit, sign or convention. arms; contract (E-FIT-MISS, E-FIT-BASE-FAR).
inline constexpr double kMostMissed = 0.01;
/// A placement that leaves more than this share of the reach is tried again from other turns of the
/// frame. An arm in good order leaves less with its nominal model. arms.
inline constexpr double kSuspiciousStart = 0.003;
/// The same for points along a line, as a share of what they spread across it. chosen: placed
/// rightly, lines left less than 0.06 of it, placed wrongly more than 0.2.
inline constexpr double kSuspiciousShare = 0.1;
/// A placement stays in the race up to so many times the cost of the best one, three times its RMS:
/// the errors of the arm, not yet fitted, may reverse the order. chosen.
inline constexpr double kNotMuchWorse = 9.0;
/// Placements that are followed. cost.
inline constexpr std::size_t kMostPlacements = 4;
/// Poses on which a placement is judged, and on which the turns of a cube are tried. cost.
inline constexpr int kStartPoses = 500, kTurnPoses = 60;

// What the poses can tell.

/// A number of the arm that is known worse than this is held at nominal: ten times the usual error
/// of a length or an angle of a DH row. arms; contract (docs/model.md).
inline constexpr double kPlausible_m = 5e-3, kPlausible_rad = 5e-3;
/// A direction is weak if the poses tell it worse than a third of the prior of the cell. Its number
/// is a singular value in units of that prior. chosen.
inline constexpr double kWeakBelow = 3.0;
/// How many times farther from nominal an arm may be built than the usual prior of 0.5 mm and
/// 0.5 mrad says; up to 8 mm and 8 mrad. arms.
inline constexpr std::array kBuiltTimes = {1.0, 2.0, 4.0, 8.0, 16.0};
/// Evidence for another width than the usual one [nats]: 20 to 1. odds.
inline constexpr double kBuiltAhead_nats = 3.0;
/// Degrees of freedom of the Student density of such differences: now and then one number is far
/// off, as the zero of a joint after a repair. chosen.
inline constexpr double kBuiltDof = 3.0;
/// A number is named as held near nominal if this share of its square lies in weak directions.
/// chosen.
inline constexpr double kNamedShare = 0.25;
/// Rows from which it is found what the poses can tell. cost.
inline constexpr int kRankRows = 4000;
/// A set-up of no more readings keeps all of them when rows are thinned, since it must still tell
/// where its tracker stands. data.
inline constexpr int kFewOfSetup = 100;
/// Poses all over the joint limits that stand for every pose of the arm, in each set-up. cost.
inline constexpr int kImaginedPoses = 120;
/// Numbers of a Jacobian beyond which only sums over the rows are kept (12 MB). cost.
inline constexpr double kManyNumbers = 1.5e6;

// When a solution has converged.

/// Relative fall of the cost in one iteration: of a final solution, and of one that only tells
/// outliers or the scatter of the model. chosen.
inline constexpr double kSolved = 1e-12, kSolvedRoughly = 1e-8;
/// The same of the last iteration where the tolerance was not met: two parameters with nearly the
/// same effect need not converge to the last digit. chosen.
inline constexpr double kNoChange = 1e-7;
/// Promised fall of the cost, half a sum of squares in standard deviations, below which a step is
/// not worth taking: it moves no number by more than a thousandth of its standard deviation.
/// chosen.
inline constexpr double kNoGain = 1e-6;
/// Iterations. Numbers that the poses hardly show converge slowly. cost.
inline constexpr int kMostIterations = 300;
/// The same of a fit with series of waves, whose normal equations are solved for hundreds of
/// amplitudes. cost.
inline constexpr int kMostSeriesSteps = 200;
/// After so many iterations a fit ends if the predictions have come to rest over the last ones.
/// cost: they bound the time of fits with parameters that the poses do not show.
inline constexpr std::size_t kRestPatience = 50, kRestLookBack = 10;
/// RMS motion of the predictions over the last iterations, in standard deviations of the noise,
/// below which they are at rest; and below which a fit that has used all its iterations still
/// counts as converged. Both are far below what the noise does to the predictions. chosen.
inline constexpr double kAtRest = 3e-3, kNearlyAtRest = 3e-2;

}  // namespace plumb::offline

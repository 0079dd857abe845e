// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

/// Every number by which scatter is judged, and where each comes from:
///
///   textbook  a value of the literature, named beside it
///   arms      the size that it has in industrial arms, and in their instruments
///   odds      a scale of odds, stated rather than tuned [Kass & Raftery 1995]
///   outside   set after an outside test with simulators of its own (842 cases, 2026-11-22 and 23)
///   data      the least from which it can be told at all
///   cost      bounds the time of the search
///   chosen    chosen by judgement; no study varied it, and no record says that one set it
///
/// kEnoughRepeats (noise/repeat_groups.hpp), kPosesOfScatter (noise/joint_scatter.hpp), and
/// kSmallestSigma_m and kUnstatedSigma_m (noise/weights.hpp) are used by other rooms and stand
/// there. solve/constants.hpp defines when a reading is an outlier.
namespace plumb::offline {

// Noise floor.

/// Degrees of freedom of a stated sigma: it is right to some 35 %, which is 1 / sqrt(2 * 4).
/// chosen, as the design of the diagnosis states it (nu = 4 without repeats).
inline constexpr double kStatedDof = 4.0;
/// Standard deviation over the median of |x| of a normal number: 1 / 0.6745. textbook [Huber &
/// Ronchetti 2009].
inline constexpr double kNormalMedian = 1.4826;
/// Repeats count that lie no more rows apart than this, or than this share of all rows: the
/// smallest share at which there are kEnoughRepeats. What changes over longer stretches may be
/// drift. chosen.
inline constexpr double kNextTo = 10.0;
inline constexpr std::array kNearShares = {0.1, 0.25, 0.5, 1.0};

// Repeats of a pose under one context.

/// Pairs of orientations below which repeats do not tell their scatter. data.
inline constexpr std::size_t kFewestOrientationPairs = 5;

/// Temperatures are the same within this [K]: it changes a metre of steel by 6 um. arms.
inline constexpr double kSameTemperature_K = 0.5;
/// Stated loads are the same within this [kg] or [m]: a rounding of the file. data.
inline constexpr double kSameLoad = 1e-3;
/// Measured forces are the same within this [N] or [N m]: noise of a force sensor. arms.
inline constexpr double kSameForce = 1.0;
/// A joint came from a side if its last move exceeded this share of its largest move. chosen.
inline constexpr double kStillShare = 1e-3;

// Readings that stand out.

/// Up to this share of the held-out readings may be single bad readings, which no headline counts:
/// one in seven. More of them say that the model fails there. chosen; users are told.
inline constexpr double kMostSingle = 0.15;

// Scatter of the joints.

/// Least evidence for it [nats], 20 to 1: that of a supported effect (diagnose/constants.hpp).
/// odds.
inline constexpr double kScatterSupported_nats = 3.0;
/// Scatter of every joint at which an arm as a whole counts as usual [rad], or [m] of a sliding
/// joint: industrial arms come back to within 10 to 60 urad. arms.
inline constexpr double kUsualScatter_rad = 60e-6;
/// No joint of an industrial arm scatters by more [rad or m]. arms.
inline constexpr double kMostOfJoint = 200e-6;
/// The scatter of a joint below this share of the largest one is not named. chosen.
inline constexpr double kWorthSaying = 0.3;
/// A joint whose scatter adds less than this share of the noise variance has none. chosen.
inline constexpr double kNoScatter = 1e-4;
/// Poses of the first estimate of the scatter, and most iterations of the first one and of that on
/// more poses. cost.
inline constexpr std::ptrdiff_t kSomePoses = 400;
inline constexpr int kScatterIterations = 40, kMoreScatterIterations = 4;

// Jumps and drifts.

/// Fewest visits on either side of a jump. data.
inline constexpr int kFewestBesideJump = 5;
/// A drift has three numbers for each way in which the part can move; so many coordinates for each
/// way are needed, two for every number. data.
inline constexpr int kFewestOfDrift = 6;
/// Largest autocorrelation of successive residuals that is believed; 1 would make every jump
/// possible by chance. chosen.
inline constexpr double kMostAutocorrelation = 0.95;

// Place of other rows in a series.

/// A row so long before or after the series, as a share of its length, still belongs to it. chosen.
inline constexpr double kBeyondSeries = 0.1;
/// Joints of one pose in two files agree within this [rad] or [m]: files are rounded. data.
inline constexpr double kSameJoints = 1e-5;

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>

/// Every number that a check decides by, grouped by the question that it answers, and where each
/// comes from:
///
///   textbook  the method that is named, or a tail of the distribution that is named
///   arms      the size that such a thing has in industrial arms, controllers and trackers; known
///             in the field, not measured here
///   model     the same number by which the fit or its geometric model decides
///   data      the least from which it can be estimated at all
///   chosen    set by judgement for the reason that is given. The laws of tests/check hold with it;
///             no study compared it with other values
///   cost      bounds the time of a check
///
/// How the numbers were found was not recorded. The reasons were written down on 2026-11-28 from
/// the code, its history and its tests; none of the numbers is known to have been fitted to data.
/// What only keeps the arithmetic sound, bounds the length of a sentence, or is a list of units or
/// names stands where it is used.
namespace plumb::offline::check {

inline constexpr double kDegree_rad = M_PI / 180.0;

// How many rows are looked at. All of these are cost.

/// Rows of a file that are searched for faulty rows or a repeating pattern.
inline constexpr int kMostOfFile = 20000;
/// Rows that an arm is placed by, and that tell what it predicts and what a fit leaves.
inline constexpr int kPredictedRows = 300;
/// Rows that are searched for a part that contradicts the rest, by some thirty fits.
inline constexpr int kContradictionRows = 300;
/// Rows that a common factor of the points is estimated from.
inline constexpr int kScaleRows = 100;
/// Rows that the direction of gravity is judged by.
inline constexpr int kGravityRows = 400;
/// Rows of all set-ups that are fitted to learn whether these share a frame or a reflector.
inline constexpr int kSharingRows = 600;
/// Rows that identifiability is computed from.
inline constexpr int kIdentifiabilityRows = 1500;
/// Rows that the effect of rounded joint readings is averaged over.
inline constexpr int kRoundingRows = 500;

// Does an interpretation of the files fit the points?

/// RMS of what the arm leaves, as a share of the RMS size of the measured cloud. An arm 5 mm and
/// 10 mrad from nominal is fitted to less; a wrong convention leaves decimetres as a rule. arms.
inline constexpr double kFits = 0.01;
/// One explanation is clearly better if it leaves less than the other's error over this. chosen:
/// such a ratio is no accident, and a wrong label costs more than that.
inline constexpr double kClearly = 10.0;
/// Explanations whose errors differ by no more than this factor fit equally well. chosen: seven
/// standard deviations of the RMS of 300 coordinates, which is uncertain by 1 / sqrt(600).
inline constexpr double kAlike = 1.3;
/// What may be left of a fitted arm: so much, and so much of the size of the cloud. arms.
inline constexpr double kReasonable_m = 2e-4, kReasonableShare = 1e-4;
/// A row that is off by so many medians is no part of the arm. model: as outliers of the fit.
inline constexpr double kOffMedians = 6.0;
/// At most such a share of the rows is left out in one of the rounds, and there are so many rounds.
/// chosen: single bad rows must not decide, but an arm that fits only a part must not look right.
inline constexpr double kLeftOutShare = 0.05;
inline constexpr int kLeftOutRounds = 2;
/// 1 sigma of the lengths and the angles of an arm about nominal. arms: joint zeros included.
inline constexpr double kNearNominal_m = 5e-3, kNearNominal_rad = 1e-2;
/// 1 sigma of a measured coordinate beside these. arms: what an arm's small errors leave.
inline constexpr double kCoordinate_m = 50e-6;
/// An arm that ends so many sigma from nominal is another arm. textbook: 1 in 1.7 million of a
/// normal distribution.
inline constexpr double kAnotherArm = 5.0;

// Which of the interpretations that fit is the simplest one?

/// Each changed unit, sign or column costs 1, and rarer mistakes cost more. chosen: only the order
/// matters, and any two mistakes cost more than one.
inline constexpr double kMirrorCosts = 1.1, kOwnUnitCosts = 1.1, kCouplingCosts = 1.1,
                        kQuarterTurnCosts = 1.2, kZeroCosts = 1.3, kFactorCosts = 1.4;
/// The same of orientations: the inverse, a rare order of turns, and columns in another order.
inline constexpr double kInverseCosts = 1.1, kRareOrderCosts = 1.3, kOtherColumnsCost = 1.4;
/// What costs less is a single common mistake. chosen: between 1 and the next cost.
inline constexpr double kOneChange = 1.05;
/// Joint maps whose costs differ by less are equally simple. chosen: half of a mistake.
inline constexpr double kEquallySimple = 0.5;

// How far does the search for an interpretation go?

/// Fewest poses: the linear placement has 15 unknowns, and ten poses give 30 equations. data.
inline constexpr int kFewestPoses = 10;
/// Fewest poses where tens of thousands of interpretations are tried. chosen: twice as many, so
/// that none of them fits by chance.
inline constexpr int kFewestForMany = 20;
/// Poses of the linear placement, of a first glance at hundreds of thousands of interpretations,
/// and of the fit of the best ones. cost.
inline constexpr int kSweepPoses = 40, kGlancePoses = 16, kPlacedPoses = 100;
/// Share of the size of the cloud that is left at that glance by what is not looked at again.
/// chosen: an arm's errors are far less.
inline constexpr double kHopeless = 0.25;
/// Interpretations that are placed, and those of them whose geometry is fitted. cost.
inline constexpr std::size_t kPlacedLeads = 24, kFittedLeads = 8;
/// Joints all of whose orders are tried; of more, swaps and turns of neighbours. cost.
inline constexpr std::size_t kAllOrders = 6;

// Which units may a column have?

/// Angles in radians are hardly larger: three turns. arms.
inline constexpr double kMostRadians = 20.0;
/// Angles in degrees are hardly all smaller: an arm that moves less calibrates nothing. arms.
inline constexpr double kLeastDegrees = 3.0;
/// A ratio of lengths is one of units if its logarithm is so near. chosen: 12 %, a quarter
/// of the distance of the nearest two ratios, 25.4 and 39.4, and more than lengths are off by.
inline constexpr double kRatioTolerance = 0.12;
/// Decades about a reach of 1 m that no arm is odd for, 0.2 m to 5 m, and the changes of labels
/// that each decade beyond is worth. arms; chosen.
inline constexpr double kUsualDecades = 0.7, kOddPerDecade = 3.0;
/// An arm so odd, above 23 m or below 5 cm, may have a wrong unit though it fits. arms.
inline constexpr double kOddArm = 2.0;

// Is a joint's zero, unit or scale another one?

/// Steps of the search for zeros, and for factors at the farthest reading. chosen: Gauss-Newton
/// steps find the rest of half a step.
inline constexpr double kZeroStep = M_PI / 9.0, kFactorStep_rad = 0.15;
/// A joint turns by no more from its zero: one turn and a tenth. arms.
inline constexpr double kMostAngle = 2.2 * M_PI;
/// A joint that moves less tells no factor. data.
inline constexpr double kTellsFactor_rad = 1e-3;
/// A smaller zero [rad], or a factor nearer to 1, is the arm's own error. arms.
inline constexpr double kLeastZero = kDegree_rad, kLeastFactor = 0.02;
/// So many standard deviations of a zero and of a factor must be less than these. chosen: as large
/// as the least zero, half the least factor.
inline constexpr double kMapDeviations = 3.0, kSureZero = kDegree_rad, kSureFactor = 0.01;
/// Maps that are fitted, and those that are handed on. cost.
inline constexpr std::size_t kMapLeads = 24, kMapsKept = 6;
/// Share of the size of the cloud that a map leaves. chosen: a third of kFits, since zeros and a
/// factor are free.
inline constexpr double kMapFits = 3e-3;
/// A factor is that of a unit or a whole number if it is so near, or within so many standard
/// deviations. chosen: these take the arm's errors for noise, which they are not.
inline constexpr double kSameFactor = 5e-3, kFactorDeviations = 6.0;
/// Distance from a whole number up to which no other one is as near. chosen: below a half.
inline constexpr double kOneWhole = 0.3;
/// A zero is a round number of degrees if it is so near to one. arms: how well zeros are set.
inline constexpr double kNearRound_deg = 0.1;
/// The fit finds smaller zeros [rad] by itself and refuses larger ones (E-FIT-FAR). model.
inline constexpr double kFitFindsZero = M_PI / 18.0;

// Is the given frame wrong, and how?

/// Two frames that differ by less are the same; the difference is the arm's own error. arms.
inline constexpr double kFrameTurned_rad = 5e-3, kFrameMoved_m = 5e-3;
/// A direction is called an axis if so much of it lies along that axis: 11 degrees. chosen.
inline constexpr double kAlongAxis = 0.98;
/// A unit explains the distance if it brings the two so near, as a share of it. chosen: far less
/// than any two units differ by.
inline constexpr double kFrameUnit = 0.02;

// Have all points one factor?

/// A smaller difference of the factor from 1 is within a tracker's own accuracy. arms.
inline constexpr double kLeastScale = 50e-6;
/// A larger difference from 1 is looked for without the fitted lengths. chosen: fits absorb smaller
/// ones.
inline constexpr double kLeastGross = 0.01;
/// Fewest fitted lengths whose scatter tells how far lengths are off by themselves. chosen.
inline constexpr std::size_t kFewestLengths = 5;
/// The factor in standard deviations, multiplied by 1 + the second number / degrees of freedom.
/// textbook: Student's t exceeds that once in 4,000 with five lengths and 85,000 with eleven.
inline constexpr double kScaleDeviations = 5.0, kScaleTails = 6.0;
/// The two longest lengths ask for the same factor within such a share of the change. chosen.
inline constexpr double kLongestAgree = 0.25;
/// No other length is off by so many times the scatter. textbook: 3 sigma.
inline constexpr double kLengthContradicts = 3.0;
/// A unit explains the factor if it is so near. chosen: the nearest two ratios of units, 3.05 and
/// 3.28, differ by 7 %.
inline constexpr double kUnitOfFactor = 0.01;

// Were rows one after another written otherwise?

/// With fewer rows no structure among them is looked for. chosen.
inline constexpr int kFewestRows = 30;
/// Rows one after another that share a fault or an error. chosen: two agree by chance.
inline constexpr int kFewestOfRun = 3;
/// Rows that an arm near nominal is fitted to. data: 45 coordinates for some 36 numbers, which are
/// held near nominal.
inline constexpr std::size_t kFewestFitted = 15;
/// Rows of a part to which it is thinned. cost.
inline constexpr int kMostFitted = 100;
/// Faults of one file. cost.
inline constexpr int kMostFaults = 3;
/// RMS [m] below which nothing is left to explain. arms: what effects of real arms leave.
inline constexpr double kNothingToExplain_m = 0.3e-3;
/// RMS of a part that is sound, as a share of the reach. arms.
inline constexpr double kSoundShare = 0.0015;
/// No instrument and no arm scatters less. arms.
inline constexpr double kLeastScatter_m = 10e-6;
/// Quantile of all errors that is one of sound rows. data: the arm was fitted to a quarter or more.
inline constexpr double kSoundQuantile = 0.2;
/// The repaired rows fit so many times better. chosen: a wrong unit or sign is a gross error.
inline constexpr double kTimesBetter = 20.0;
/// They fit like the others: their median and this quantile of them, in medians of the others.
/// chosen.
inline constexpr double kLikeOthers = 3.0, kMostlyLikeOthers = 6.0, kMostOfRun = 0.8;
/// Any other explanation leaves so many times more. chosen: as kLikeOthers.
inline constexpr double kNextBest = 3.0;
/// Rows that are off by so many medians and so much may have another fault. chosen.
inline constexpr double kElsewhere = 10.0, kElsewhere_m = 5e-3;
/// One row between two outliers of a run may be none. chosen.
inline constexpr int kNextOfRun = 2;
/// Scatter about the mean error of a run, as a share of it, up to which it is one vector. chosen.
inline constexpr double kOneVector = 0.2;

// Do errors repeat from row to row?

/// Longest period in rows. chosen: more faces, stations or reflectors in turn are rare.
inline constexpr int kLongestPeriod = 12;
/// Fewest rows at each place of the period. chosen: their mean has a third of their scatter.
inline constexpr int kFewestOfPlace = 8;
/// Errors beyond so many medians count as if they were there. chosen: a few decide nothing.
inline constexpr double kClipMedians = 20.0;
/// Share of the error that a pattern makes up. chosen: less is not worth the trouble.
inline constexpr double kPatternShare = 0.2;
/// Standard deviations of chi^2 above its mean. textbook: all periods in both frames together are
/// exceeded by chance once in 1.8 million files.
inline constexpr double kPatternDeviations = 18.0;
/// A shorter period is taken if it explains so much of what the best one explains. textbook: its
/// multiples explain the same and, by chance, some more.
inline constexpr double kPatternAlike = 0.8;
/// Share of a column's variance that follows the period, beyond which it may be the cause. chosen.
inline constexpr double kPatternFollows = 0.25;
/// Share of the pattern that two values explain, beyond which it is told as one vector. chosen.
inline constexpr double kTwoValued = 0.7;

// Does a part of the rows contradict the rest?

/// A fit that leaves less has no such part. arms.
inline constexpr double kGood_m = 0.1e-3;
/// Median error beyond which the common fit is no start. arms: no arm that works leaves so much.
inline constexpr double kGross_m = 5e-3;
/// Share of the rows that is fitted. textbook: (n + p + 1) / 2 of n rows resist the most outliers
/// [Rousseeuw & Van Driessen 2006]; 0.54 n are those of 300 rows and 23 numbers.
inline constexpr double kTrimmed = 0.54;
/// Concentration steps, random starts, and rows of such a start. cost; 12 rows are 36 coordinates.
inline constexpr int kConcentrationSteps = 8, kRandomStarts = 12, kOfRandomStart = 12;
/// Errors of the majority and of the part, in RMS errors of the majority. chosen: no normal error
/// is beyond the first.
inline constexpr double kInside = 4.0, kOutside = 6.0;
/// Share of the rows that may lie between the two. chosen: else there is no gap.
inline constexpr double kBetween = 0.04;
/// Shares of the rows that such a part has. model: fewer are outliers, and the fit leaves out up to
/// an eighth. chosen: of more it cannot be told which part is right, as 0.46 are trimmed.
inline constexpr double kLeastPart = 0.08, kMostPart = 0.45;
/// Median error of the part, in RMS errors of the majority, and its least size. chosen; arms.
inline constexpr double kPartClear = 10.0, kPartError_m = 0.3e-3;
/// Runs of neighbouring rows. chosen: fewer are blocks, whose cause is a moment or a fault.
inline constexpr int kFewestRuns = 5;
/// Correlation with a column beyond which that column may be the cause. chosen.
inline constexpr double kPartFollows = 0.6;

// Which way does gravity point?

/// Fewest residuals beyond the parameters. chosen: their variance is then known to 26 %.
inline constexpr int kSpareResiduals = 30;
/// Gravity leaves less than this share of what the geometry leaves, and of what errors of once a
/// turn leave: half of it is explained. chosen.
inline constexpr double kGravityExplains = 0.5, kBeatsGears = 0.5;
/// Another direction leaves less than this share of what the cell's leaves. chosen.
inline constexpr double kOtherDirection = 0.25;
/// Joints that yield clearly: how many, and by how many standard deviations. chosen: the model
/// lacks more than noise, so that the usual 3 would be no proof.
inline constexpr int kFewestYielding = 2;
inline constexpr double kYieldDeviations = 10.0;
/// A joint speaks against it by so many standard deviations and so much of the surest one. chosen.
inline constexpr double kAgainstDeviations = 4.0, kAgainstShare = 0.2;
/// An arm stands upright, hangs or leans at a wall to so much. arms: nobody mounts one so askew.
inline constexpr double kUpright = 2.0 * kDegree_rad;

// Do set-ups share what they are said to share?

/// Fewest rows of the set-up. chosen: 30 coordinates tell six numbers of a frame well.
inline constexpr int kFewestOfSetup = 10;
/// The fit with a frame or reflector of its own leaves less than this share. chosen.
inline constexpr double kSharingExplains = 0.5;

// Are readings rounded or copied, and is the noise as stated?

/// Rounding is seen from such a share of the noise on. textbook: it then adds 12 % to the RMS.
inline constexpr double kRoundingSeen = 0.5;
/// Rounding is seen from this step [m] on where no noise is known. arms: no tracker is read coarser
/// on purpose.
inline constexpr double kCoarseRounding_m = 50e-6;
/// Rounding explains what a fit leaves if the two differ by no more than this factor. chosen.
inline constexpr double kRoundingLeft = 0.5;
/// Different values of a column; fewer may be round by chance or choice. chosen.
inline constexpr std::size_t kFewestValues = 10;
/// Following repeats that each one is compared with. cost.
inline constexpr int kNeighbours = 3;
/// Fewest pairs of repeats that differ, from which the chance of equal ones is estimated. chosen.
inline constexpr double kEnoughPairs = 5.0;
/// Standard deviation of a tracker whose noise is unknown: hardly any repeats a point better. arms.
inline constexpr double kQuietTracker_m = 3e-6;
/// Equal ones are too many beyond this factor, since their probability is only estimated (chosen),
/// and so many standard deviations of the count (textbook: 1 in 30,000 of a normal distribution).
inline constexpr double kChanceFactor = 1.5, kChanceDeviations = 4.0;
/// Expected number of readings that rounding makes equal, from which on it is said. chosen.
inline constexpr double kWorthSaying = 0.5;
/// Rows with the same point that each one is compared with. cost.
inline constexpr std::ptrdiff_t kMostCompared = 100;
/// Readings [m] of one pose hardly differ by more. arms.
inline constexpr double kOnePlace_m = 5e-3;
/// Repeats contradict the stated noise from this factor on, either way. chosen: they estimate it
/// far better, but an expanded uncertainty of k = 2 or 3 stated as sigma is no reason for a
/// warning.
inline constexpr double kNoiseOtherwise = 5.0;

// Do the poses tell the numbers?

/// Coordinates for each number below which poses are few. chosen: half of them check the others.
inline constexpr double kCoordinatesEach = 1.5;
/// Poses that are advised: so many, and such a multiple of the fewest. chosen.
inline constexpr int kAdvisedPoses = 30, kAdvisedTimes = 2;
/// Numbers of a frame, which no earlier run knows. model.
inline constexpr int kFrameNumbers = 6;
/// A singular value below this share of the largest is no direction of its own. model.
inline constexpr double kSingular = 1e-7;
/// Share of a column that is left where nothing separates it from others. chosen: above the
/// rounding of the derivatives.
inline constexpr double kSeparable = 1e-6;
/// Share of a column that another one takes over to be named. chosen.
inline constexpr double kPartnerShare = 0.1;
/// Correlation from which on two numbers are said not to be told apart. textbook: a standard
/// deviation that is three times as large as alone, 1 / sqrt(1 - rho^2).
inline constexpr double kCorrelated = 0.95;
/// A reflector nearer to the last axis hardly shows that joint. chosen.
inline constexpr double kOnAxis_m = 5e-3;
/// A joint that uses more, and such a share of its limits, is not what is missing. chosen.
inline constexpr double kWideRange = M_PI / 3.0, kWideShare = 0.4;
/// A joint that uses less [rad] or [m] does not move. arms: jitter of a commanded position.
inline constexpr double kStill = 5e-3;
/// Thickness of a cloud of points that is a plane, as a share of its spread. chosen.
inline constexpr double kFlatShare = 0.01;
/// Share of a joint's limits below which predictions beyond are guesses. chosen: half.
inline constexpr double kLittleOfLimits = 0.5;
/// Share of the used range that is a gap, and of the poses that crowd one tenth of it. chosen.
inline constexpr double kGap = 0.25, kCrowded = 0.6;
/// Less [rad] or [m] beyond a limit is rounding of the limit. arms.
inline constexpr double kBeyondLimit = 1e-3;

// Can an effect be so large?

/// Share of the reach that an effect moves the point by. arms: heavy arms sag by a tenth of that.
inline constexpr double kLargestEffect = 0.02;

}  // namespace plumb::offline::check

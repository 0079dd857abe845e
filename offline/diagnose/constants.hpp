// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <numbers>

#include "plumb/format/limits.hpp"

/// Every number that a diagnosis decides by, and where each comes from:
///
///   study    chosen on seeds 1, 2 and 3 of the blind study (docs/blind-study.md) by 2026-11-21;
///            which of the three set which number was not recorded. Seed 2028, which its table
///            shows, had no say
///   outside  set after an outside test with simulators of its own (842 cases, 2026-11-22 and 23)
///   odds     a scale of odds, stated rather than tuned [Kass & Raftery 1995]
///   arms     the size that such an error has in industrial arms
///   formulas set beforehand and kept after seeds 1 and 5 of docs/formula-study.md, 2026-11-28
///   data     the least from which the number can be estimated at all
///   cost     bounds the time of a diagnosis
///   chosen   stated with its reason, and not changed after seeing what it does
///
/// What only keeps the arithmetic sound (ridges, ranks, tiny denominators) stands where it is used;
/// what one effect needs (group_share, tightened after seed 2027) stands with the effect.
namespace plumb::offline {

// Evidence [nats: ln of a Bayes factor].

/// Least evidence of a supported effect, less the cost of the search: 20 to 1. odds; kept by study.
inline constexpr double kSupported = 3.0;
/// One explanation is clearly ahead of another: 22,000 to 1. study.
inline constexpr double kAhead_nats = 10.0;
/// A pattern also explains so much more of what is left than the library's best. study.
inline constexpr double kAhead_share = 0.05;
/// "Certain": 22,000 to 1. odds.
inline constexpr double kCertain_nats = 10.0;
/// "Very likely": 150 to 1. odds.
inline constexpr double kVeryLikely_nats = 5.0;
/// Confounded candidates this near to each other cannot be told apart: laws are accurate to some
/// percent only, and a lead of 3 to 5 nats was right in 58 %, of 5 to 10 nats in 70 %. outside.
inline constexpr double kTold_nats = 10.0;
/// Share of the motion of a real cause that its law does not describe. Laws are accurate to some
/// percent; a tenth is the most that is believed of a law that fits. chosen.
inline constexpr double kLawLeaves = 0.1;
/// Candidates this near to each other have the same evidence: 1.6 to 1. odds.
inline constexpr double kSameEvidence = 0.5;
/// Least evidence of a further wave of a joint, less the cost of its search: as kSupported. odds.
inline constexpr double kWavePays = 3.0;
/// Widths of the prior in typical sizes, half a decade apart. arms.
inline constexpr std::array kPriorWidths = {0.1, 0.3, 1.0, 3.0, 10.0, 30.0};

// Mean square of the residuals, over that of the noise.

/// Clearly above the noise: 1.5 times its size. study.
inline constexpr double kAboveNoise = 2.25;
/// At the noise, the sampling error of the repeats apart. study.
inline constexpr double kAtNoise = 1.15;
/// An effect reaches the noise if it takes away so much of what is left. study.
inline constexpr double kNearlyAll = 0.75;

// Errors that fall.

/// Share of the held-out RMS, over the folds, that a candidate must promise. study.
inline constexpr double kClearShare = 0.01;
/// Share of the fitted RMS that its refit must keep: half of that promise. outside.
inline constexpr double kRealShare = 0.005;
/// Less of the error on unseen poses than this is little. outside.
inline constexpr double kLittleShare = 0.1;
/// An error of more than so many noise floors is mostly due to something else. outside.
inline constexpr double kFarAboveFloor = 3.0;
/// A refit gives orientations a larger weight if they scatter about it by less than this share of
/// the sigma that it used. chosen.
inline constexpr double kSharperOrientations = 0.8;
/// Standard errors of the folds by which the error of the points rises where they speak against an
/// effect that orientations show. chosen.
inline constexpr double kSpeaksAgainst = 2.0;
/// The error of orientations on unseen poses falls clearly if less than this share of it is left.
/// chosen.
inline constexpr double kTurnsFall = 0.95;
/// The error on unseen poses may end so much above its smallest value along the steps. outside.
inline constexpr double kMostRise = 1.05;
/// A single step may not raise it beyond this. outside.
inline constexpr double kLeap = 1.5;

// One effect beside another.

/// Of the motion of the strongest effect: less may be what the strongest one's law leaves. study.
inline constexpr double kRemainder = 0.15;
/// An effect that explains less of what is left does not end the search for fast waves. outside.
inline constexpr double kMostOfIt = 0.5;
/// A rival is followed if it explains so much of what the chosen effect explains. study.
inline constexpr double kNearlyAsMuch = 0.5;
/// Mutual reproduction of their motions beyond which two candidates are confounded. study.
inline constexpr double kConfounded = 0.8;
/// Share of the motion, either way, beyond which two candidates are one and the same. study.
inline constexpr double kSameMotion = 0.9999;

// Sizes.

/// RMS motion [m] of a parameter whose size the arm decides. arms.
inline constexpr double kTypicalMotion_m = 0.1e-3;
/// Sizes of patterns: of an angle, a shift of the point, and a turn of the tool or base. arms.
inline constexpr double kAngle_rad = 100e-6, kShift_m = 50e-6, kTurn_rad = 30e-6;
/// Of a step [m or rad]: as its law in the library says. arms.
inline constexpr double kTypicalStep = 300e-6;

// Folds and noise.

/// Below so many fit poses there are more folds, so that each leaves enough to fit. study.
inline constexpr int kManyPoses = 100;
inline constexpr int kFoldCount = 6, kManyFoldCount = 10;
/// Coordinates beyond the parameters below which nothing can be told. data.
inline constexpr double kFewestFreeLines = 20.0;

// Scatter of the joints.

/// Scatter that explains no more than this needs no second look [nats]. odds.
inline constexpr double kScatterMatters = 2.0;
/// Estimates of the scatter beside the best candidate, should that become another one. cost.
inline constexpr int kScatterRounds = 2;

// Waves of a joint [cycles a turn].

/// The slowest wave; slower ones are the first two harmonics of a joint. arms.
inline constexpr int kFirstWholeWave = 3;
/// Slow waves: up to the last one, in such steps or finer where the joint turns far. arms.
inline constexpr double kLastRipple = 40.0, kRippleStep = 0.5;
/// Fast ones: strain wave gears have twice as many waves as their ratio, seldom above 100. arms.
inline constexpr double kFastest = 200.0;
/// Of the motor, in cycles of its own turn: eccentric, once, and twice a turn. arms.
inline constexpr std::array kMotorWaves = {0.5, 1.0, 2.0};
/// Of these, what every scan tries: an eccentric motor shaft, and one that is not round. arms.
inline constexpr std::array kAlwaysMotorWaves = {1.0, 2.0};
/// A joint that moves less shows no wave [rad]. data.
inline constexpr double kLeastRange_rad = 0.2;
/// Of a joint that turns on and on [rad]; a finer grid is of no use. cost.
inline constexpr double kMostRange_rad = 8.0 * std::numbers::pi;
/// Steps of the grid between two waves that the range can tell apart; 2 is a whole wave more over
/// the range. study.
inline constexpr double kLeastSteps = 1.6;
/// A joint that slides by less shows no pitch [m]. data.
inline constexpr double kLeastTravel_m = 0.05;
/// Waves of one joint. cost.
inline constexpr std::size_t kMostWaves = 12;
/// Waves of a series at each of its joints. arms; cost.
inline constexpr int kSeriesWaves = 64;
/// Standard deviation of the prior of a series' first wave, at most [rad]: a minute of arc, the
/// accuracy that makers of strain wave gears state. arms.
inline constexpr double kLargestWave_rad = 290e-6;
/// The first waves of a series are those that a smooth law could be mistaken for. cost.
inline constexpr Eigen::Index kSmoothWaves = 4;
/// Single waves of one joint that make way for a series of it. odds.
inline constexpr std::size_t kFewestForSeries = 3;
/// Waves of a series of all joints at each of them. arms; cost.
inline constexpr int kWavesOfAll = 40;
/// Joints that it needs: one alone is judged beside the other laws of that joint. odds.
inline constexpr std::size_t kFewestJointsOfAll = 2;
/// Least evidence of the fast waves of so many of its joints: 3 to 1. odds.
inline constexpr double kFastWavesPay = 1.0;
/// A wave at a joint that has a series is a whole number of cycles if it is so near to one. study.
inline constexpr double kWholeWave = 0.15;

// Patterns and steps.

/// Harmonics of another joint's angle. cost.
inline constexpr int kHarmonics = 3;
/// Settling times of a joint that warms up, as shares of the series. cost.
inline constexpr std::array kSettlingShares = {0.03, 0.1, 0.3};
/// Half periods of the series over time. cost.
inline constexpr int kHalfPeriods = 40;
/// The same of a joint, whose drive warms up and cools down. cost.
inline constexpr int kHalfPeriodsOfJoint = 8;
/// Encoders are at rest below it [rad or m]. data.
inline constexpr double kNoMove = 1e-5;
/// A joint that moves less shows no harmonic [rad]. data.
inline constexpr double kLeastForHarmonics_rad = 0.2;
/// Poses on either side of a step. data.
inline constexpr Eigen::Index kFewestBesideStep = 4;
/// Moves of one part of the set-up, and how often their places are looked for again. cost.
inline constexpr std::size_t kMostMoves = 4;
inline constexpr int kSettlingRounds = 3;

// Formulas for structure that no law explains.

/// Formulas that are offered, and terms of each. cost.
inline constexpr std::size_t kMostFormulas = 3, kMostFormulaTerms = 8;
/// Harmonics of each of two angles whose product is a term. cost.
inline constexpr int kFormulaHarmonicsOfPair = 2;
/// Travels over which a joint may forget where it came from [rad]. arms.
inline constexpr std::array kFormulaTravels_rad = {0.03, 0.1, 0.3};
/// A column of which the model imitates all but this share of its square is no term. data.
inline constexpr double kFormulaOwnShare = 1e-4;
/// Digits of the numbers that a formula states. cost.
inline constexpr int kFormulaDigits = 4;
/// Share of the held-out error that a formula must take away. formulas.
inline constexpr double kFormulaFall = 0.1;
/// That fall in its own standard errors. formulas.
inline constexpr double kFormulaFallSe = 2.0;
/// The first terms of a formula that explain so much of what all of them do are one, too.
/// formulas.
inline constexpr double kFormulaShort = 0.9;
/// Another formula is offered if its error is at most so many times the least one. formulas.
inline constexpr double kFormulaNearly = 1.25;
/// Points of the curve of a formula. cost.
inline constexpr int kFormulaCurve = 13;

// How far a search goes.

/// Additions of one selection, and effects that are taken out and looked for again. cost.
inline constexpr int kMostSteps = 60;
inline constexpr std::size_t kMostExchanges = 4;
/// Findings that stay undecided and are carried as nuisances in one search, and how often a model
/// with what was found beside them is searched again. cost.
inline constexpr int kMostCarried = 4, kMostBesideSearches = 3;
/// Effects of a model; some are left to the user. cost.
inline constexpr std::size_t kMostEffects = format::kMaxEffects - 4;
/// Effects of one explanation, and rivals of the chosen effect that are followed. cost.
inline constexpr int kLongestExplanation = 3, kRivalsFollowed = 5;
/// Refinements of a constant; they end where neighbours are nearer than the factor. cost.
inline constexpr int kRefinements = 12;
inline constexpr double kFinestFactor = 1.05;
/// The same of a pitch, as a share of its first step. cost.
inline constexpr double kFinestOfTravel = 0.1;
/// So many poses choose the effects: what lowers a held-out error by 1 % then has an evidence
/// above 90 nats. The numbers of the chosen effects are fitted to all readings. cost.
inline constexpr int kMostChoosing = 3000;
/// Candidates in the list, and those of it that are compared for confounding. cost.
inline constexpr std::size_t kListed = 12, kCompared = 8;
/// Waves of a series whose sizes are listed, and poses on which it is compared with others. cost.
inline constexpr std::size_t kPeaksListed = 6;
inline constexpr Eigen::Index kComparedPoses = 1000;

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

/// Every number that a recheck decides by, and where each comes from:
///
///   belief   a prior belief about what happens to arms between two measurements, stated rather
///            than measured
///   arms     the size that such a change has in industrial arms and on trackers' stations
///   odds     a scale of odds or of chances, stated rather than tuned
///   data     the least from which it can be told at all
///   cost     bounds the time of a recheck
///
/// None was fitted to the study of docs/recheck-study.md. What only keeps the arithmetic sound
/// stands where it is used.
namespace plumb::offline::recheck {

// Changes and their chances.

/// Typical size of a displacement: a millimetre and a milliradian, multiplied by one of the scales.
/// arms.
inline constexpr double kShift_m = 1e-3, kTurn_rad = 1e-3;
/// Scales of the change of a joint's zero or link: from what a tracker just sees to a joint that
/// was mounted anew. arms.
inline constexpr std::array kScales = {0.1, 1.0, 10.0, 100.0};
/// Scales of the motion of tool and base: up to another tool, or a tracker or an arm that was put
/// somewhere else. arms.
inline constexpr std::array kScalesOfPlacing = {0.1, 1.0, 10.0, 100.0, 1000.0};
/// Scales of the change of an effect, in its typical sizes. arms.
inline constexpr std::array kScalesOfEffect = {0.1, 1.0, 10.0};
/// Scales of the error of a single wrong reading, in the noise of one. arms.
inline constexpr std::array kScalesOfReading = {10.0, 100.0, 1000.0};
/// RMS motion of the measured point by a usual change of an effect. arms.
inline constexpr double kEffect_m = 1e-4;
/// A usual change of an effect, as a share of its present size. belief.
inline constexpr double kEffectShare = 0.5;
/// Prior probability that each part has changed. belief.
inline constexpr double kToolChanged = 0.25, kBaseChanged = 0.25, kJointsChanged = 0.4,
                        kReadingsWrong = 0.1;
/// Shares of the kinds of change of one joint; those of effects stand in their descriptors. belief.
inline constexpr double kOffset = 0.4, kBent = 0.2;  // encoder offset, bent link

// Evidence.

/// Degrees of freedom with which the size of all variances is known beforehand. belief.
inline constexpr double kTrusted = 30.0;
/// How often at most a check finds something although nothing has changed, for as long as the noise
/// is what the run says. By Markov's inequality a Bayes factor exceeds 50 in at most one of 50 such
/// checks. odds.
inline constexpr double kFalseAlarm = 0.02;
/// Behind by less than this, an explanation is not ruled out [nats]: 20 to 1. odds.
inline constexpr double kUndecided = 3.0;
/// Farther behind, it is not mentioned [nats]: 22,000 to 1. odds.
inline constexpr double kListed = 10.0;
/// Probability by chance of so large a remainder that something else must have changed. odds.
inline constexpr double kTooMuch = 1e-4;
/// chi^2 of a change that is found nearly always. odds.
inline constexpr double kNoticed = 20.0;
/// Two explanations whose points differ by less than this share of the tolerance are one motion.
/// belief.
inline constexpr double kSamePoints = 0.5;
/// Times its usual size that an effect may have after a change: what broke may err hundreds of
/// times as much as usual, nothing thousands of times. arms.
inline constexpr double kMostTimesAfterChange = 1000.0;
/// A change is hardly ever larger [typical sizes]. belief.
inline constexpr double kWidest = 10.0;

// Search.

/// Changes that one check can find. data.
inline constexpr int kMostChanges = 3;
/// With fewer poses no single reading can be identified as wrong. data.
inline constexpr int kFewestForOddOnes = 4;
/// Wrong single readings, as a share of all; more are no accident. belief.
inline constexpr double kOddShare = 0.2;
/// Wrong single readings; each triples the combinations of scales. cost.
inline constexpr int kMostOdd = 3;
/// At most this many readings are judged. cost.
inline constexpr int kMostReadings = 100;
/// Poses that a plan chooses from; more would add next to nothing. cost.
inline constexpr int kMostPoses = 2000;

// What the calibration lacks, as it shows in its own readings.

/// Correlation lengths [rad], or [m] of a sliding joint; the first one only joins repeats of one
/// pose. arms.
inline constexpr std::array kLengths = {1e-3, 0.1, 0.2, 0.4, 0.8, 1.6};
/// A pose that is driven to again differs by no more [rad] or [m]: resolution of encoders and the
/// controllers' window for "arrived". arms.
inline constexpr double kSamePose = 2e-3;
/// Readings of the calibration that are compared with new ones. cost.
inline constexpr std::size_t kMostNear = 500;
/// Share of the calibration's poses whose distance from their nearest neighbour is usual; a reading
/// farther from all of them lies where the model has never been tried. odds.
inline constexpr double kNearlyAll = 0.99;
/// What the model lacks there, in the usual scatter of its readings: as much as the effects that
/// diagnoses find beyond geometry. belief.
inline constexpr std::array kLacksElsewhere = {3.0, 10.0};
/// What the model lacks does not matter if it is smaller than this share of the noise. odds.
inline constexpr double kSmallShare = 0.1;

// Gauss-Newton steps.

inline constexpr int kSteps = 6;          // cost
inline constexpr double kSettled = 1e-3;  // of a standard deviation: a smaller step is the last one
/// A base that moved farther [m] is placed anew before the first step. data.
inline constexpr double kFarAway = 2e-3;
/// Prior size of such a placing, in millimetres and milliradians: anywhere in a hall. arms.
inline constexpr double kAnyPlace = 1000.0;

}  // namespace plumb::offline::recheck

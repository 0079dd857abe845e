// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Every number by which errors are compared, and where each comes from:
///
///   textbook  a value of the literature, named beside it
///   data      the least from which it can be told at all
///   contract  users are told it, in a message or in docs/
///   chosen    chosen by judgement; no study varied it, and no record says that one set it
namespace plumb::offline::compare {

/// Probability by chance below which a pattern matters, shared among all patterns that are tried
/// [Bonferroni]. textbook; contract (compare/profile.hpp).
inline constexpr double kPatternChance = 0.01;
/// Bins of a quantity and poses of each on average; fewer poses make wider bins. chosen.
inline constexpr int kMostBins = 6, kPosesPerBin = 8;
/// The same of a joint angle, each bin of which has a correction of its own. chosen.
inline constexpr int kMostJointBins = 12, kPosesPerJointBin = 15;
/// A quantity varies if its range exceeds this share of its largest value, a torque if it exceeds
/// this share of the largest torque of any joint. data.
inline constexpr double kVaries = 1e-6, kTorqueVaries = 1e-3;
/// A joint that turns by less [rad] has no bins. data.
inline constexpr double kJointMoves_rad = 1e-6;
/// Share of the squared error above which a joint's own angle clearly explains a part of it: the
/// scatter of the joints alone shows up to a tenth. chosen; set on 2026-11-24.
inline constexpr double kClearJointShare = 0.15;
/// Standard deviations by which the share of turns about one axis exceeds that of turns in any
/// direction before it is said. chosen; set on 2026-11-29.
inline constexpr double kClearAxis = 5.0;
/// ln of the probability of a lack of fit by chance: once in a thousand. textbook.
inline constexpr double kLackOfFit_ln_p = -6.9;
/// Degrees of freedom that stand for an exactly known sigma. textbook: the limit of F is
/// chi-square.
inline constexpr double kKnownExactly = 1e7;
/// Two-sided 95 % of a standard normal number. textbook.
inline constexpr double k95 = 1.959964;
/// Visits below which there is no autocorrelation. data.
inline constexpr int kFewestForAutocorrelation = 8;

}  // namespace plumb::offline::compare

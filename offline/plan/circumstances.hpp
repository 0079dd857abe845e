// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "cell/random.hpp"
#include "plan/contrasts.hpp"

namespace plumb::offline {

/// What can be chosen at a reading beside the pose, because one of two effects depends on it. SI.
struct Circumstances {
  bool approach = false;          // from which side, and how far, every joint arrives
  bool short_and_long = false;    // some joints by short moves, some by long ones
  std::vector<Payload> payloads;  // loads that can be mounted; fewer than two: nothing to choose
  bool load_matters = false;      // a second load would tell, whether or not one is known
  bool warm = false;              // in two blocks, the second one with a warm arm
  bool late = false;              // in two blocks, the second one later; measured poses again
  double warmer_K = 10.0;
  double later_s = 3600.0;

  bool two_payloads() const { return payloads.size() > 1; }
  bool two_blocks() const { return warm || late; }
  /// What is varied, in the order in which it is told; empty: poses alone.
  std::vector<Contrast> contrasts() const;
};

/// What matters for two effects, as `diagnose` words it (diagnose/confounding.hpp). Loads: those
/// given [kg]; else the lightest and the heaviest that were measured with; else none and that of
/// the cell, if it states one.
Circumstances circumstances_of(const Cell& cell, const Measurements& measured, const EffectEntry& a,
                               const EffectEntry& b, const std::vector<double>& given_kg);

/// One reading that could be made.
struct ReadingOption {
  Eigen::VectorXd q;
  Eigen::VectorXd
      approach;      // last move of every joint, with its sign [rad] or [m]; empty: as it comes
  int payload = -1;  // of the circumstances; -1: the usual one
  bool second_block = false;
  int again = -1;  // row of the measurements whose pose it is; -1: a new pose
};

/// Every pose of the pool, and with two blocks those of the first readings measured, under all
/// choices of load and block and a random approach each. At most about `most`.
std::vector<ReadingOption> reading_options(const Cell& cell, const Measurements& measured,
                                           const RowsN& pool, const Circumstances& circumstances,
                                           int most, std::uint64_t seed);

/// Another option at pose q, under the same circumstances as `like`, with a random approach.
ReadingOption option_at(const Cell& cell, const Circumstances& circumstances,
                        const Eigen::VectorXd& q, const ReadingOption& like, Random& random);

/// Measured readings, then the options, as one table; what is not measured of the latter is 0.
/// Payloads that no file states are those of the cell.
Measurements with_options(const Cell& cell, const Measurements& measured, const Measurements& usual,
                          const std::vector<ReadingOption>& options,
                          const Circumstances& circumstances);

/// "with a load of 10 kg; arm warm ...": what to do at a reading.
std::string instruction(const Circumstances& circumstances, const ReadingOption& option);

}  // namespace plumb::offline

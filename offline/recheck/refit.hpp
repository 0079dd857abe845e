// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "recheck/evidence.hpp"

namespace plumb::offline::recheck {

/// The run's model in one set-up alone: frame and target of the readings, and what is known of its
/// numbers.
struct LastSetup {
  ArmState state;
  KnownNumbers known;
};

/// The last set-up of a run, which is the one that comparable readings are made in.
/// Throws Failure (kInput, E-RECHECK-RUN) if the cell no longer has all numbers of the run.
LastSetup last_setup(const Run& run);

/// The calibration after these changes: numbers that did not change, and their covariance, stay.
///
/// @param parent   Of the run.
/// @param changes  Those that `judged` is of.
Calibration refitted(const Cell& cell, const Calibration& parent, const LastSetup& before,
                     const std::vector<Change>& changes, const Judged& judged);

/// Names, values and 1 sigma of the numbers of a change in a state.
std::vector<Estimate> estimates_of(const Change& change, const ArmState& state,
                                   const Eigen::VectorXd& std);

}  // namespace plumb::offline::recheck

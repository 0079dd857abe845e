// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "arm/arm_state.hpp"
#include "arm/parameter.hpp"
#include "cell/cell.hpp"
#include "fit/likeness.hpp"
#include "solve/fit_data.hpp"
#include "solve/known_arm.hpp"

namespace plumb::offline {

struct EarlierArm;

/// What follows from an earlier arm and the readings of this one.
struct LikenessJudgement {
  Likeness likeness;
  KnownArm arm;              // posterior of the numbers that both arms have
  double noise_times = 1.0;  // scatter of the readings over data.sigma_m
  double decided = 0.0;      // effective number of these that the readings decide, not the prior
};

/// The posterior, from an earlier arm and the readings of this one, of the numbers that both have.
/// Let d be the true differences of the earlier arm from nominal, which its run estimates as x with
/// covariance C, and T the variance with which arms are built, times a factor with a prior:
///
///   d ~ N(0, T),   this arm ~ N(r d, (1 - r^2) T)
///
/// r = 1 is the same arm, in which one number or the offsets of all joints may have changed; r = 0
/// is an arm that shares only the model with it. Every r, factor and noise is a hypothesis that is
/// weighted by its posterior probability, and the result is mean and covariance of the mixture
/// [Bayesian model averaging, Hoeting et al. 1999]. If the readings cannot decide between
/// hypotheses, the covariance is accordingly large.
///
/// @param data  Its sigmas should be about the RMS residual of the model; its `arm` is not used.
/// @param at    Where the fit is linearised; `parameters` are those that it fits.
/// Throws Failure (kInput, E-FIT-EARLIER) if the arms have no number in common. Cost: 60 eigenvalue
/// decompositions of the size of the shared numbers, 50 ms.
LikenessJudgement judge_likeness(const FitData& data, const ArmState& at,
                                 const std::vector<Parameter>& parameters,
                                 const EarlierArm& earlier);

/// The prior from the earlier arm alone, if this arm differs from it by `spread` times the standard
/// deviation of arms from nominal.
KnownArm known_within(double spread, const FitData& data, const ArmState& at,
                      const std::vector<Parameter>& parameters, const EarlierArm& earlier);

/// Throws Failure (kInput, E-FIT-EARLIER) with the reason if the earlier arm is not of the model of
/// this cell: if its convention, its joints or its nominal rows differ.
void check_same_model(const Cell& cell, const EarlierArm& earlier);

}  // namespace plumb::offline

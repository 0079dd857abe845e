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

struct Judgement {
  Likeness likeness;
  KnownArm arm;              // the shared numbers as both say them together
  double noise_times = 1.0;  // what the readings scatter, in units of data.sigma_m
  double decided = 0.0;      // of the shared numbers, each by how much the readings decide it
};

/// What an earlier arm and the readings say together of the numbers that both have. With d the true
/// differences from nominal of the earlier arm, of which its run knows x = d + error of covariance
/// C, and T the variance with which arms are built, times a factor that the readings choose:
///
///   d ~ N(0, T),   this arm ~ N(r d, (1 - r^2) T)
///
/// r = 1 is the same arm, in which one number or the offsets may have changed, r = 0 an arm that
/// has nothing in common with it but the model. Every r, factor and noise is weighed by what the
/// readings say of it [Bayesian model averaging, Hoeting et al. 1999]: mean and covariance of the
/// mixture of what each of them concludes. So where the readings cannot tell, the result claims no
/// more.
///
/// @param data  With sigmas about as large as the model misses the readings; `arm` plays no part.
/// @param at    Where the fit is linearised; `parameters` are those that it fits.
/// Throws Failure (kInput, E-FIT-EARLIER) if the arms have no number in common, or other nominal
/// ones. Cost: 60 eigenvalue decompositions of the size of the shared numbers, 50 ms.
Judgement judge_likeness(const FitData& data, const ArmState& at,
                         const std::vector<Parameter>& parameters, const EarlierArm& earlier);

/// What is known before any reading is looked at, if this arm differs from the earlier one by
/// `spread` times what arms differ from nominal.
KnownArm known_within(double spread, const FitData& data, const ArmState& at,
                      const std::vector<Parameter>& parameters, const EarlierArm& earlier);

/// Throws Failure (kInput, E-FIT-EARLIER) with the reason if the earlier arm is not of the model of
/// this cell: convention, joints, nominal rows.
void check_same_model(const Cell& cell, const EarlierArm& earlier);

}  // namespace plumb::offline

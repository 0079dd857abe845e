// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnose/whitened_fit.hpp"
#include "noise/joint_scatter.hpp"
#include "noise/repeatability.hpp"

namespace plumb::offline {

/// The fit poses of a whitened fit as lines from which the scatter of the joints is estimated.
/// Readings that follow each other at one pose, the arm standing still, are one stop: they share
/// its scatter, so their lines are added and divided by the root of their number.
ScatterLines scatter_lines(const WhitenedFit& whitened);

/// The same beside further columns of the model, shape (lines of the whitened fit, b).
ScatterLines scatter_lines(const WhitenedFit& whitened, const Eigen::MatrixXd& columns);

/// `whitened` must know of no scatter yet; its nats are not set.
Repeatability repeatability_of(const WhitenedFit& whitened, const JointScatter& scatter);

/// A whitened fit once more, whitened by noise and joint scatter: what moves all coordinates of a
/// point together as a joint would counts less. One pose a stop. `whitened` must know of no scatter
/// yet.
WhitenedFit with_scatter(const WhitenedFit& whitened, const JointScatter& scatter);

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/format/model.hpp"
#include "tree/samples.hpp"

namespace plumb::offline {

/// The box of the joint positions q, shape (n >= 1, joints) [rad] or [m]. The range of a joint that
/// hardly moved is widened to 1e-6, so that q_min < q_max.
format::Domain trained_box(const Samples& q);

/// The number of joints whose range is wider than that minimum.
int moving_joints(const Samples& q);

/// u of every row as the runtime sees it: in [-1, 1], clamped outside. Shape (n, joints).
Samples normalised(const format::Domain& domain, const Samples& q);

/// How far the runtime trusts a tree at every row: 1 inside the box, 0 far outside. Shape (n,).
Eigen::VectorXd trust(const format::Domain& domain, const Samples& q);

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "simulate/planar.hpp"
#include "tree/samples.hpp"

namespace plumb::offline::study {

/// The parameters that the study calibrates: lengths and lateral offsets of both links, d = (L2,
/// L3, v2, v3) [m].
using Links = Eigen::Vector4d;
inline const Links kNominalLinks{kPlanarLink_m, kPlanarLink_m, 0.0, 0.0};

/// Point C of rigid links, eqs. (12) and (13), without (X_A, Y_A). q: (n, 2); shape (n, 2) [m].
Samples rigid_points(const Links& d, const RowsN& q);

/// The derivatives d X / d d and d Y / d d at one pose. The model is linear in d.
Eigen::Matrix<double, 2, 4> links_jacobian(double phi12, double phi23);

}  // namespace plumb::offline::study

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "arm/arm_state.hpp"
#include "arm/parameter.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// What keeps a fit of touched points from making the arm smaller.
///
/// The residual of a touch is the vector from the target to the point. Half the arm, with the
/// points half as far, halves all of them, so that least squares alone would shrink the arm. The
/// reason is that nothing was measured there: the joint readings q are what scatters. With
/// residuals r of variance s^2, the density of the readings is
///
///   p(q) = N(r(q), s^2) sqrt(det(J J^T)),   J = dr/dq
///
/// (J has the lines that the row reads: three of a point, one of a plane or a sphere)
/// and the second factor, the volume that a step of the joints covers, falls as the arm shrinks.
/// Its geometric mean over the touches is kept here as a function of the arm's numbers, linear
/// about the arm where it was computed. Residuals divided by its root, one for each line, have the
/// likelihood's maximum, whatever s is, and do not change when the whole arm grows.
struct TouchDensity {
  std::vector<Parameter> parameters;  // none: no row touches a point
  Eigen::VectorXd slopes;             // of that root, per unit of each
  Eigen::VectorXd at;                 // values of the parameters where it is 1

  bool empty() const { return parameters.empty(); }
  double times(const ArmState& state) const;
  /// Slopes for other parameters, 0 for those that it does not know. Shape (1, parameters).
  Eigen::RowVectorXd slopes_of(const std::vector<Parameter>& others) const;
};

/// About `state`, for the numbers of arm and target among `parameters` and those of where surfaces
/// are; effects are left out. Cost:
/// two evaluations of the chain a parameter and row, on at most 300 of the `rows`.
TouchDensity touch_density(const Measurements& measured, const std::vector<int>& rows,
                           const ArmState& state, const std::vector<Parameter>& parameters);

}  // namespace plumb::offline

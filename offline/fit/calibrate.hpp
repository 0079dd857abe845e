// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "fit/calibration.hpp"

namespace plumb::offline {

/// Calibrates the geometry of `cell` on the given rows: DH with Hayati's beta where neighbours are
/// near parallel (or complete link twists), tracker frame and target, weighted by sigma.
/// Parameters that the poses cannot tell apart are held at nominal, and so are those whose standard
/// deviation would exceed 5 mm or 5 mrad: of a reflector on the last axis, say, or of poses too
/// few. Poses that the others contradict are left out and listed. Throws Failure (kNumbersSayNo)
/// with the reason if it does not converge, if the rows are fewer than the parameters need, or if
/// the result still misses by more than 1 % of the reach: then something else is wrong.
Calibration calibrate(const Cell& cell, const Measurements& measured, const std::vector<int>& rows);

/// The same from a given start, for those who know where tracker and reflector stand.
Calibration calibrate_from(const Cell& cell, const Measurements& measured,
                           const std::vector<int>& rows, const ArmState& start);

/// A neighbour of `from` in a search: other effects, bound in `start`. Takes over which geometry is
/// fitted and which poses are outliers, and solves from where it stands, some ten times faster.
/// What is reported at the end comes from `calibrate_from`.
Calibration calibrate_near(const Cell& cell, const Measurements& measured,
                           const std::vector<int>& rows, const ArmState& start,
                           const Calibration& from);

/// These parameters as they stand in `state` and in `nominal`, with 1 sigma from their covariance.
std::vector<Estimate> estimates_of(const ArmState& state, const ArmState& nominal,
                                   const std::vector<Parameter>& parameters,
                                   const Eigen::MatrixXd& covariance);

/// Every number that a calibration ending in `state` could have fitted, in order of preference:
/// geometry, frame and target, and the parameters of the effects that `state` carries.
std::vector<Parameter> calibration_candidates(const Cell& cell, const Measurements& measured,
                                              const ArmState& state);

/// The nominal arm with only tracker frame and target fitted: what the controller believes today.
ArmState place_nominal(const Cell& cell, const Measurements& measured,
                       const std::vector<int>& rows);

}  // namespace plumb::offline

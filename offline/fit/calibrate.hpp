// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "fit/calibration.hpp"

namespace plumb::offline {

/// Calibrates the geometry of `cell` on the given rows: DH with Hayati's beta where neighbouring
/// axes are nearly parallel (or complete link twists), tracker frame and target, weighted by sigma.
/// Parameters that the poses cannot tell apart are held at nominal, and so are those whose standard
/// deviation would exceed 5 mm or 5 mrad, as with a reflector on the last axis or too few poses.
/// Poses that the others contradict are left out and listed. A fit that does not converge, or ends
/// far from nominal, is made again with all numbers of the arm held near nominal by the prior of
/// the cell, and counts if it explains the poses as well. Throws Failure (kNumbersSayNo) with
/// the reason if the fit does not converge, if there are too few rows for the parameters, or if the
/// RMS residual exceeds 1 % of the reach.
Calibration calibrate(const Cell& cell, const Measurements& measured, const std::vector<int>& rows);

/// The same from a given start, for callers that know where tracker and reflector stand.
Calibration calibrate_from(const Cell& cell, const Measurements& measured,
                           const std::vector<int>& rows, const ArmState& start);

/// A calibration near `from`, for a search that tries other effects, which are bound in `start`. It
/// takes over which geometry is fitted and which poses are outliers, and is some ten times faster.
/// Reported results must come from `calibrate_from`.
Calibration calibrate_near(const Cell& cell, const Measurements& measured,
                           const std::vector<int>& rows, const ArmState& start,
                           const Calibration& from);

/// Values of the parameters in `state` and in `nominal`, with 1 sigma from their covariance.
std::vector<Estimate> estimates_of(const ArmState& state, const ArmState& nominal,
                                   const std::vector<Parameter>& parameters,
                                   const Eigen::MatrixXd& covariance);

/// Every parameter that a calibration with the effects of `state` can fit, in order of preference:
/// frame and target, geometry, and the parameters of these effects.
std::vector<Parameter> calibration_candidates(const Cell& cell, const Measurements& measured,
                                              const ArmState& state);

/// The nominal arm with only tracker frame and target fitted: the model of the controller as it is.
ArmState place_nominal(const Cell& cell, const Measurements& measured,
                       const std::vector<int>& rows);

}  // namespace plumb::offline

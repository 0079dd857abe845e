// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "fit/arm_state.hpp"
#include "fit/known_arm.hpp"
#include "fit/likeness.hpp"
#include "fit/outliers.hpp"
#include "fit/parameter.hpp"

namespace plumb::offline {

/// A fitted number. SI.
struct Estimate {
  std::string name;  // "J2.d", "frame.x", "target.z"
  bool is_length = false;
  bool of_robot = false;  // false: of the measurement, thrown away
  std::string unit = {};  // SI, of an effect's parameter; else empty
  double value = 0.0;     // frame: change from the start, so 0 is not meaningful
  double nominal = 0.0;
  double std = 0.0;  // 1 sigma
};

struct Calibration {
  ArmState state;
  std::vector<Outlier> outliers;    // poses that the others contradict: not fitted, farthest first
  std::vector<Problem> remarks;     // what the numbers look like
  std::vector<Estimate> estimates;  // the identifiable subset, in covariance order
  std::vector<Parameter> parameters;  // the same ones
  std::vector<std::string> held;      // kept at nominal: these poses say less about them
  Eigen::MatrixXd covariance;         // SI
  int rank = 0;                       // independent columns, of all candidates
  double calibrability = 0.0;         // cond_2(J^T J), SI columns
  double series_dof = 0.0;            // of series of waves, see Solution
  double decided = 0.0;               // numbers, each by how much the readings decide it
  std::optional<Likeness> likeness;   // with an earlier arm, if the cell names one
  KnownArm known;                     // what that one says of this
  double sigma0 = 0.0;                // sqrt(chi^2 / dof) of the weighted residuals
  int iterations = 0;
};

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

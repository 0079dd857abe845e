// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// Mean error of models that were fitted to so many poses, at the other readings [m].
struct PosesAndError {
  int poses = 0;
  std::optional<double> alone_m;  // none: too few for a fit
  std::optional<double> with_m;   // with what an earlier run or a fleet taught
};

/// Whether the cell takes over anything: [fit] prior_from, or fit --from.
bool takes_over(const Cell& cell);

/// How many poses does it take? Fits to random choices of `rows`, from eight poses to four fifths
/// of them, the model without trees; several choices of each size, the same for both columns.
/// Cost: some 60 calibrations on few poses, a second for six joints.
std::vector<PosesAndError> error_by_poses(const Cell& cell, const Measurements& measured,
                                          const std::vector<int>& rows);

/// The number of poses that alone reach what `with` reaches at that point, by interpolation of the
/// logarithms; nothing if the curve does not get there.
std::optional<double> poses_alone(const std::vector<PosesAndError>& curve, double with_m);

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// Mean error [m], at readings that were not fitted, of models fitted to this number of poses.
struct PosesAndError {
  int poses = 0;
  std::optional<double> alone_m;  // from these poses alone; none: too few for a fit
  std::optional<double> with_m;   // with the priors of an earlier run or a fleet
};

/// Whether the cell has priors from other arms or runs: [fit] prior_from, or fit --from.
bool takes_over(const Cell& cell);

/// Error of the model without trees against the number of fitted poses: fits to random choices of
/// the poses of `rows`, from eight to four fifths of them, five choices of each size. Both columns
/// use the same choices.
/// Cost: some 60 calibrations on few poses, a second for six joints.
std::vector<PosesAndError> error_by_poses(const Cell& cell, const Measurements& measured,
                                          const std::vector<int>& rows);

/// The number of poses that have the error `with_m` without priors of other arms, by interpolation
/// of the logarithms; nothing if the curve does not reach it.
std::optional<double> poses_alone(const std::vector<PosesAndError>& curve, double with_m);

}  // namespace plumb::offline

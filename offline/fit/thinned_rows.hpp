// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fit/solver.hpp"

namespace plumb::offline {

/// At most `most` of the rows, evenly picked. Set-ups of few readings stay whole, or what is left
/// of them could no longer tell where their tracker stands; so there may be some more.
std::vector<int> thinned(const Measurements& measured, const std::vector<int>& rows, int most);
inline std::vector<int> thinned(const FitData& data, int most) {
  return thinned(*data.measured, data.rows, most);
}

/// The whitened Jacobian of `some` rows of `all`, the lines of each set-up scaled so that it says
/// as much as with all of its rows. Shape as `evaluate`'s.
Eigen::MatrixXd jacobian_for_all(const FitData& all, const FitData& some, const ArmState& state,
                                 const std::vector<Parameter>& parameters);

}  // namespace plumb::offline

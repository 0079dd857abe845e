// SPDX-License-Identifier: Apache-2.0
#include "recheck/visible.hpp"

#include <cmath>

#include "numbers/gaussian.hpp"
#include "numbers/spectrum.hpp"
#include "recheck/constants.hpp"

namespace plumb::offline::recheck {
std::vector<Visibility> visibility(const std::vector<Change>& changes, const Measurements& rows,
                                   const Measurements& own, const ArmState& state,
                                   const Eigen::MatrixXd& S) {
  const Cholesky llt(S);
  std::vector<Visibility> out;
  for (const auto& change : changes) {
    if (change.part == Part::kReading) continue;
    const Eigen::MatrixXd seen =
        llt.whitened(derivatives(rows, state, change.parameters) * change.typical.asDiagonal());
    const Eigen::MatrixXd motion =
        derivatives(own, state, change.parameters) * change.typical.asDiagonal();
    const Eigen::MatrixXd square = motion.transpose() * motion / own.size();
    const double most = largest_generalised_eigenvalue(
        square, with_prior(seen.transpose() * seen, kWidest, kNoticed));
    out.push_back({change, std::sqrt(kNoticed * std::max(0.0, most))});
  }
  return out;
}

}  // namespace plumb::offline::recheck

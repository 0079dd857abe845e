// SPDX-License-Identifier: Apache-2.0
#include "solve/parameter_subset.hpp"

#include <cmath>

#include "cell/artefacts.hpp"
#include "solve/constants.hpp"
#include "solve/scaled_jacobian.hpp"
#include "solve/thinned_rows.hpp"

namespace plumb::offline {
namespace {

/// Size [SI] by which a column is scaled. For a parameter of an effect it is the change that moves
/// the points by 5 mm RMS; `length` is the RMS motion of the points per unit [m/SI].
double plausible_size(const Parameter& p, double length) {
  if (p.of_effect()) return length > 0.0 ? kPlausible_m / length : 1.0;
  // Frame and target may be anywhere; only the arm is known beforehand to be near nominal.
  if (!p.of_robot()) return 1.0;
  return p.is_length() ? kPlausible_m : kPlausible_rad;
}

}  // namespace

ParameterSubset identifiable_parameters(const FitData& data, const ArmState& state,
                                        const std::vector<Parameter>& candidates,
                                        const Identifiability& limits, Size size) {
  FitData thin = data;
  thin.weak = {};  // only the poses count here, not how near nominal an arm is built
  thin.rows = thinned(data, kRankRows);
  Eigen::MatrixXd J = jacobian_for_all(data, thin, state, candidates);
  const double lines = std::sqrt(static_cast<double>(data.residual_count()));
  const double sigma = data.sigma_m.row(thin.rows.front()).mean();
  if (size == Size::kGiven && data.cell != nullptr && lacks_length(*data.cell)) {
    J.conservativeResize(J.rows() + 1, Eigen::NoChange);
    J.bottomRows(1) = data.touches.slopes_of(candidates) * reach(state.arm.calibrated) / sigma;
  }
  for (Eigen::Index k = 0; k < J.cols(); ++k) {
    const double rms = J.col(k).norm() / lines * sigma;
    J.col(k) *= plausible_size(candidates[static_cast<std::size_t>(k)], rms);
  }
  const ColumnSubset subset = identifiable(J, limits);
  ParameterSubset out;
  for (int i : subset.kept) out.kept.push_back(candidates[i]);
  for (int i : subset.dropped) out.held.push_back(candidates[i].name);
  return out;
}

}  // namespace plumb::offline

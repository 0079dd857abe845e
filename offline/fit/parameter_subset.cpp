// SPDX-License-Identifier: Apache-2.0
#include "fit/parameter_subset.hpp"

#include <cmath>

namespace plumb::offline {
namespace {

constexpr int kRankPoses = 4000;         // enough to tell parameters apart
constexpr double kPlausible_m = 5e-3;    // ten typical errors of a DH length
constexpr double kPlausible_rad = 5e-3;  // and angle

Eigen::VectorXd plausible_sizes(const std::vector<Parameter>& parameters) {
  Eigen::VectorXd out(static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    // Frame and target may be anywhere; only the arm is known beforehand.
    const double size = parameters[i].is_length() ? kPlausible_m : kPlausible_rad;
    out(i) = parameters[i].of_robot() ? size : 1.0;
  }
  return out;
}

}  // namespace

ParameterSubset identifiable_parameters(const FitData& data, const ArmState& state,
                                        const std::vector<Parameter>& candidates,
                                        const Identifiability& limits) {
  FitData thin = data;
  thin.rows = thinned(data.rows, kRankPoses);
  const double thinning =
      std::sqrt(static_cast<double>(data.rows.size()) / static_cast<double>(thin.rows.size()));
  const Eigen::MatrixXd J = evaluate(thin, state, candidates).jacobian *
                            plausible_sizes(candidates).asDiagonal() * thinning;
  const Subset subset = identifiable(J, limits);
  ParameterSubset out;
  for (int i : subset.kept) out.kept.push_back(candidates[i]);
  for (int i : subset.dropped) out.held.push_back(candidates[i].name);
  return out;
}

std::vector<int> thinned(const std::vector<int>& rows, int most) {
  if (static_cast<int>(rows.size()) <= most) return rows;
  std::vector<int> out;
  for (int i = 0; i < most; ++i) out.push_back(rows[rows.size() * i / most]);
  return out;
}

}  // namespace plumb::offline

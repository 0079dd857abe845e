// SPDX-License-Identifier: Apache-2.0
#include "solve/descent.hpp"

#include <algorithm>

#include "arm/arm_change.hpp"
#include "numbers/cholesky.hpp"
#include "solve/constants.hpp"
#include "solve/row_sums.hpp"
#include "solve/solution_checks.hpp"
#include "solve/thinned_rows.hpp"

namespace plumb::offline {
namespace {

/// A start is poor if the first step promises to lower the cost by more than this share. It is then
/// improved on so many rows, to this relative fall of the cost: only the time depends on these.
constexpr double kFarFromRest = 0.01;
constexpr std::size_t kFirstRows = 3000;
constexpr double kFirstTolerance = 1e-6;
constexpr double kLeastDamping = 1e-10, kFirstDamping = 1e-4, kMostDamping = 1e8;

/// The damped least-squares step of all parameters. Columns are scaled to unit length first, so
/// that metres and radians are damped alike.
Eigen::VectorXd step_of(const RowSums& at, double damping) {
  const Eigen::VectorXd length = at.information.diagonal().cwiseSqrt();
  const Eigen::VectorXd scale = (length.array() > 0.0).select(length.cwiseInverse(), 0.0);
  Eigen::MatrixXd unit = scale.asDiagonal() * at.information * scale.asDiagonal();
  unit.diagonal().setConstant(1.0 + damping);
  return -(scale.asDiagonal() * SymmetricSolver(unit).solve(scale.asDiagonal() * at.gradient));
}

/// Where Gauss-Newton steps from `state` end, which are damped if they raise the cost
/// (Levenberg-Marquardt).
struct Descent {
  ArmState state;
  RowSums at;
  int steps = 0;
  bool converged = false;
};
Descent descend(const FitData& data, const ArmState& state, RowSums at,
                const std::vector<Parameter>& parameters, double tolerance) {
  Descent out{.state = state, .at = std::move(at)};
  double damping = kLeastDamping, share = 1.0;
  for (; !out.converged && out.steps < kMostIterations && damping < kMostDamping; ++out.steps) {
    const Eigen::VectorXd step = step_of(out.at, damping);
    if (-0.5 * step.dot(out.at.gradient) <= std::max(tolerance * out.at.cost, kNoGain)) {
      out.converged = true;
      break;
    }
    const ArmState next = moved(out.state, parameters, step);
    RowSums there = sums_at(data, next, parameters);
    if (!there.finite() || there.cost > out.at.cost) {
      damping = std::max(10.0 * damping, kFirstDamping);
      continue;
    }
    share = (out.at.cost - there.cost) / out.at.cost;
    out.converged = share < tolerance;
    out.state = next;
    out.at = std::move(there);
    damping = damping > kFirstDamping ? 0.1 * damping : kLeastDamping;
  }
  out.converged = out.converged || share < kNoChange;
  return out;
}

}  // namespace

Eigen::MatrixXd triangle_of(const Eigen::MatrixXd& information) {
  const Eigen::VectorXd length = information.diagonal().cwiseSqrt().cwiseMax(1e-300);
  const Eigen::VectorXd scale = length.cwiseInverse();
  Eigen::MatrixXd unit = scale.asDiagonal() * information * scale.asDiagonal();
  unit.diagonal().setConstant(1.0 + kLeastDamping);
  return Cholesky(unit).lower().transpose() * length.asDiagonal();
}

namespace {

/// Moves `state` to a solution on a part of the rows and returns the sums over all rows there. If
/// the cost of all rows is no lower there, `state` stays and `here` is returned.
RowSums sums_nearer(const FitData& data, const std::vector<Parameter>& parameters, ArmState& state,
                    RowSums here) {
  FitData few = data;
  few.rows = thinned(data, static_cast<int>(kFirstRows));
  const Descent first =
      descend(few, state, sums_at(few, state, parameters), parameters, kFirstTolerance);
  RowSums there = sums_at(data, first.state, parameters);
  if (!there.finite() || there.cost > here.cost) return here;
  state = first.state;
  return there;
}

}  // namespace

Solution solve_many(const FitData& data, const ArmState& start,
                    const std::vector<Parameter>& parameters, double tolerance) {
  Solution out;
  out.state = start;
  RowSums here = sums_at(data, start, parameters);
  if (const auto& [row, effect] = here.undefined; row >= 0)
    refuse_undefined(data, start.arm.effects[static_cast<std::size_t>(effect)], row);
  const double promised = -0.5 * step_of(here, kLeastDamping).dot(here.gradient);
  if (promised > kFarFromRest * here.cost && data.rows.size() > 2 * kFirstRows)
    here = sums_nearer(data, parameters, out.state, std::move(here));
  Descent all = descend(data, out.state, std::move(here), parameters, tolerance);
  out.state = std::move(all.state);
  out.residual = std::move(all.at.residual);
  out.jacobian = triangle_of(all.at.information);
  out.cost = all.at.cost;
  out.iterations = all.steps;
  out.converged = all.converged;
  out.reason = "the residuals still change with every step";
  return out;
}

}  // namespace plumb::offline

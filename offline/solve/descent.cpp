// SPDX-License-Identifier: Apache-2.0
#include "solve/descent.hpp"

#include <algorithm>

#include "arm/arm_change.hpp"
#include "numbers/cholesky.hpp"
#include "solve/row_sums.hpp"
#include "solve/solution_checks.hpp"
#include "solve/thinned_rows.hpp"

namespace plumb::offline {
namespace {

constexpr double kDescentNoChange = 1e-7;  // of the cost in the last iteration
constexpr int kMostDescentSteps = 300;     // weakly observable parameters converge slowly
constexpr std::size_t kFirstRows = 3000;   // rows on which a poor start is improved
constexpr double kFirstTolerance = 1e-6;
constexpr double kFarFromRest = 0.01;  // share of the cost to be gained at a poor start
constexpr double kNoStep = 1e-6;       // of cost to be gained: a thousandth of a standard deviation
constexpr double kLeastDamping = 1e-10, kFirstDamping = 1e-4, kMostDamping = 1e8;

/// The damped least-squares step of all parameters. Columns are scaled to unit length first, so
/// that metres and radians are damped alike.
Eigen::VectorXd step_of(const Sums& at, double damping) {
  const Eigen::VectorXd length = at.information.diagonal().cwiseSqrt();
  const Eigen::VectorXd scale = (length.array() > 0.0).select(length.cwiseInverse(), 0.0);
  Eigen::MatrixXd unit = scale.asDiagonal() * at.information * scale.asDiagonal();
  unit.diagonal().setConstant(1.0 + damping);
  return -(scale.asDiagonal() * SymmetricSolver(unit).solve(scale.asDiagonal() * at.gradient));
}

/// Gauss-Newton steps from `state`, damped if they raise the cost (Levenberg-Marquardt).
struct Descent {
  ArmState state;
  Sums at;
  int steps = 0;
  bool converged = false;
};
Descent descend(const FitData& data, const ArmState& state, Sums at,
                const std::vector<Parameter>& parameters, double tolerance) {
  Descent out{.state = state, .at = std::move(at)};
  double damping = kLeastDamping, share = 1.0;
  for (; !out.converged && out.steps < kMostDescentSteps && damping < kMostDamping; ++out.steps) {
    const Eigen::VectorXd step = step_of(out.at, damping);
    if (-0.5 * step.dot(out.at.gradient) <= std::max(tolerance * out.at.cost, kNoStep)) {
      out.converged = true;
      break;
    }
    const ArmState next = moved(out.state, parameters, step);
    Sums there = sums_at(data, next, parameters);
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
  // Two parameters with nearly the same effect need not converge to the last digit.
  out.converged = out.converged || share < kDescentNoChange;
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

/// Improves `state` by a solution on a part of the rows. Returns the sums over all rows there, or
/// `here` if that is no better.
Sums sums_nearer(const FitData& data, const std::vector<Parameter>& parameters, ArmState& state,
                 Sums here) {
  FitData few = data;
  few.rows = thinned(data, static_cast<int>(kFirstRows));
  const Descent first =
      descend(few, state, sums_at(few, state, parameters), parameters, kFirstTolerance);
  Sums there = sums_at(data, first.state, parameters);
  if (!there.finite() || there.cost > here.cost) return here;
  state = first.state;
  return there;
}

}  // namespace

Solution solve_many(const FitData& data, const ArmState& start,
                    const std::vector<Parameter>& parameters, double tolerance) {
  Solution out;
  out.state = start;
  Sums here = sums_at(data, start, parameters);
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

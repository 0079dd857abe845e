// SPDX-License-Identifier: Apache-2.0
#include "check/regularised_fit.hpp"

#include <algorithm>
#include <cmath>

#include "arm/arm_change.hpp"
#include "arm/predicted_points.hpp"
#include "check/constants.hpp"
#include "effects/registry.hpp"
#include "fit/calibrate.hpp"
#include "numbers/cholesky.hpp"
#include "numbers/rotation_fit.hpp"
#include "solve/evaluation.hpp"

namespace plumb::offline {
namespace {

/// Steps of a fit, which ends where one lowers the cost by less than this share.
constexpr int kMostSteps = 15;
constexpr double kEnoughFall = 1e-4;

FitData unweighted(const Measurements& measured, const std::vector<int>& rows) {
  FitData data;
  data.measured = &measured;
  data.rows = rows;
  data.sigma_m = Rows3::Ones(measured.size(), 3);
  return data;
}

/// The parameters of frame and target, whatever the cell says of them, and those of the geometry if
/// the arm is fitted as well.
std::vector<Parameter> parameters_of(const Cell& cell, bool with_arm) {
  Cell free;
  free.nominal = cell.nominal;
  free.mechanics = cell.mechanics;
  free.effects = {{.name = geometry_effect(), .joints = {}, .options = {}, .place = {}}};
  auto out = candidate_parameters(free, Orientation::kIgnored);
  if (!with_arm) std::erase_if(out, [](const Parameter& p) { return p.of_robot(); });
  return out;
}

/// Sum of squares of the residuals and of the parameters' changes from nominal, each over its
/// variance, multiplied by that of a coordinate.
class PulledFit {
 public:
  PulledFit(const FitData& data, const ArmState& nominal, const std::vector<Parameter>& parameters)
      : data_(data), nominal_(nominal), parameters_(parameters) {
    const auto count = static_cast<Eigen::Index>(parameters.size());
    weight_ = Eigen::VectorXd::Zero(count);
    for (Eigen::Index i = 0; i < count; ++i)
      if (parameters[i].of_robot())
        weight_(i) = check::kCoordinate_m /
                     (parameters[i].is_length() ? check::kNearNominal_m : check::kNearNominal_rad);
  }

  Eigen::VectorXd change(const ArmState& state) const {
    Eigen::VectorXd out(weight_.size());
    for (Eigen::Index i = 0; i < out.size(); ++i)
      out(i) = weight_(i) > 0.0
                   ? value_of(state, parameters_[i]) - value_of(nominal_, parameters_[i])
                   : 0.0;
    return out;
  }

  /// The largest change of the arm, in sigma.
  double strain(const ArmState& state) const {
    return change(state).cwiseProduct(weight_).cwiseAbs().maxCoeff() / check::kCoordinate_m;
  }

  double cost(const ArmState& state) const {
    return evaluate(data_, state, {}).residual.squaredNorm() +
           change(state).cwiseProduct(weight_).squaredNorm();
  }

  /// Gauss-Newton step with damping; false if it cannot be taken.
  bool step(ArmState& state, double& cost_now, double& damping) const {
    const Solution here = evaluate(data_, state, parameters_);
    const Eigen::VectorXd w2 = weight_.array().square();
    Eigen::MatrixXd N = here.jacobian.transpose() * here.jacobian;
    N.diagonal() += w2;
    const Eigen::VectorXd g =
        here.jacobian.transpose() * here.residual - w2.cwiseProduct(change(state));
    const double floor = 1e-12 * N.diagonal().maxCoeff();
    for (int attempt = 0; attempt < 8; ++attempt, damping *= 10.0) {
      Eigen::MatrixXd damped = N;
      damped.diagonal() += (damping * N.diagonal()).array().max(floor).matrix();
      const ArmState next = moved(state, parameters_, SymmetricSolver(damped).solve(g));
      const double cost_next = cost(next);
      if (!(cost_next < cost_now)) continue;
      const bool worth = cost_now - cost_next > kEnoughFall * cost_now;
      state = next;
      cost_now = cost_next;
      damping *= 0.1;
      return worth;
    }
    return false;
  }

 private:
  const FitData& data_;
  const ArmState& nominal_;
  const std::vector<Parameter>& parameters_;
  Eigen::VectorXd weight_;
};

RegularisedFit solved_once(const Cell& cell, const Measurements& measured,
                           const std::vector<int>& rows, const ArmState& start, bool with_arm) {
  const FitData data = unweighted(measured, rows);
  const auto parameters = parameters_of(cell, with_arm);
  ArmState nominal;
  nominal.arm.calibrated = cell.nominal;
  const PulledFit problem(data, nominal, parameters);
  RegularisedFit out{start, 0.0};
  double cost = problem.cost(start), damping = 1e-6;
  for (int i = 0; i < kMostSteps && problem.step(out.state, cost, damping); ++i) {
  }
  if (with_arm && problem.strain(out.state) > check::kAnotherArm) out.state = start;
  const double squares = evaluate(data, out.state, {}).residual.squaredNorm();
  out.rms_m = std::sqrt(squares / static_cast<double>(rows.size()));
  return out;
}

/// The rows but for the few that stand out by far.
std::vector<int> without_outliers(const Measurements& measured, const std::vector<int>& rows,
                                  const ArmState& state) {
  const Measurements some = pick(measured, rows);
  const Eigen::VectorXd left = residuals(some, predict_points(state, some.q)).rowwise().norm();
  std::vector<double> sorted(left.data(), left.data() + left.size());
  std::sort(sorted.begin(), sorted.end());
  const auto n = sorted.size();
  const auto spared = static_cast<std::size_t>(check::kLeftOutShare * static_cast<double>(n));
  const double limit = std::max(check::kOffMedians * sorted[n / 2], sorted[n - 1 - spared]);
  std::vector<int> out;
  for (std::size_t i = 0; i < n; ++i)
    if (left(static_cast<Eigen::Index>(i)) <= limit) out.push_back(rows[i]);
  return out;
}

RegularisedFit solved(const Cell& cell, const Measurements& measured, std::vector<int> rows,
                      const ArmState& start, bool with_arm) {
  RegularisedFit out = solved_once(cell, measured, rows, start, with_arm);
  for (int round = 0; round < check::kLeftOutRounds; ++round) {
    const auto fewer = without_outliers(measured, rows, out.state);
    if (fewer.size() == rows.size()) break;
    rows = fewer;
    out = solved_once(cell, measured, rows, out.state, with_arm);
  }
  return out;
}

}  // namespace

RegularisedFit robust_placement(const Cell& cell, const Measurements& measured,
                                const std::vector<int>& rows, const ArmState& start) {
  return solved(cell, measured, rows, start, false);
}

RegularisedFit placed_from_the_labels(const Cell& cell, const Measurements& measured,
                                      const std::vector<int>& rows) {
  const ArmState by_fit = place_nominal(cell, measured, rows);
  ArmState start;
  start.arm.calibrated = cell.nominal;
  start.X_MB = by_fit.X_MB;
  start.X_TG = by_fit.X_TG;
  return robust_placement(cell, measured, rows, start);
}

RegularisedFit regularised_fit(const Cell& cell, const Measurements& measured,
                               const std::vector<int>& rows, const ArmState& placed) {
  return solved(cell, measured, rows, placed, true);
}

ArmState state_near(const Cell& cell, const Measurements& measured, const std::vector<int>& rows,
                    const Eigen::Matrix3d& M, const Eigen::Vector3d& target_T) {
  ArmState out;
  out.arm.calibrated = cell.nominal;
  for (int k = 0; k < 3; ++k) out.X_TG.p[k] = target_T(k);
  Transformd X_MB;
  X_MB.R = nearest_rotation(M).transpose();
  out.X_MB = to_pose(X_MB);
  const Measurements some = pick(measured, rows);
  const Rows3 shift = residuals(some, predict_points(out, some.q));
  const Eigen::RowVector3d mean = shift.colwise().mean();
  for (int k = 0; k < 3; ++k) out.X_MB.p[k] = mean(k);
  return out;
}

}  // namespace plumb::offline

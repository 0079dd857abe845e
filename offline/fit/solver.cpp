// SPDX-License-Identifier: Apache-2.0
#include "fit/solver.hpp"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/arm_change.hpp"
#include "fit/descent.hpp"
#include "fit/fit_judgement.hpp"
#include "fit/geometry_derivative.hpp"
#include "fit/many_rows.hpp"
#include "fit/pose_lines.hpp"
#include "fit/prior_lines.hpp"
#include "fit/series_solver.hpp"
#include "numbers/jobs.hpp"

namespace plumb::offline {
namespace {

constexpr double kNoChange = 1e-7;      // of the cost in the last iteration
constexpr double kDenseQrUpTo = 2e5;    // numbers; beyond it the normal equations are much faster
constexpr int kMostIterations = 300;    // weakly observable parameters converge slowly
constexpr int kPatience = 50;           // iterations before predictions alone are judged
constexpr int kLookBack = 10;           // iterations over which they are
constexpr double kAtRest = 3e-3;        // of the noise: predictions that move no more have settled
constexpr double kNearlyAtRest = 3e-2;  // the same, where the last iteration is reached
constexpr int kRowsOfOneThread = 256;   // rows evaluated by one thread in one go
constexpr double kManyNumbers = 1.5e6;  // in a Jacobian: beyond it only sums are kept

/// RMS motion of the predictions, in standard deviations of the noise, that goes with a fall of
/// the cost near its minimum, where cost - least cost = |J dx|^2 / 2.
double motion_of(double cost_fall, double cost, int residuals) {
  const double n = std::max(1, residuals);
  const double scatter = std::max(1.0, std::sqrt(2.0 * cost / n));
  return std::sqrt(2.0 * std::max(0.0, cost_fall) / n) / scatter;
}

/// Ends a solution whose predictions have come to rest.
class PredictionsAtRest final : public ceres::IterationCallback {
 public:
  explicit PredictionsAtRest(int residuals) : residuals_(residuals) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& now) override {
    costs_.push_back(now.cost);
    return now.iteration >= kPatience && recent_motion() < kAtRest
               ? ceres::SOLVER_TERMINATE_SUCCESSFULLY
               : ceres::SOLVER_CONTINUE;
  }

  double recent_motion() const {
    if (costs_.size() <= kLookBack) return std::numeric_limits<double>::infinity();
    return motion_of(costs_[costs_.size() - 1 - kLookBack] - costs_.back(), costs_.back(),
                     residuals_);
  }

 private:
  int residuals_;
  std::vector<double> costs_;
};

/// All poses as one residual block, so the chain is folded once an evaluation.
class GeometryCost final : public ceres::CostFunction {
 public:
  GeometryCost(const FitData& data, const ArmState& start, const std::vector<Parameter>& parameters)
      : data_(data),
        start_(start),
        parameters_(parameters),
        poses_(data, parameters),
        priors_(data, start, parameters) {
    set_num_residuals(data.residual_count() + priors_.count());
    mutable_parameter_block_sizes()->push_back(static_cast<int>(parameters.size()));
  }

  bool Evaluate(double const* const* x, double* residual, double** jacobians) const override {
    const auto count = static_cast<Eigen::Index>(parameters_.size());
    const Eigen::VectorXd change = Eigen::Map<const Eigen::VectorXd>(x[0], count);
    double* const jacobian = jacobians == nullptr ? nullptr : jacobians[0];
    // Values alone cost a fraction of the columns.
    const GeometryDerivative geometry =
        jacobian != nullptr ? GeometryDerivative(start_, parameters_, change)
                            : GeometryDerivative(moved(start_, parameters_, change), {}, {});
    const int rows = static_cast<int>(data_.rows.size()), lines = data_.per_pose();
    const int blocks = (rows + kRowsOfOneThread - 1) / kRowsOfOneThread;
    std::vector<PoseLines::Undefined> undefined(static_cast<std::size_t>(blocks));
    const auto evaluate_block = [&](int block) {
      const int first = block * kRowsOfOneThread;
      const Eigen::Index line = static_cast<Eigen::Index>(first) * lines;
      undefined[static_cast<std::size_t>(block)] =
          poses_.evaluate(geometry, first, std::min(rows, first + kRowsOfOneThread),
                          residual + line, jacobian == nullptr ? nullptr : jacobian + line * count);
    };
    run_jobs(blocks, evaluate_block);
    for (const auto& one : undefined)
      if (one.row >= 0) {
        undefined_ = one;
        return false;
      }
    const Eigen::Index line = static_cast<Eigen::Index>(rows) * lines;
    priors_.evaluate(geometry.state(), residual + line,
                     jacobian == nullptr ? nullptr : jacobian + line * count);
    return std::all_of(residual, residual + num_residuals(),
                       [](double r) { return std::isfinite(r); });
  }

  /// Of the last evaluation.
  const PoseLines::Undefined& undefined() const { return undefined_; }

 private:
  const FitData& data_;
  const ArmState& start_;
  const std::vector<Parameter>& parameters_;
  PoseLines poses_;
  PriorLines priors_;
  mutable PoseLines::Undefined undefined_;
};

}  // namespace

bool is_many(const FitData& data, const std::vector<Parameter>& parameters) {
  return static_cast<double>(data.residual_count()) * static_cast<double>(parameters.size()) >
         kManyNumbers;
}

int FitData::per_pose() const {
  int axes = sigma_rad > 0.0 ? 3 : 0;
  for (bool has : measured->has_axis) axes += has ? 1 : 0;
  return axes;
}

int FitData::residual_count() const { return static_cast<int>(rows.size()) * per_pose(); }

Solution evaluate(const FitData& data, const ArmState& start,
                  const std::vector<Parameter>& parameters) {
  const GeometryCost cost(data, start, parameters);
  const auto count = static_cast<Eigen::Index>(parameters.size());
  Solution out;
  out.state = start;
  out.residual.resize(cost.num_residuals());
  RowMajorMatrix jacobian(cost.num_residuals(), count);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(count);
  const double* x = zero.data();
  double* j = jacobian.data();
  cost.Evaluate(&x, out.residual.data(), count > 0 ? &j : nullptr);
  if (const auto& [row, effect] = cost.undefined(); row >= 0)
    refuse_undefined(data, start.arm.effects[static_cast<std::size_t>(effect)], row);
  out.jacobian = -jacobian;
  out.cost = 0.5 * out.residual.squaredNorm();
  out.converged = true;
  return out;
}

void visit_jacobian(const FitData& data, const ArmState& state,
                    const std::vector<Parameter>& parameters,
                    const std::function<void(int, const RowMajorMatrix&)>& visit) {
  const PoseLines poses(data, parameters);
  const auto count = static_cast<Eigen::Index>(parameters.size());
  const GeometryDerivative geometry(state, parameters, Eigen::VectorXd::Zero(count));
  const int rows = static_cast<int>(data.rows.size()), lines = data.per_pose();
  const auto visit_block = [&](int block) {
    const int first = block * kRowsOfOneThread, last = std::min(rows, first + kRowsOfOneThread);
    Eigen::VectorXd residual(Eigen::Index{last - first} * lines);
    RowMajorMatrix J(residual.size(), count);
    const auto [row, effect] = poses.evaluate(geometry, first, last, residual.data(), J.data());
    if (row >= 0) refuse_undefined(data, state.arm.effects[static_cast<std::size_t>(effect)], row);
    visit(first, J);
  };
  run_jobs((rows + kRowsOfOneThread - 1) / kRowsOfOneThread, visit_block);
}

Solution solve(const FitData& data, const ArmState& start, const std::vector<Parameter>& parameters,
               double tolerance) {
  if (data.series && has_series(start))
    return solve_with_series(data, start, parameters, tolerance);
  if (parameters.empty()) return evaluate(data, start, parameters);
  if (is_many(data, parameters)) return solve_many(data, start, parameters, tolerance);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(parameters.size()));
  GeometryCost cost(data, start, parameters);
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  problem.AddResidualBlock(&cost, nullptr, x.data());
  ceres::Solver::Options options;
  const double size = static_cast<double>(data.residual_count()) * static_cast<double>(x.size());
  options.linear_solver_type = size > kDenseQrUpTo ? ceres::DENSE_NORMAL_CHOLESKY : ceres::DENSE_QR;
  options.max_num_iterations = kMostIterations;
  options.function_tolerance = tolerance;
  options.parameter_tolerance = 1e-14;
  options.gradient_tolerance = 1e-16;
  options.logging_type = ceres::SILENT;
  PredictionsAtRest at_rest(data.residual_count());
  options.callbacks.push_back(&at_rest);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  // Where the start has no finite value there is nothing to climb from.
  if (summary.iterations.empty()) {
    Solution none;
    none.reason = summary.message;
    check_converged(none);
  }
  Solution out = evaluate(data, moved(start, parameters, x), parameters);
  out.iterations = static_cast<int>(summary.iterations.size()) - 1;
  // Two parameters with nearly the same effect need not converge to the last digit.
  const auto& last = summary.iterations.back();
  out.converged = summary.termination_type == ceres::CONVERGENCE ||
                  summary.termination_type == ceres::USER_SUCCESS ||
                  std::abs(last.cost_change) < kNoChange * last.cost ||
                  at_rest.recent_motion() < kNearlyAtRest;
  out.reason = summary.message;
  return out;
}

}  // namespace plumb::offline

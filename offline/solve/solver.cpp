// SPDX-License-Identifier: Apache-2.0
#include "solve/solver.hpp"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "arm/arm_change.hpp"
#include "solve/constants.hpp"
#include "solve/descent.hpp"
#include "solve/evaluation.hpp"
#include "solve/fit_lines.hpp"
#include "solve/many_rows.hpp"
#include "solve/predictions_at_rest.hpp"
#include "solve/series_solver.hpp"
#include "solve/solution_checks.hpp"

namespace plumb::offline {
namespace {

/// Numbers of a Jacobian up to which QR is used; beyond, the normal equations are much faster.
constexpr double kDenseQrUpTo = 2e5;
/// Ends a solution once its predictions have come to rest.
class EndAtRest final : public ceres::IterationCallback {
 public:
  explicit EndAtRest(int residuals) : predictions_(residuals) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& now) override {
    predictions_.add(now.cost);
    return predictions_.may_end() ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

  const PredictionsAtRest& predictions() const { return predictions_; }

 private:
  PredictionsAtRest predictions_;
};

/// The lines of a fit as Ceres asks for them, in one block.
class AllLines final : public ceres::CostFunction {
 public:
  AllLines(const FitData& data, const ArmState& start, const std::vector<Parameter>& parameters)
      : lines_(data, start, parameters), parameters_(static_cast<int>(parameters.size())) {
    set_num_residuals(lines_.count());
    mutable_parameter_block_sizes()->push_back(parameters_);
  }

  bool Evaluate(double const* const* x, double* residual, double** jacobians) const override {
    return lines_.evaluate(Eigen::Map<const Eigen::VectorXd>(x[0], parameters_), residual,
                           jacobians == nullptr ? nullptr : jacobians[0]);
  }

 private:
  FitLines lines_;
  int parameters_;
};

}  // namespace

Solution solve(const FitData& data, const ArmState& start, const std::vector<Parameter>& parameters,
               double tolerance) {
  if (data.series && has_series(start))
    return solve_with_series(data, start, parameters, tolerance);
  if (parameters.empty()) return evaluate(data, start, parameters);
  if (is_many(data, parameters)) return solve_many(data, start, parameters, tolerance);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(parameters.size()));
  AllLines cost(data, start, parameters);
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
  FLAGS_minloglevel = google::GLOG_FATAL;  // a solution that fails is told by us
  EndAtRest at_rest(data.residual_count());
  options.callbacks.push_back(&at_rest);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  // Ceres makes no iteration if a residual is not finite at the start.
  if (summary.iterations.empty()) {
    Solution none;
    none.reason = summary.message;
    check_converged(none);
  }
  Solution out = evaluate(data, moved(start, parameters, x), parameters);
  out.iterations = static_cast<int>(summary.iterations.size()) - 1;
  const auto& last = summary.iterations.back();
  out.converged = summary.termination_type == ceres::CONVERGENCE ||
                  summary.termination_type == ceres::USER_SUCCESS ||
                  std::abs(last.cost_change) < kNoChange * last.cost ||
                  at_rest.predictions().nearly();
  out.reason = summary.message;
  return out;
}

}  // namespace plumb::offline

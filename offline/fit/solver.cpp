// SPDX-License-Identifier: Apache-2.0
#include "fit/solver.hpp"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

#include "fit/arm_change.hpp"
#include "fit/effect_binding.hpp"
#include "fit/fit_judgement.hpp"
#include "fit/geometry_derivative.hpp"

namespace plumb::offline {
namespace {

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr double kNoChange = 1e-7;    // of the cost in the last iteration
constexpr double kDenseQrUpTo = 2e5;  // numbers; beyond it the normal equations are much faster
constexpr int kMostIterations = 300;  // what is hardly seen comes to rest slowly

/// A parameter of which something is known beforehand.
struct KnownParameter {
  enum class Tail { kNormal, kHeavy };
  Eigen::Index index;  // among those fitted
  double mean, sigma;
  Tail tail;
};
using Tail = KnownParameter::Tail;

/// What a distance of u sigma from the mean adds to the residuals, and its slope. Heavy: Huber's,
///
///   u^2 / 2 up to one sigma, |u| - 1/2 beyond
///
/// so that what is hardly seen stays small, what the poses clearly show may be as large as it is,
/// and there is one best fit.
struct Pull {
  double residual, slope;
};
Pull pull_of(double u, Tail tail) {
  if (tail == Tail::kNormal || std::abs(u) <= 1.0) return {u, 1.0};
  const double length = std::sqrt(2.0 * std::abs(u) - 1.0);
  return {std::copysign(length, u), 1.0 / length};
}

constexpr double kWidePrior = 5.0;     // typical sizes
constexpr double kTrackerPrior = 1.0;  // its scale is hardly to be told from the arm's

/// What the cell says, and of effects: that they are rarely many times their typical size. Without
/// it, what geometry nearly imitates (the scale of a tracker) would run away.
std::vector<KnownParameter> known(const FitData& data, const ArmState& start,
                                  const std::vector<Parameter>& parameters) {
  std::vector<KnownParameter> out;
  if (data.cell == nullptr) return out;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (!parameters[i].of_effect()) continue;
    const auto& [joint, component] = std::pair(parameters[i].joint, parameters[i].component);
    const double typical = effect_parameter(start.arm, joint, component).typical;
    const format::Effect& effect = start.arm.effects[joint];
    const double width = effect.name == "tracker" ? kTrackerPrior : kWidePrior;
    const double mean =
        effect.formula.code.empty() ? 0.0 : effect.formula.parameters[component].start;
    if (typical > 0.0)
      out.push_back({static_cast<Eigen::Index>(i), mean, width * typical, Tail::kHeavy});
  }
  ArmState nominal;
  nominal.arm.calibrated = data.cell->nominal;
  for (const auto& [name, sigma] : data.cell->fit.priors)
    for (std::size_t i = 0; i < parameters.size(); ++i)
      if (parameters[i].name == name)
        out.push_back(
            {static_cast<Eigen::Index>(i), value_of(nominal, parameters[i]), sigma, Tail::kNormal});
  return out;
}

/// All poses as one residual block, so the chain is folded once an evaluation.
class GeometryCost final : public ceres::CostFunction {
 public:
  GeometryCost(const FitData& data, const ArmState& start, const std::vector<Parameter>& parameters)
      : data_(data),
        start_(start),
        parameters_(parameters),
        known_(known(data, start, parameters)) {
    set_num_residuals(data.residual_count() + static_cast<int>(known_.size()));
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
    GeometryDerivative::Point point;
    Eigen::Index row = 0;
    const auto emit = [&](double error, double sigma, int column_row) {
      residual[row] = error / sigma;
      if (jacobian != nullptr)
        Eigen::Map<Eigen::RowVectorXd>(jacobian + row * count, count) =
            point.columns.row(column_row) / -sigma;
      ++row;
    };
    const auto& m = *data_.measured;
    const bool departed = m.departure_B.rows() > 0;
    const bool has_effects = !geometry.state().arm.effects.empty();
    const Transformd X_MB = from_pose(geometry.state().X_MB);
    for (int i : data_.rows) {
      geometry.evaluate({m.q.row(i).data(), static_cast<std::size_t>(m.q.cols())},
                        has_effects ? context_of(m, i, geometry.sensors(), X_MB) : Context{}, point,
                        departed ? Vector3(m.departure_B.row(i)) : Vector3::Zero());
      if (point.undefined >= 0) {
        undefined_ = {i, point.undefined};
        return false;
      }
      for (int k = 0; k < 3; ++k)
        if (m.has_axis[k]) emit(m.p_M(i, k) - point.p_M(k), data_.sigma_m(i, k), k);
      if (data_.sigma_rad <= 0.0) continue;
      const auto quat = m.quat_M.row(i);
      const Matrix3 R_MG = from_pose({{}, {quat(0), quat(1), quat(2), quat(3)}}).R;
      const Vector3 turn = rotation_vector(R_MG * point.R_MG.transpose());
      for (int k = 0; k < 3; ++k) emit(turn(k), data_.sigma_rad, 3 + k);
    }
    for (const auto& [index, mean, sigma, tail] : known_) {
      const Pull pull =
          pull_of((mean - value_of(geometry.state(), parameters_[index])) / sigma, tail);
      residual[row] = pull.residual;
      if (jacobian != nullptr) {
        Eigen::Map<Eigen::RowVectorXd> slopes(jacobian + row * count, count);
        slopes.setZero();
        slopes(index) = -pull.slope / sigma;
      }
      ++row;
    }
    return std::all_of(residual, residual + row, [](double r) { return std::isfinite(r); });
  }

  /// The row and the effect that had no value when last evaluated; -1 if all had.
  struct Undefined {
    int row = -1, effect = -1;
  };
  const Undefined& undefined() const { return undefined_; }

 private:
  const FitData& data_;
  const ArmState& start_;
  const std::vector<Parameter>& parameters_;
  std::vector<KnownParameter> known_;
  mutable Undefined undefined_;
};

}  // namespace

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

Solution solve(const FitData& data, const ArmState& start, const std::vector<Parameter>& parameters,
               double tolerance) {
  if (parameters.empty()) return evaluate(data, start, parameters);
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
  // Two parameters that do nearly the same make the last digits slow, and nobody needs them.
  const auto& last = summary.iterations.back();
  out.converged = summary.termination_type == ceres::CONVERGENCE ||
                  std::abs(last.cost_change) < kNoChange * last.cost;
  out.reason = summary.message;
  return out;
}

}  // namespace plumb::offline

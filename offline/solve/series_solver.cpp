// SPDX-License-Identifier: Apache-2.0
#include "solve/series_solver.hpp"

#include <algorithm>
#include <cmath>

#include "arm/arm_change.hpp"
#include "effects/registry.hpp"
#include "numbers/gaussian.hpp"
#include "numbers/products.hpp"
#include "plumb/runtime/chain.hpp"
#include "solve/constants.hpp"
#include "solve/descent.hpp"
#include "solve/evaluation.hpp"
#include "solve/many_rows.hpp"
#include "solve/predictions_at_rest.hpp"
#include "solve/series_numbers.hpp"

namespace plumb::offline {
namespace {

/// Steps after which the damping of one step is kept for the next: what still raises the cost by
/// undamped steps does so again and again.
constexpr int kUndampedSeriesSteps = 30;
constexpr double kSeriesDamping = 1e-10, kFirstSeriesDamping = 1e-4, kMostSeriesDamping = 1e4;
/// The normal equations are computed anew after a step that lowers the cost by less than this share
/// of what it promised. Affects the time only.
constexpr double kAsPromised = 0.5;

/// One state with its residuals, and the derivatives by the parameters and by the joints.
struct SeriesPoint {
  ArmState state;
  Eigen::VectorXd residual;      // whitened residuals, then the priors of the parameters
  Eigen::MatrixXd J = {};        // of the parameters, shape (lines and priors, parameters)
  Eigen::MatrixXd joint = {};    // of the joints that have a series, shape (lines, series)
  Eigen::VectorXd numbers = {};  // of all series
  double cost = 0.0;
};

class SeriesProblem {
 public:
  SeriesProblem(const FitData& data, const ArmState& start,
                const std::vector<Parameter>& parameters)
      : data_(data),
        parameters_(parameters),
        with_joints_(parameters),
        series_(series_numbers(start.arm)),
        poses_(static_cast<Eigen::Index>(data.rows.size())),
        table_(data.line_table()) {
    data_.series = false;
    Eigen::Index count = 0;
    for (const auto& one : series_) count += one.count;
    sigma_.resize(count);
    Eigen::VectorXd q(poses_);
    count = 0;
    for (const auto& one : series_) {
      with_joints_.push_back({Parameter::Kind::kTheta, one.joint, 0, ""});
      for (Eigen::Index i = 0; i < poses_; ++i)
        q(i) = data.measured->q(data.rows[static_cast<std::size_t>(i)], one.joint);
      waves_.push_back(series_waves(q, one.count));
      sigma_.segment(count, one.count) = one.sigma;
      count += one.count;
    }
  }

  Eigen::Index count() const { return static_cast<Eigen::Index>(parameters_.size()); }
  Eigen::Index numbers() const { return sigma_.size(); }
  const Eigen::VectorXd& sigma() const { return sigma_; }

  SeriesPoint at(const ArmState& state) const {
    Solution here = evaluate(data_, state, with_joints_);
    SeriesPoint out{.state = state, .residual = std::move(here.residual)};
    out.J = here.jacobian.leftCols(count());
    out.joint =
        here.jacobian.topRightCorner(table_.lines(), static_cast<Eigen::Index>(series_.size()));
    const Chain chain(state.arm.calibrated);
    for (std::size_t s = 0; s < series_.size(); ++s)
      out.joint.col(static_cast<Eigen::Index>(s)) *= chain.scale(series_[s].joint);
    out.numbers = numbers_of(state);
    out.cost = 0.5 * (out.residual.squaredNorm() + out.numbers.cwiseQuotient(sigma_).squaredNorm());
    return out;
  }

  /// J^T J of parameters and series, without the prior of the series.
  Eigen::MatrixXd information(const SeriesPoint& at) const {
    Eigen::MatrixXd out(count() + numbers(), count() + numbers());
    out.topLeftCorner(count(), count()) = gram_matrix(at.J);
    Eigen::Index column = count();
    for (std::size_t s = 0; s < series_.size(); ++s) {
      const Eigen::MatrixXd& waves = waves_[s];
      const auto joint = at.joint.col(static_cast<Eigen::Index>(s));
      const Eigen::MatrixXd by_pose = sums_by_pose(joint.asDiagonal() * at.J.topRows(joint.size()));
      out.block(0, column, count(), waves.cols()) = transposed_product(by_pose, waves);
      Eigen::Index row = count();
      for (std::size_t r = 0; r <= s; ++r) {
        const Eigen::VectorXd both =
            sums_by_pose(joint.cwiseProduct(at.joint.col(static_cast<Eigen::Index>(r))));
        const Eigen::MatrixXd weighed = both.asDiagonal() * waves;
        out.block(row, column, waves_[r].cols(), waves.cols()) =
            r == s ? symmetric_product(waves, weighed) : transposed_product(waves_[r], weighed);
        row += waves_[r].cols();
      }
      column += waves.cols();
    }
    return out.selfadjointView<Eigen::Upper>();
  }

  /// The negative gradient of the cost by parameters and series.
  Eigen::VectorXd descent(const SeriesPoint& at) const {
    Eigen::VectorXd out(count() + numbers());
    out.head(count()) = at.J.transpose() * at.residual;
    Eigen::Index row = count();
    for (std::size_t s = 0; s < series_.size(); ++s) {
      const Eigen::VectorXd by_pose =
          sums_by_pose(at.joint.col(static_cast<Eigen::Index>(s))
                           .cwiseProduct(at.residual.head(at.joint.rows())));
      out.segment(row, waves_[s].cols()) = waves_[s].transpose() * by_pose;
      row += waves_[s].cols();
    }
    out.tail(numbers()) -= at.numbers.cwiseQuotient(sigma_.cwiseAbs2());
    return out;
  }

  ArmState moved_by(const ArmState& from, const Eigen::VectorXd& step) const {
    ArmState out = moved(from, parameters_, step.head(count()));
    Eigen::Index row = count();
    for (const auto& one : series_)
      for (int k = 0; k < one.count; ++k)
        out.arm.effects[static_cast<std::size_t>(one.effect)]
            .parameters[static_cast<std::size_t>(one.first + k)] += step(row++);
    return out;
  }

 private:
  Eigen::VectorXd numbers_of(const ArmState& state) const {
    Eigen::VectorXd out(numbers());
    Eigen::Index row = 0;
    for (const auto& one : series_)
      for (int k = 0; k < one.count; ++k)
        out(row++) = state.arm.effects[static_cast<std::size_t>(one.effect)]
                         .parameters[static_cast<std::size_t>(one.first + k)];
    return out;
  }

  template <class Lines>
  Eigen::MatrixXd sums_by_pose(const Lines& of_lines) const {
    const Eigen::MatrixXd lines = of_lines;
    Eigen::MatrixXd out(poses_, lines.cols());
    for (Eigen::Index c = 0; c < lines.cols(); ++c)
      for (Eigen::Index i = 0; i < poses_; ++i)
        out(i, c) = lines.col(c).segment(table_.begin(i), table_.count(i)).sum();
    return out;
  }

  FitData data_;
  const std::vector<Parameter>& parameters_;
  std::vector<Parameter> with_joints_;
  std::vector<SeriesNumbers> series_;
  Eigen::Index poses_;
  LineTable table_;
  std::vector<Eigen::MatrixXd> waves_;  // of each series, shape (poses, numbers)
  Eigen::VectorXd sigma_;
};

/// `sigma` of the last of so many numbers, of whose others nothing is known beforehand.
Eigen::VectorXd behind_unknown(Eigen::Index numbers, const Eigen::VectorXd& sigma) {
  Eigen::VectorXd out = Eigen::VectorXd::Constant(numbers, HUGE_VAL);
  out.tail(sigma.size()) = sigma;
  return out;
}

/// Normal equations with the prior of the series, scaled to a unit diagonal.
class SeriesEquations {
 public:
  SeriesEquations(const Eigen::MatrixXd& information, const Eigen::VectorXd& sigma,
                  double damping = kSeriesDamping)
      : matrix_(with_prior(information, behind_unknown(information.rows(), sigma))) {
    scale_ = matrix_.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    matrix_ = (scale_.asDiagonal() * matrix_ * scale_.asDiagonal()).eval();
    damp(damping);
  }

  void damp(double damping) {
    matrix_.diagonal().setConstant(1.0 + damping);
    llt_ = Cholesky(matrix_);
  }

  Eigen::VectorXd solve(const Eigen::VectorXd& descent) const {
    return scale_.cwiseProduct(llt_.solve(scale_.cwiseProduct(descent)));
  }

  /// Variances of the last `count` unknowns: the diagonal of the inverse.
  Eigen::VectorXd variances(Eigen::Index count) const {
    return llt_.inverse_diagonal(count).cwiseProduct(scale_.tail(count).cwiseAbs2());
  }
  /// Information on the `first` unknowns with the others unknown: the Schur complement.
  Eigen::MatrixXd marginal(Eigen::Index first) const {
    const Eigen::Index last = scale_.size() - first;
    const Cholesky of_last(matrix_.bottomRightCorner(last, last));
    const Eigen::MatrixXd across = matrix_.bottomLeftCorner(last, first);
    const Eigen::MatrixXd left =
        matrix_.topLeftCorner(first, first) - across.transpose() * of_last.solve(across);
    const auto size = scale_.head(first).cwiseInverse();
    return size.asDiagonal() * left * size.asDiagonal();
  }

 private:
  Eigen::MatrixXd matrix_;
  Eigen::VectorXd scale_;
  Cholesky llt_;
};

}  // namespace

bool has_series(const ArmState& state) {
  return std::any_of(state.arm.effects.begin(), state.arm.effects.end(),
                     [](const format::Effect& e) { return is_series(e.name); });
}

Eigen::MatrixXd series_information(const FitData& data, const ArmState& state,
                                   const std::vector<Parameter>& parameters) {
  const SeriesProblem problem(data, state, parameters);
  return problem.information(problem.at(state));
}

Solution solve_with_series(const FitData& data, const ArmState& start,
                           const std::vector<Parameter>& parameters, double tolerance) {
  const SeriesProblem problem(data, start, parameters);
  Solution out;
  SeriesPoint here = problem.at(start);
  SeriesEquations equations(problem.information(here), problem.sigma());
  bool fresh = true;  // the equations are those of `here`, not of an earlier point
  double damping = kSeriesDamping;
  PredictionsAtRest at_rest(data.residual_count());
  at_rest.add(here.cost);
  for (; !out.converged && out.iterations < kMostSeriesSteps && damping < kMostSeriesDamping;
       ++out.iterations) {
    const Eigen::VectorXd descent = problem.descent(here);
    const Eigen::VectorXd step = equations.solve(descent);
    const double promised = 0.5 * step.dot(descent);
    if (promised <= std::max(tolerance * here.cost, kNoGain)) {
      out.converged = true;
      break;
    }
    SeriesPoint there = problem.at(problem.moved_by(here.state, step));
    const double fall = here.cost - there.cost;
    const bool better = std::isfinite(there.cost) && fall > 0.0;
    if (better) here = std::move(there);
    at_rest.add(here.cost);
    out.converged = at_rest.may_end();
    const bool keeps_damping = out.iterations >= kUndampedSeriesSteps;
    const bool is_damped = keeps_damping && damping > kSeriesDamping;
    if (better && fall > kAsPromised * promised && !is_damped) {
      fresh = false;
      continue;
    }
    if (!better && fresh) {
      damping = std::max(10.0 * damping, kFirstSeriesDamping);
      equations.damp(damping);
      continue;
    }
    if (!keeps_damping)
      damping = kSeriesDamping;
    else if (better)
      damping = damping > kFirstSeriesDamping ? 0.1 * damping : kSeriesDamping;
    equations = SeriesEquations(problem.information(here), problem.sigma(), damping);
    fresh = true;
  }
  out.converged = out.converged || at_rest.nearly();
  if (damping > kSeriesDamping) equations.damp(kSeriesDamping);
  out.reason = "the residuals still change with every step";
  out.cost = here.cost;
  out.marginal = equations.marginal(problem.count());
  out.series_dof =
      static_cast<double>(problem.numbers()) -
      equations.variances(problem.numbers()).cwiseQuotient(problem.sigma().cwiseAbs2()).sum();
  out.jacobian = is_many(data, parameters) ? triangle_of(gram_matrix(here.J)) : std::move(here.J);
  out.residual = std::move(here.residual);
  out.state = std::move(here.state);
  return out;
}

}  // namespace plumb::offline

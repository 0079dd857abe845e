// SPDX-License-Identifier: Apache-2.0
#include "recheck/evidence.hpp"

#include <algorithm>
#include <cmath>

#include "arm/arm_change.hpp"
#include "arm/effect_binding.hpp"
#include "arm/predicted_points.hpp"
#include "fit/plausible.hpp"
#include "numbers/gaussian.hpp"
#include "plumb/runtime/transform.hpp"
#include "recheck/constants.hpp"
#include "solve/frame_start.hpp"

namespace plumb::offline::recheck {
namespace {

std::vector<Parameter> parameters_of(const std::vector<Change>& changes) {
  std::vector<Parameter> out;
  for (const auto& change : changes)
    out.insert(out.end(), change.parameters.begin(), change.parameters.end());
  return out;
}

Eigen::Index count_of(const Change& change) { return change.typical.size(); }

/// Prior standard deviation of each number for one combination of scales.
Eigen::VectorXd spread_of(const std::vector<Change>& changes, const std::vector<std::size_t>& at) {
  Eigen::Index count = 0;
  for (const auto& change : changes) count += count_of(change);
  Eigen::VectorXd out(count);
  Eigen::Index begin = 0;
  for (std::size_t k = 0; k < changes.size(); ++k) {
    out.segment(begin, count_of(changes[k])) = changes[k].scales[at[k]] * changes[k].typical;
    begin += count_of(changes[k]);
  }
  return out;
}

/// Advances to the next combination of scales, one for each change; false after the last one.
bool advance(const std::vector<Change>& changes, std::vector<std::size_t>& at) {
  for (std::size_t k = 0; k < at.size(); ++k) {
    if (++at[k] < changes[k].scales.size()) return true;
    at[k] = 0;
  }
  return false;
}

/// ln of the evidence of r for one view, averaged over the scales.
double ln_evidence(const Cholesky& S, const Eigen::VectorXd& r, const Eigen::MatrixXd& B,
                   const std::vector<Change>& changes) {
  const Eigen::VectorXd w = S.whitened(r);
  const Eigen::MatrixXd V = S.whitened(B);
  const Eigen::MatrixXd VV = V.transpose() * V;
  const Eigen::VectorXd Vw = V.transpose() * w;
  const double dof = kTrusted + static_cast<double>(r.size());
  const double before = kTrusted + w.squaredNorm();
  const double nothing = -0.5 * S.ln_det() - 0.5 * dof * std::log(before / kTrusted);
  std::vector<double> ln;
  std::vector<std::size_t> at(changes.size(), 0);
  do {
    const Eigen::VectorXd t = spread_of(changes, at);
    const Cholesky llt(with_prior(t.asDiagonal() * VV * t.asDiagonal()));
    const Eigen::VectorXd tv = t.cwiseProduct(Vw);
    ln.push_back(nothing +
                 evidence_gain(llt.ln_det(), before, tv.dot(llt.solve(tv)), dof).ln_bayes);
  } while (advance(changes, at));
  return ln_sum(ln) - std::log(static_cast<double>(ln.size()));
}

/// The measured components of a vector in the base frame, shape (axes, 3).
Eigen::MatrixXd lines_of_base(const ArmState& state, const Measurements& rows) {
  std::vector<int> measured;
  for (int k = 0; k < 3; ++k)
    if (rows.has_axis[static_cast<std::size_t>(k)]) measured.push_back(k);
  const Eigen::Matrix3d R_MB = from_pose(state.X_MB).R;
  return R_MB(measured, Eigen::all);
}

}  // namespace

bool sizes_plausible(const std::vector<Change>& changes, std::size_t k, const Judged& judged) {
  Eigen::Index number = judged.begin[k];
  return std::all_of(
      changes[k].parameters.begin(), changes[k].parameters.end(), [&](const Parameter& p) {
        const double std = std::sqrt(std::max(0.0, judged.x_covariance(number, number)));
        ++number;
        if (!p.of_effect()) return true;
        const EffectParameter info = effect_parameter(judged.state.arm, p.joint, p.component);
        return times_usual(value_of(judged.state, p), std, info) <= kMostTimesAfterChange;
      });
}

/// The start of the Gauss-Newton steps, and the changes with their scales seen from there.
struct Judge::Start {
  ArmState state;
  std::vector<Change> changes;
};

/// How the errors of the run's own parameters propagate to its old readings, W J: shape (3
/// readings, numbers), base frame.
Eigen::MatrixXd Judge::learnt_derivatives(const ExpectedError& view) const {
  if (view.weights.size() == 0) return {};
  const Eigen::MatrixXd J = derivatives(view.near, extended_, known_.parameters);
  const Eigen::MatrixXd to_base = lines_of_base(extended_, view.near).transpose();
  const int axes = readings_.axes;
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(3 * view.weights.rows(), J.cols());
  for (Eigen::Index old = 0; old < view.weights.cols(); ++old) {
    const Eigen::MatrixXd J_B = to_base * J.middleRows(axes * old, axes);
    for (Eigen::Index i = 0; i < view.weights.rows(); ++i)
      out.middleRows(3 * i, 3) += view.weights(i, old) * J_B;
  }
  return out;
}

Judge::Judge(const Readings& readings, const ArmState& extended, const KnownNumbers& known)
    : readings_(readings), extended_(extended), known_(known) {
  for (const auto& view : readings.expected) learnt_.push_back(learnt_derivatives(view));
}

Eigen::VectorXd Judge::residual_at(const ArmState& state) const {
  return linearised(readings_.rows, state, {}).residual;
}

Eigen::MatrixXd Judge::columns_at(const ArmState& state, const std::vector<Change>& changes) const {
  const Eigen::MatrixXd J = derivatives(readings_.rows, state, parameters_of(changes));
  Eigen::Index count = 0;
  for (const auto& change : changes)
    count += change.part == Part::kReading ? readings_.axes : count_of(change);
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(readings_.lines(), count);
  Eigen::Index to = 0, from = 0;
  for (const auto& change : changes)
    if (change.part == Part::kReading) {
      out.block(change.row * readings_.axes, to, readings_.axes, readings_.axes).setIdentity();
      to += readings_.axes;
    } else {
      out.middleCols(to, count_of(change)) = J.middleCols(from, count_of(change));
      to += count_of(change), from += count_of(change);
    }
  return out;
}

/// A tracker on a new station may be metres and half a turn away, too far for a linear step.
Judge::Start Judge::start_of(const std::vector<Change>& changes) const {
  Start out{extended_, changes};
  for (auto& change : out.changes)
    if (change.part == Part::kReading) change.typical.conservativeResize(readings_.axes);
  const auto base = std::find_if(out.changes.begin(), out.changes.end(),
                                 [](const Change& c) { return c.part == Part::kBase; });
  if (base == out.changes.end() || readings_.poses < 3) return out;
  const Eigen::VectorXd miss = residual_at(extended_);
  if (std::sqrt(miss.squaredNorm() / readings_.rows.size()) < kFarAway) return out;
  ArmState in_base = extended_;
  in_base.X_MB = format::Pose{};
  out.state.X_MB = align(predict_points(in_base, readings_.rows), readings_.rows.p_M);
  base->scales = {kAnyPlace};
  return out;
}

Judged Judge::judge(const std::vector<Change>& given) const {
  auto [state, changes] = start_of(given);
  const std::vector<Parameter> parameters = parameters_of(changes);
  std::vector<std::size_t> widest;
  Judged out;
  std::vector<Eigen::Index> of_state;  // numbers that are of the state, not of a single reading
  Eigen::Index count = 0;
  for (const auto& change : changes) {
    widest.push_back(change.scales.size() - 1);
    out.begin.push_back(count);
    for (Eigen::Index k = 0; k < count_of(change); ++k, ++count)
      if (change.part != Part::kReading) of_state.push_back(count);
  }
  out.prior = spread_of(changes, widest);
  out.change = Eigen::VectorXd::Zero(count);
  Eigen::VectorXd in_state = out.change;  // how far `state` has gone
  for (int step = 0;; ++step) {
    linearise(state, changes, in_state, out);
    const Cholesky S(out.S);
    auto [gain, x_covariance] = posterior(S, out.B, out.prior);
    out.gain = std::move(gain);
    out.x_covariance = std::move(x_covariance);
    out.change = out.gain * out.r;
    const Eigen::VectorXd left = out.r - out.B * out.change;
    out.chi2 = left.dot(S.solve(left)) + out.change.cwiseQuotient(out.prior).squaredNorm();
    const Eigen::VectorXd more = (out.change - in_state)(of_state);
    const Eigen::VectorXd std = out.x_covariance.diagonal().cwiseSqrt()(of_state);
    const bool settled =
        more.size() == 0 || more.cwiseQuotient(std).cwiseAbs().maxCoeff() < kSettled;
    state = moved(state, parameters, more);
    in_state(of_state) = out.change(of_state);
    if (settled || step == kSteps) break;
  }
  out.state = std::move(state);
  return out;
}

/// Residuals at a state, their derivatives, and the evidence for these changes.
void Judge::linearise(const ArmState& state, const std::vector<Change>& changes,
                      const Eigen::VectorXd& in_state, Judged& out) const {
  out.B = columns_at(state, changes);
  const Eigen::MatrixXd J = derivatives(readings_.rows, state, known_.parameters);
  const Eigen::VectorXd missed = residual_at(state) + out.B * in_state;
  std::vector<double> views;
  const Eigen::MatrixXd to_lines = lines_of_base(state, readings_.rows);
  const int axes = readings_.axes;
  for (std::size_t v = 0; v < readings_.expected.size(); ++v) {
    const ExpectedError& view = readings_.expected[v];
    Eigen::MatrixXd J_view = J;
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(missed.size());
    if (learnt_[v].size() > 0)
      for (Eigen::Index i = 0; i < readings_.rows.size(); ++i) {
        J_view.middleRows(axes * i, axes) -= to_lines * learnt_[v].middleRows(3 * i, 3);
        mean.segment(axes * i, axes) = to_lines * view.mean_B.row(i).transpose();
      }
    const Eigen::MatrixXd S = view.covariance + J_view * known_.covariance * J_view.transpose();
    const Cholesky llt(S);
    views.push_back(ln_evidence(llt, missed - mean, out.B, changes));
    if (views.back() < *std::max_element(views.begin(), views.end())) continue;
    out.lacks_elsewhere = view.lacks_elsewhere;
    out.E = view.covariance;
    out.S = S;
    out.J = J_view;
    out.r = missed - mean;
    out.mean = mean;
  }
  out.ln_evidence = ln_sum(views) - std::log(static_cast<double>(views.size()));
}

}  // namespace plumb::offline::recheck

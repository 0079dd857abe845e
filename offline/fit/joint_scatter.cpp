// SPDX-License-Identifier: Apache-2.0
#include "fit/joint_scatter.hpp"

#include <algorithm>
#include <cmath>

#include "numbers/cholesky.hpp"

namespace plumb::offline {
namespace {

constexpr double kFirstGuess_rad = 20e-6;  // of arms in good order; [m] of a sliding joint
constexpr double kSmallestNoise = 1e-12;   // variance of a line: noise-free data
constexpr double kSettled = 3e-3;          // relative change of the largest contribution
constexpr double kNothing = 1e-4;          // of the noise: less is no scatter
constexpr Eigen::Index kSomePoses = 400, kMorePoses = 2500;
constexpr int kIterations = 40, kMoreIterations = 4;
constexpr double kScatterRidge = 1e-9;

/// Everything of one model of the noise: lines divided by the Cholesky factor of each pose's
/// covariance, and the model's columns taken out.
struct Whitened {
  Eigen::VectorXd residual;            // (lines,)
  Eigen::MatrixXd model;               // (lines, rank) the model's columns, orthonormal
  std::vector<Eigen::VectorXd> joint;  // (lines,)
  Eigen::MatrixXd unit;                // (lines, axes): the axes themselves
  double ln_determinants = 0.0;        // of the covariance, and of the model's information
};

Eigen::MatrixXd covariance_at(const ScatterLines& s, const JointScatter& at, Eigen::Index pose) {
  Eigen::MatrixXd V = at.noise_variance * Eigen::MatrixXd::Identity(s.axes, s.axes);
  for (std::size_t j = 0; j < s.joint.size(); ++j) {
    const auto g = s.joint[j].segment(pose * s.axes, s.axes);
    V += at.variance(static_cast<Eigen::Index>(j)) * g * g.transpose();
  }
  return V;
}

Whitened whitened_by(const ScatterLines& s, const JointScatter& at, bool with_motions) {
  Whitened out;
  out.residual = s.y;
  out.model = s.U;
  if (with_motions) {
    out.joint = s.joint;
    out.unit = Eigen::MatrixXd::Identity(s.axes, s.axes).replicate(s.poses(), 1);
  }
  double ln_determinant = 0.0;
  for (Eigen::Index i = 0; i < s.poses(); ++i) {
    const Cholesky root(covariance_at(s, at, i));
    const Eigen::Index line = i * s.axes;
    ln_determinant += root.ln_det();
    const auto divide = [&](auto&& lines) { lines = root.whitened(lines); };
    divide(out.residual.segment(line, s.axes));
    divide(out.model.middleRows(line, s.axes));
    if (!with_motions) continue;
    for (auto& motion : out.joint) divide(motion.segment(line, s.axes));
    divide(out.unit.middleRows(line, s.axes));
  }
  Eigen::MatrixXd information = out.model.transpose() * out.model;
  information.diagonal().array() *= 1.0 + kScatterRidge;
  const Cholesky root(information);
  out.model = root.orthonormal(out.model);
  out.residual -= out.model * (out.model.transpose() * out.residual).eval();
  out.ln_determinants = ln_determinant + root.ln_det();
  return out;
}

/// Trace of P G and y^T P G P y of a part of the covariance, given by its motions in each pose.
struct Share {
  double trace = 0.0, squares = 0.0;

  void add(const ScatterLines& s, const Whitened& w, const Eigen::Ref<const Eigen::VectorXd>& g) {
    trace += g.squaredNorm();
    Eigen::VectorXd in_model(w.model.cols());
    for (Eigen::Index i = 0; i < s.poses(); ++i) {
      const auto gi = g.segment(i * s.axes, s.axes);
      in_model.noalias() = w.model.middleRows(i * s.axes, s.axes).transpose() * gi;
      trace -= in_model.squaredNorm();
      const double along = gi.dot(w.residual.segment(i * s.axes, s.axes));
      squares += along * along;
    }
  }
  /// The factor of the next variance.
  double factor() const { return trace > 0.0 ? std::sqrt(std::max(0.0, squares) / trace) : 0.0; }
};

/// Variance of a line that a joint's scatter makes on average.
double contribution(const ScatterLines& s, const JointScatter& at, std::size_t j) {
  return at.variance(static_cast<Eigen::Index>(j)) * s.joint[j].squaredNorm() /
         static_cast<double>(std::max<Eigen::Index>(1, s.y.size()));
}

/// Every so many poses.
ScatterLines thinned(const ScatterLines& s, Eigen::Index most) {
  if (s.poses() <= most) return s;
  std::vector<Eigen::Index> line;
  for (Eigen::Index i = 0; i < s.poses(); ++i)
    if (i * most / s.poses() != (i + 1) * most / s.poses())
      for (int k = 0; k < s.axes; ++k) line.push_back(i * s.axes + k);
  ScatterLines out{s.y(line), s.U(line, Eigen::all), {}, s.axes, s.noise_variance, s.noise_dof};
  for (const auto& motion : s.joint) out.joint.emplace_back(motion(line));
  return out;
}

}  // namespace

double ln_likelihood_of_ratios(const ScatterLines& s, const JointScatter& at) {
  const Whitened w = whitened_by(s, at, false);
  const auto free = static_cast<double>(s.y.size() - s.U.cols());
  return -0.5 * w.ln_determinants -
         0.5 * (free + s.noise_dof) * std::log(s.noise_dof + w.residual.squaredNorm());
}

JointScatter estimated_scatter(const ScatterLines& s, const JointScatter& start, int iterations) {
  JointScatter out = start;
  for (int i = 0; i < iterations; ++i) {
    const Whitened w = whitened_by(s, out, true);
    double change = 0.0;
    for (std::size_t j = 0; j < s.joint.size(); ++j) {
      double& variance = out.variance(static_cast<Eigen::Index>(j));
      if (!(variance > 0.0)) continue;
      Share share;
      share.add(s, w, w.joint[j]);
      const double before = contribution(s, out, j);
      variance *= share.factor();
      const double after = contribution(s, out, j);
      change = std::max(change, std::abs(after - before) / (out.noise_variance + before));
    }
    Share share{s.noise_dof / out.noise_variance,
                s.noise_dof * s.noise_variance / (out.noise_variance * out.noise_variance)};
    for (int k = 0; k < s.axes; ++k) share.add(s, w, w.unit.col(k));
    const double factor = share.factor();
    out.noise_variance = std::max(kSmallestNoise, out.noise_variance * factor);
    if (std::max(change, std::abs(factor - 1.0)) < kSettled) break;
  }
  for (std::size_t j = 0; j < s.joint.size(); ++j)
    if (contribution(s, out, j) < kNothing * out.noise_variance)
      out.variance(static_cast<Eigen::Index>(j)) = 0.0;
  return out;
}

JointScatter noise_alone(const ScatterLines& s) {
  // Without scatter the iterations have a closed end.
  const Cholesky information(s.U.transpose() * s.U);
  const Eigen::VectorXd r = s.y - s.U * information.solve(s.U.transpose() * s.y);
  const double free = std::max(1.0, static_cast<double>(s.y.size() - s.U.cols()));
  const double variance = (r.squaredNorm() + s.noise_dof * s.noise_variance) / (free + s.noise_dof);
  return {Eigen::VectorXd::Zero(static_cast<Eigen::Index>(s.joint.size())),
          std::max(kSmallestNoise, variance)};
}

JointScatter noise_and_scatter(const ScatterLines& s) {
  const ScatterLines some = thinned(s, kSomePoses);
  JointScatter start = noise_alone(some);
  if (s.noise_dof > 0.0) start.noise_variance = s.noise_variance;
  for (Eigen::Index j = 0; j < start.variance.size(); ++j)
    if (some.joint[static_cast<std::size_t>(j)].squaredNorm() > 0.0)
      start.variance(j) = kFirstGuess_rad * kFirstGuess_rad;
  JointScatter out = estimated_scatter(some, start, kIterations);
  if (s.poses() <= kSomePoses) return out;
  return estimated_scatter(thinned(s, kMorePoses), out, kMoreIterations);
}

}  // namespace plumb::offline

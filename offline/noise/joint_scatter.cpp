// SPDX-License-Identifier: Apache-2.0
#include "noise/joint_scatter.hpp"

#include <algorithm>
#include <cmath>

#include "noise/constants.hpp"
#include "numbers/cholesky.hpp"
#include "numbers/products.hpp"

namespace plumb::offline {
namespace {

// Numbers of the iteration; the estimate does not depend on them beyond its tolerance.
constexpr double kFirstGuess_rad = 20e-6;  // start of every joint [rad], or [m] of a sliding one
constexpr double kSmallestNoise = 1e-12;   // least variance of a whitened line: noise-free data
constexpr double kScatterSettled = 3e-3;   // relative change of the variances at which it ends
constexpr double kScatterRidge = 1e-9;

/// The lines under one model of the noise: divided by the Cholesky factor of each pose's
/// covariance, and the residual made orthogonal to the columns of the model.
struct Whitened {
  Eigen::VectorXd residual;            // (lines,)
  Eigen::MatrixXd model;               // (lines, rank) the model's columns, orthonormal
  std::vector<Eigen::VectorXd> joint;  // (lines,)
  Eigen::MatrixXd unit;                // (lines, most of a pose) its whitened unit vectors
};

constexpr int kMostAxes = 6;
using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostAxes, kMostAxes>;

/// Cholesky factor L of the covariance L L^T of the lines of one pose. L^-1 whitens them.
Square root_at(const ScatterLines& s, const JointScatter& at, Eigen::Index pose) {
  Square V = at.noise_variance * Square::Identity(s.table.count(pose), s.table.count(pose));
  for (std::size_t j = 0; j < s.joint.size(); ++j) {
    const auto g = s.joint[j].segment(s.table.begin(pose), s.table.count(pose));
    const double variance = at.variance(static_cast<Eigen::Index>(j));
    if (variance > 0.0) V.noalias() += variance * g * g.transpose();
  }
  return V.llt().matrixL();
}

/// Multiplies the lines of one pose by L^-1, in place.
template <class Lines>
void divide(const Square& root, Lines&& lines) {
  for (Eigen::Index i = 0; i < root.rows(); ++i) {
    for (Eigen::Index k = 0; k < i; ++k) lines.row(i) -= root(i, k) * lines.row(k);
    lines.row(i) /= root(i, i);
  }
}

double ln_det(const Square& root) { return 2.0 * root.diagonal().array().log().sum(); }

Whitened whitened_by(const ScatterLines& s, const JointScatter& at) {
  Whitened out{s.y, s.U, s.joint, Eigen::MatrixXd::Zero(s.table.lines(), s.table.most())};
  for (Eigen::Index i = 0; i < s.poses(); ++i) {
    const Square root = root_at(s, at, i);
    const Eigen::Index line = s.table.begin(i), lines = s.table.count(i);
    divide(root, out.residual.segment(line, lines));
    divide(root, out.model.middleRows(line, lines));
    for (auto& motion : out.joint) divide(root, motion.segment(line, lines));
    auto unit = out.unit.middleRows(line, lines);
    unit.leftCols(lines).setIdentity();
    divide(root, unit);
  }
  Eigen::MatrixXd information = gram_matrix(out.model);
  information.diagonal().array() *= 1.0 + kScatterRidge;
  out.model = Cholesky(information).orthonormal(out.model);
  out.residual -= out.model * (out.model.transpose() * out.residual).eval();
  return out;
}

/// Traces tr(P G) and y^T P G P y for one part G of the covariance, given by its motions g in each
/// pose. P projects out the columns of the model.
struct VariancePart {
  double trace = 0.0, squares = 0.0;

  void add(const ScatterLines& s, const Whitened& w, const Eigen::Ref<const Eigen::VectorXd>& g) {
    trace += g.squaredNorm();
    Eigen::VectorXd in_model(w.model.cols());
    for (Eigen::Index i = 0; i < s.poses(); ++i) {
      const auto gi = g.segment(s.table.begin(i), s.table.count(i));
      in_model.noalias() = w.model.middleRows(s.table.begin(i), s.table.count(i)).transpose() * gi;
      trace -= in_model.squaredNorm();
      const double along = gi.dot(w.residual.segment(s.table.begin(i), s.table.count(i)));
      squares += along * along;
    }
  }
  /// Factor by which the next iteration multiplies the variance of this part.
  double factor() const { return trace > 0.0 ? std::sqrt(std::max(0.0, squares) / trace) : 0.0; }
};

/// Variance that the scatter of a joint adds to a line, on average over the lines.
double contribution(const ScatterLines& s, const JointScatter& at, std::size_t j) {
  return at.variance(static_cast<Eigen::Index>(j)) * s.joint[j].squaredNorm() /
         static_cast<double>(std::max<Eigen::Index>(1, s.y.size()));
}

/// The lines of at most `most` poses, picked evenly.
ScatterLines thinned(const ScatterLines& s, Eigen::Index most) {
  if (s.poses() <= most) return s;
  std::vector<Eigen::Index> pose;
  for (Eigen::Index i = 0; i < s.poses(); ++i)
    if (is_among(i, s.poses(), most)) pose.push_back(i);
  const std::vector<Eigen::Index> line = s.table.lines_of(pose);
  ScatterLines out{s.y(line),  s.U(line, Eigen::all), {}, s.table.picked(pose), s.noise_variance,
                   s.noise_dof};
  for (const auto& motion : s.joint) out.joint.emplace_back(motion(line));
  return out;
}

}  // namespace

void ScatterSums::add(const ScatterLines& s, const JointScatter& at) {
  if (lines == 0.0) {
    information.setZero(s.U.cols(), s.U.cols());
    gradient.setZero(s.U.cols());
  }
  Eigen::VectorXd y = s.y;
  Eigen::MatrixXd U = s.U;
  for (Eigen::Index i = 0; i < s.poses(); ++i) {
    const Square root = root_at(s, at, i);
    ln_determinants += ln_det(root);
    divide(root, y.segment(s.table.begin(i), s.table.count(i)));
    divide(root, U.middleRows(s.table.begin(i), s.table.count(i)));
  }
  information += gram_matrix(U);
  gradient.noalias() += U.transpose() * y;
  squares += y.squaredNorm();
  lines += static_cast<double>(y.size());
}

ScatterSums ScatterSums::with_noise(double variance) const {
  return {information / variance, gradient / variance, squares / variance,
          lines * std::log(variance), lines};
}

double ln_likelihood_of_ratios(const ScatterSums& sums, double noise_dof) {
  Eigen::MatrixXd information = sums.information;
  information.diagonal().array() *= 1.0 + kScatterRidge;
  const Cholesky root(information);
  const double left = sums.squares - root.whitened(sums.gradient).squaredNorm();
  const double free = sums.lines - static_cast<double>(sums.gradient.size());
  return -0.5 * (sums.ln_determinants + root.ln_det()) -
         0.5 * (free + noise_dof) * std::log(noise_dof + std::max(0.0, left));
}

double ln_likelihood_of_ratios(const ScatterLines& s, const JointScatter& at) {
  ScatterSums sums;
  sums.add(s, at);
  return ln_likelihood_of_ratios(sums, s.noise_dof);
}

JointScatter estimated_scatter(const ScatterLines& s, const JointScatter& start, int iterations) {
  JointScatter out = start;
  for (int i = 0; i < iterations; ++i) {
    const Whitened w = whitened_by(s, out);
    double change = 0.0;
    for (std::size_t j = 0; j < s.joint.size(); ++j) {
      double& variance = out.variance(static_cast<Eigen::Index>(j));
      if (!(variance > 0.0)) continue;
      VariancePart share;
      share.add(s, w, w.joint[j]);
      const double before = contribution(s, out, j);
      variance *= share.factor();
      const double after = contribution(s, out, j);
      change = std::max(change, std::abs(after - before) / (out.noise_variance + before));
    }
    VariancePart share{s.noise_dof / out.noise_variance,
                       s.noise_dof * s.noise_variance / (out.noise_variance * out.noise_variance)};
    for (Eigen::Index k = 0; k < s.table.most(); ++k) share.add(s, w, w.unit.col(k));
    const double factor = share.factor();
    out.noise_variance = std::max(kSmallestNoise, out.noise_variance * factor);
    if (std::max(change, std::abs(factor - 1.0)) < kScatterSettled) break;
  }
  for (std::size_t j = 0; j < s.joint.size(); ++j)
    if (contribution(s, out, j) < kNoScatter * out.noise_variance)
      out.variance(static_cast<Eigen::Index>(j)) = 0.0;
  return out;
}

JointScatter unit_noise(const ScatterLines& s) {
  return {Eigen::VectorXd::Zero(static_cast<Eigen::Index>(s.joint.size())), 1.0};
}

JointScatter noise_alone(const ScatterSums& sums, const ScatterLines& some) {
  // Without scatter the estimate has a closed form.
  const Cholesky root(sums.information);
  const double left = sums.squares - root.whitened(sums.gradient).squaredNorm();
  const double free = std::max(1.0, sums.lines - static_cast<double>(sums.gradient.size()));
  const double variance = (left + some.noise_dof * some.noise_variance) / (free + some.noise_dof);
  JointScatter out = unit_noise(some);
  out.noise_variance = std::max(kSmallestNoise, variance);
  return out;
}

JointScatter noise_alone(const ScatterLines& s) {
  ScatterSums sums;
  sums.add(s, unit_noise(s));
  return noise_alone(sums, s);
}

JointScatter noise_and_scatter(const ScatterLines& s) {
  const ScatterLines some = thinned(s, kSomePoses);
  JointScatter start = noise_alone(some);
  if (s.noise_dof > 0.0) start.noise_variance = s.noise_variance;
  for (Eigen::Index j = 0; j < start.variance.size(); ++j)
    if (some.joint[static_cast<std::size_t>(j)].squaredNorm() > 0.0)
      start.variance(j) = kFirstGuess_rad * kFirstGuess_rad;
  JointScatter out = estimated_scatter(some, start, kScatterIterations);
  if (s.poses() <= kSomePoses) return out;
  return estimated_scatter(thinned(s, kPosesOfScatter), out, kMoreScatterIterations);
}

}  // namespace plumb::offline

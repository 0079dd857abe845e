// SPDX-License-Identifier: Apache-2.0
#include "noise/joint_scatter.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "cell/random.hpp"

namespace plumb::offline {
namespace {

double normal(Random& random) {
  return std::sqrt(-2.0 * std::log(1.0 - random.unit())) * std::cos(2.0 * M_PI * random.unit());
}

/// Two joints that move the point, three columns of a model, noise of 1, and scatter as given
/// [rad].
ScatterLines lines_with(int poses, double first, double second, std::uint64_t seed) {
  Random random(seed);
  ScatterLines out;
  out.noise_dof = 4.0;
  out.table = LineTable(std::vector<int>(static_cast<std::size_t>(poses), 3));
  out.y.resize(3 * poses);
  out.U.resize(3 * poses, 3);
  out.joint.assign(2, Eigen::VectorXd(3 * poses));
  for (int i = 0; i < poses; ++i) {
    const double a = first * normal(random), b = second * normal(random);
    for (int k = 0; k < 3; ++k) {
      const int line = 3 * i + k;
      for (auto& motion : out.joint) motion(line) = 5e4 * normal(random);  // 1 m, 20 um
      for (int c = 0; c < 3; ++c) out.U(line, c) = normal(random);
      out.y(line) =
          normal(random) + 2.0 * out.U(line, 0) + a * out.joint[0](line) + b * out.joint[1](line);
    }
  }
  return out;
}

double nats(const ScatterLines& lines, const JointScatter& at) {
  return ln_likelihood_of_ratios(lines, at) - ln_likelihood_of_ratios(lines, noise_alone(lines));
}

TEST(JointScatter, FindsTheVarianceOfEachJointAndOfTheNoise) {
  const ScatterLines lines = lines_with(1000, 40e-6, 15e-6, 1);
  const JointScatter found = noise_and_scatter(lines);
  EXPECT_NEAR(std::sqrt(found.variance(0)), 40e-6, 3e-6);
  EXPECT_NEAR(std::sqrt(found.variance(1)), 15e-6, 3e-6);
  EXPECT_NEAR(found.noise_variance, 1.0, 0.1);
  EXPECT_GT(nats(lines, found), 100.0);
}

TEST(JointScatter, NoiseAloneIsSeldomTakenForScatter) {
  int claimed = 0;
  for (int seed = 1; seed <= 40; ++seed) {
    const ScatterLines lines = lines_with(60, 0.0, 0.0, static_cast<std::uint64_t>(seed));
    claimed += nats(lines, noise_and_scatter(lines)) > 3.0 ? 1 : 0;
  }
  EXPECT_LE(claimed, 2);
}

TEST(JointScatter, ItsLikelihoodIsThatOfTheNormalDistribution) {
  // Against the dense formula: V of all lines at once, the model's columns integrated out.
  ScatterLines lines = lines_with(12, 30e-6, 10e-6, 3);
  lines.noise_dof = 0.0;
  const auto dense = [&](const JointScatter& at) {
    const Eigen::Index n = lines.y.size();
    Eigen::MatrixXd V = at.noise_variance * Eigen::MatrixXd::Identity(n, n);
    for (Eigen::Index i = 0; i < n; i += 3)
      for (Eigen::Index j = 0; j < 2; ++j) {
        const Eigen::VectorXd g = lines.joint[static_cast<std::size_t>(j)].segment(i, 3);
        V.block(i, i, 3, 3) += at.variance(j) * g * g.transpose();
      }
    const Eigen::MatrixXd W = V.inverse(), M = lines.U.transpose() * W * lines.U;
    const Eigen::MatrixXd P = W - W * lines.U * M.inverse() * lines.U.transpose() * W;
    return -0.5 * (std::log(V.determinant()) + std::log(M.determinant()) +
                   static_cast<double>(n - 3) * std::log(lines.y.dot(P * lines.y)));
  };
  JointScatter a = noise_alone(lines), b = a;
  a.variance << 9e-10, 1e-10;
  b.variance << 1e-10, 4e-10;
  b.noise_variance *= 1.3;
  EXPECT_NEAR(ln_likelihood_of_ratios(lines, a) - ln_likelihood_of_ratios(lines, b),
              dense(a) - dense(b), 1e-5);
}

TEST(JointScatter, PartsOfTheLinesAddUpToTheSameLikelihood) {
  const ScatterLines lines = lines_with(300, 40e-6, 15e-6, 5);
  const JointScatter at = noise_and_scatter(lines);
  ScatterSums white, scattered;
  for (Eigen::Index first = 0; first < 900; first += 90) {
    ScatterLines part = lines;
    part.table = LineTable(std::vector<int>(30, 3));
    part.y = lines.y.segment(first, 90);
    part.U = lines.U.middleRows(first, 90);
    for (std::size_t j = 0; j < 2; ++j) part.joint[j] = lines.joint[j].segment(first, 90);
    white.add(part, unit_noise(part));
    scattered.add(part, at);
  }
  const JointScatter noise = noise_alone(white, lines);
  EXPECT_NEAR(noise.noise_variance, noise_alone(lines).noise_variance, 1e-9);
  EXPECT_NEAR(ln_likelihood_of_ratios(scattered, lines.noise_dof),
              ln_likelihood_of_ratios(lines, at), 1e-6);
  EXPECT_NEAR(ln_likelihood_of_ratios(white.with_noise(noise.noise_variance), lines.noise_dof),
              ln_likelihood_of_ratios(lines, noise), 1e-6);
}

}  // namespace
}  // namespace plumb::offline

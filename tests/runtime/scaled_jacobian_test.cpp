// SPDX-License-Identifier: Apache-2.0
#include "runtime/src/scaled_jacobian.hpp"

#include <gtest/gtest.h>

#include "tests/runtime/random_arm.hpp"

namespace plumb {
namespace {

constexpr std::uint64_t kSeed = 20240607;
constexpr double kLength = 0.7;

/// What the tip moves from q to q + h dq: lengths divided by kLength, rotation vector.
Eigen::Matrix<double, 6, 1> motion(const Chain& chain, const std::vector<double>& q,
                                   const internal::JointSteps& dq, double h) {
  std::vector<double> moved = q;
  for (std::size_t i = 0; i < q.size(); ++i)
    moved[i] += h * dq[i] * (chain.revolute(static_cast<int>(i)) ? 1.0 : kLength);
  const Transformd from = chain.forward(q), to = chain.forward(moved);
  Eigen::Matrix<double, 6, 1> out;
  out << (to.p - from.p) / kLength, rotation_vector(times_transposed<double>(to.R, from.R));
  return out;
}

Eigen::Matrix<double, 6, 1> numbers(const internal::TipMotion& m) {
  Eigen::Matrix<double, 6, 1> out;
  for (std::size_t i = 0; i < 3; ++i) {
    out(static_cast<int>(i)) = m.translation[i];
    out(static_cast<int>(i) + 3) = m.rotation[i];
  }
  return out;
}

/// Forward and backward: their difference is the first order, their sum the second.
TEST(ScaledJacobian, KnowsTheMotionOfTheTipToTheSecondOrder) {
  test::RandomArm random(kSeed);
  constexpr double h = 1e-4;
  for (int k = 0; k < 2'000; ++k) {
    const auto parameters = random.anything();
    const Chain chain(parameters);
    std::vector<double> q;
    internal::JointSteps dq{};
    for (int i = 0; i < chain.joints(); ++i) {
      q.push_back(random.uniform(-3.0, 3.0));
      dq[static_cast<std::size_t>(i)] = random.uniform(-1.0, 1.0);
    }
    ChainAxes axes;
    chain.frames(q, axes);
    internal::ScaledJacobian J;
    J.set(chain, axes, axes, 1.0 / kLength);
    const auto ahead = motion(chain, q, dq, h), back = motion(chain, q, dq, -h);
    EXPECT_LT(((ahead - back) / (2 * h) - numbers(J.times(dq))).norm(), 1e-5);
    EXPECT_LT(((ahead + back) / (2 * h * h) - numbers(J.curvature(dq))).norm(), 1e-5);
  }
}

}  // namespace
}  // namespace plumb

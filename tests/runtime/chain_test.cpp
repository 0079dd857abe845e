// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/chain.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "tests/runtime/kdl_arm.hpp"
#include "tests/runtime/random_arm.hpp"

namespace plumb {
namespace {

constexpr std::uint64_t kSeed = 20240607;

double difference(const Transformd& X, const KDL::Frame& Y) {
  double out = 0.0;
  for (int i = 0; i < 3; ++i) {
    out = std::max(out, std::abs(X.p(i) - Y.p(i)));
    for (int j = 0; j < 3; ++j) out = std::max(out, std::abs(X.R(i, j) - Y.M(i, j)));
  }
  return out;
}

std::vector<double> anywhere(test::RandomArm& random, const format::Chain& parameters) {
  std::vector<double> q(parameters.joints.size());
  for (std::size_t i = 0; i < q.size(); ++i) {
    const bool turns = parameters.joints[i].type == format::JointType::kRevolute;
    q[i] = turns ? random.uniform(-6.3, 6.3) : random.uniform(-0.5, 0.5);
  }
  return q;
}

TEST(Chain, AgreesWithKdlOverRandomArmsAndPoses) {
  constexpr int kCount = 100'000;
  std::printf("count %d seed %llu\n", kCount, static_cast<unsigned long long>(kSeed));
  test::RandomArm random(kSeed);
  double worst = 0.0;
  for (int k = 0; k < kCount; ++k) {
    const auto parameters = random.anything();
    const auto q = anywhere(random, parameters);
    const Chain chain(parameters);
    worst = std::max(worst, difference(chain.forward(q), test::KdlArm(parameters).forward(q)));
  }
  std::printf("worst difference %.2e\n", worst);
  EXPECT_LT(worst, 1e-12);
}

TEST(Chain, JacobianAgreesWithKdlOverRandomArmsAndPoses) {
  constexpr int kCount = 10'000;
  std::printf("count %d seed %llu\n", kCount, static_cast<unsigned long long>(kSeed));
  test::RandomArm random(kSeed);
  double worst = 0.0;
  for (int k = 0; k < kCount; ++k) {
    const auto parameters = random.anything();
    const auto q = anywhere(random, parameters);
    const Chain chain(parameters);
    ChainFrames frames;
    chain.frames(q, frames);
    Jacobian J;
    jacobian(chain, frames, J);
    const Eigen::MatrixXd wanted = test::KdlArm(parameters).jacobian(q);
    worst = std::max(worst, (J.leftCols(chain.joints()) - wanted).cwiseAbs().maxCoeff());
    for (int i = chain.joints(); i < kMaxJoints; ++i) EXPECT_TRUE(J.col(i).isZero(0.0));
  }
  std::printf("worst difference %.2e\n", worst);
  EXPECT_LT(worst, 1e-12);
}

TEST(Chain, TipOfTheFramesIsTheForwardPoseBitForBit) {
  test::RandomArm random(kSeed);
  for (int k = 0; k < 1'000; ++k) {
    const auto parameters = random.anything();
    const auto q = anywhere(random, parameters);
    const Chain chain(parameters);
    ChainFrames frames;
    chain.frames(q, frames);
    const Transformd X = chain.forward(q);
    EXPECT_EQ(X.p, frames.tip.p);
    EXPECT_EQ(X.R, frames.tip.R);
  }
}

TEST(Chain, EveryJointFrameFollowedByItsConstantReachesTheNext) {
  test::RandomArm random(kSeed);
  const auto parameters = random.anything();
  const Chain chain(parameters);
  const auto q = anywhere(random, parameters);
  ChainFrames frames;
  chain.frames(q, frames);
  const int n = chain.joints();
  const Transformd tip = frames.joint[n - 1] * chain.constant(n);
  EXPECT_EQ(tip.p, frames.tip.p);
  for (int i = 0; i + 1 < n; ++i) {
    const Transformd X = frames.joint[i] * chain.constant(i + 1);
    EXPECT_LT((X.R.col(2) - frames.joint[i + 1].R.col(2)).norm(), 1e-15) << "axis of joint " << i;
  }
}

}  // namespace
}  // namespace plumb

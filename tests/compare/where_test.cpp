// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "compare/joint_shares.hpp"
#include "compare/profile.hpp"
#include "residual_cases.hpp"

namespace plumb::offline::compare {
namespace {

std::vector<Sample> samples(tests::Random& random, int n, double slope) {
  std::vector<Sample> out;
  for (int i = 0; i < n; ++i) {
    const double x = random.uniform(-1.0, 1.0);
    out.push_back({.value = x, .error = 1e-4 * (1.0 + slope * x * x) + 1e-5 * normal(random)});
  }
  return out;
}

TEST(Profile, EveryPoseCountsOnceAndTheMeanIsKept) {
  tests::Random random(1);
  auto all = samples(random, 500, 2.0);
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].set = i % 3 == 0 ? Sample::Set::kJudged : Sample::Set::kFitted;
    all[i].fit_error = 2.0 * all[i].error;
  }
  double judged = 0.0, fitted = 0.0, judged_binned = 0.0, fitted_binned = 0.0;
  for (const auto& s : all) (s.set == Sample::Set::kJudged ? judged : fitted) += s.error;
  int n = 0;
  for (const auto& bin : profile({}, all).bins) {
    n += bin.n + bin.fit_n;
    judged_binned += bin.n * bin.mean;
    fitted_binned += bin.fit_n * bin.fit_mean / 2.0;
  }
  EXPECT_EQ(n, 500);
  EXPECT_NEAR(judged_binned, judged, 1e-12);
  EXPECT_NEAR(fitted_binned, fitted, 1e-12);
}

TEST(Profile, ADependenceMattersAndNoneDoesNot) {
  const int count = static_cast<int>(tests::scaled(1000));
  std::printf("[ count    ] %d, seed 2\n", count);
  tests::Random random(2);
  int false_alarms = 0;
  for (int k = 0; k < count; ++k) {
    std::vector<ErrorProfile> one{profile({}, samples(random, 60, 0.0))};
    set_matters(one);
    false_alarms += one[0].matters ? 1 : 0;
  }
  EXPECT_LT(false_alarms, 0.02 * count);
  std::vector<ErrorProfile> one{profile({}, samples(random, 600, 1.0))};
  set_matters(one);
  EXPECT_TRUE(one[0].matters);
  // x^2 on [-1, 1] has variance 4/45; six equal bins see bin means of it only.
  const double whole = 1e-8 * 4.0 / 45.0 + 1e-10;
  double between = 0.0;
  for (int b = 0; b < 6; ++b) {
    const double lo = -1.0 + b / 3.0, hi = lo + 1.0 / 3.0;
    between += std::pow((hi * hi * hi - lo * lo * lo) / 3.0 * 3.0 - 1.0 / 3.0, 2) / 6.0;
  }
  EXPECT_NEAR(one[0].explained, 1e-8 * between / whole, 0.05);
}

TEST(Profile, RepeatsOfAPoseAreNoEvidenceAndMissingValuesNoPose) {
  tests::Random random(3);
  std::vector<Sample> all = samples(random, 40, 0.0), many;
  for (const auto& s : all)
    for (int k = 0; k < 50; ++k) {
      many.push_back(s);
      many.back().repeat = k > 0;
    }
  many.push_back({.value = NAN, .error = 1.0});
  const ErrorProfile once = profile({}, all), often = profile({}, many);
  int n = 0;
  for (const auto& bin : often.bins) n += bin.n;
  EXPECT_EQ(n, 2000);
  EXPECT_GT(often.ln_p, once.ln_p - 5.0);  // six bins for four, but fifty times no more poses
}

TEST(Profile, LabelsMakeABinEach) {
  const ErrorProfile p = profile({}, {{-1.0, 1.0}, {1.0, 3.0}, {1.0, 5.0}}, {-1.0, 1.0});
  ASSERT_EQ(p.bins.size(), 2U);
  EXPECT_EQ(p.bins[0].n, 1);
  EXPECT_DOUBLE_EQ(p.bins[1].mean, 4.0);
}

TEST(JointShares, NameTheJointWhoseOwnAngleIsBehindItAndItsSize) {
  const int count = static_cast<int>(tests::scaled(100));
  std::printf("[ seeds    ] 1 .. %d\n", count);
  int right = 0, quiet = 0;
  for (int seed = 1; seed <= count; ++seed) {
    ResidualCase at(static_cast<std::uint64_t>(seed), 300);
    at.add_noise(1e-5);
    bool silent = true;
    for (const auto& s : joint_shares(at.motions(), at.measured.q)) silent = silent && !s.matters;
    quiet += silent ? 1 : 0;
    const int joint = at.random.below(3);
    ArmState bent = at.state;
    bent.arm.calibrated.joints[joint].theta += 1e-4;
    at.add_change(bent, [&](int i) { return std::sin(2.0 * at.measured.q(i, joint)); });
    JointShare best;
    for (const auto& s : joint_shares(at.motions(), at.measured.q))
      if (s.share > best.share) best = s;
    right += best.joint == joint && best.matters && best.rms_rad > 5e-5 && best.rms_rad < 9e-5;
  }
  EXPECT_GE(right, 0.95 * count);
  EXPECT_GE(quiet, 0.95 * count);
}

}  // namespace
}  // namespace plumb::offline::compare

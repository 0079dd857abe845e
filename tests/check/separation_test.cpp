// SPDX-License-Identifier: Apache-2.0
// Numbers that the readings cannot tell apart: planted correlations, and planted copies.
#include "check/separation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solve/fit_data.hpp"
#include "tests/check/simulated_arm.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::offline {
namespace {

/// A fitted arm of six joints, whose poses separate all that is fitted.
struct Separated : testing::Test {
  static void SetUpTestSuite() {
    arm = new SimulatedArm(simulated_arm(2, 120));
    fitted = new Calibration(calibrate(arm->cell, arm->measured, arm->rows));
  }
  static void TearDownTestSuite() {
    delete fitted;
    delete arm;
  }
  std::vector<Separation> found(const std::vector<Parameter>& kept,
                                const std::vector<Parameter>& held,
                                const Eigen::MatrixXd& covariance) const {
    FitData data;
    data.measured = &arm->measured;
    data.rows = arm->rows;
    data.sigma_m = Rows3::Constant(arm->measured.size(), 3, 20e-6);
    return separations(arm->cell, data, fitted->state, kept, held, covariance);
  }
  /// Of these pairs the correlations, and otherwise none; every number in a unit of its own.
  struct Pair {
    Eigen::Index first, second;
    double rho;
  };
  static Eigen::MatrixXd correlated(Eigen::Index size, const std::vector<Pair>& pairs) {
    Eigen::MatrixXd out = Eigen::MatrixXd::Identity(size, size);
    for (const Pair& pair : pairs)
      out(pair.first, pair.second) = out(pair.second, pair.first) = pair.rho;
    tests::Random random(5);
    Eigen::VectorXd sigma(size);
    for (double& one : sigma) one = std::pow(10.0, random.uniform(-8.0, -2.0));
    return sigma.asDiagonal() * out * sigma.asDiagonal();
  }
  /// The correlated pairs that are told.
  std::vector<Separation> pairs_told(const std::vector<Pair>& pairs) const {
    const auto size = static_cast<Eigen::Index>(fitted->parameters.size());
    auto out = found(fitted->parameters, {}, correlated(size, pairs));
    std::erase_if(out, [](const Separation& s) { return s.cause != Separation::Cause::kWeak; });
    return out;
  }
  std::string name(Eigen::Index at) const {
    return fitted->parameters[static_cast<std::size_t>(at)].name;
  }
  /// Places of the numbers of the arm, and of those of frame and target.
  std::vector<Eigen::Index> places(bool of_robot) const {
    std::vector<Eigen::Index> out;
    for (std::size_t i = 0; i < fitted->parameters.size(); ++i)
      if (fitted->parameters[i].of_robot() == of_robot) out.push_back(static_cast<Eigen::Index>(i));
    return out;
  }
  static SimulatedArm* arm;
  static Calibration* fitted;
};
SimulatedArm* Separated::arm = nullptr;
Calibration* Separated::fitted = nullptr;

TEST_F(Separated, CorrelatedPairsAreToldTheMostCorrelatedFirstWhateverTheirUnits) {
  const auto robot = places(true);
  ASSERT_GE(robot.size(), 10U);
  const auto told = pairs_told({{robot[0], robot[1], 0.96},
                                {robot[2], robot[3], -0.995},
                                {robot[4], robot[5], 0.9},
                                {robot[6], robot[7], -0.5},
                                {robot[8], robot[9], 0.98}});
  ASSERT_EQ(told.size(), 3U);
  const std::vector<Pair> expected = {
      {robot[2], robot[3], -0.995}, {robot[8], robot[9], 0.98}, {robot[0], robot[1], 0.96}};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(told[i].parameter, name(expected[i].first));
    EXPECT_EQ(told[i].partners, std::vector<std::string>{name(expected[i].second)});
    EXPECT_NEAR(told[i].rho, expected[i].rho, 1e-9);
    EXPECT_TRUE(holds(told[i].text, told[i].parameter + " and " + told[i].partners.front()))
        << told[i].text;
  }
}

TEST_F(Separated, WhereTheTrackerStandsMayBeCorrelatedWithItselfButNotWithTheArm) {
  const auto robot = places(true), placing = places(false);
  ASSERT_GE(placing.size(), 2U);
  EXPECT_TRUE(pairs_told({{placing[0], placing[1], 0.999}}).empty());
  EXPECT_EQ(pairs_told({{placing[0], robot[1], 0.999}}).size(), 1U);
}

TEST_F(Separated, OfVeryManyPairsAFewAreToldAndTheseAreTheMostCorrelated) {
  const auto robot = places(true);
  std::vector<Pair> pairs;
  std::vector<double> all;
  for (std::size_t i = 0; i < robot.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      pairs.push_back(
          {robot[k], robot[i], 0.96 + 1e-5 * static_cast<double>((7 * i + 5 * k) % 97)});
      all.push_back(pairs.back().rho);
    }
  std::sort(all.rbegin(), all.rend());
  const auto told = pairs_told(pairs);
  ASSERT_GT(told.size(), 5U);
  ASSERT_LT(told.size(), 30U);
  for (std::size_t i = 0; i < told.size(); ++i) EXPECT_NEAR(told[i].rho, all[i], 1e-9) << i;
}

/// Whatever no reading separates from another number does the same as that number.
TEST_F(Separated, ACopyOfANumberIsSaidToBeThatNumber) {
  const auto size = static_cast<Eigen::Index>(fitted->parameters.size());
  for (const Eigen::Index at : places(true)) {
    Parameter copy = fitted->parameters[static_cast<std::size_t>(at)];
    copy.name = "copy";
    auto told = found(fitted->parameters, {copy}, correlated(size, {}));
    std::erase_if(told, [](const Separation& s) { return s.parameter != "copy"; });
    ASSERT_EQ(told.size(), 1U) << name(at);
    EXPECT_EQ(told.front().partners, std::vector<std::string>{name(at)});
    EXPECT_TRUE(told.front().cause == Separation::Cause::kChoice ||
                told.front().cause == Separation::Cause::kArm)
        << told.front().text;
    EXPECT_TRUE(holds(told.front().text, "copy cannot be separated from " + name(at)))
        << told.front().text;
  }
}

TEST_F(Separated, ANumberThatTheReadingsShowIsSeenEvenIfItIsHeld) {
  for (const Eigen::Index at : places(true)) {
    std::vector<Parameter> kept = fitted->parameters;
    kept.erase(kept.begin() + at);
    const auto told = found(kept, {fitted->parameters[static_cast<std::size_t>(at)]},
                            correlated(static_cast<Eigen::Index>(kept.size()), {}));
    const auto own = std::find_if(told.begin(), told.end(), [&](const Separation& s) {
      return s.parameter == name(at) && s.cause == Separation::Cause::kWeak;
    });
    ASSERT_NE(own, told.end()) << name(at);
    EXPECT_TRUE(holds(own->text, "seen too weakly to be better than nominal")) << own->text;
  }
}

}  // namespace
}  // namespace plumb::offline

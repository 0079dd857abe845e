// SPDX-License-Identifier: Apache-2.0
#include "recheck/evidence.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "arm/arm_change.hpp"
#include "arm/effect_binding.hpp"
#include "arm/predicted_points.hpp"
#include "recheck/constants.hpp"
#include "small_arm.hpp"

namespace plumb::offline::recheck {
namespace {

constexpr double kNoise_m = 2e-5;

/// ln of Student's density with this scale matrix, without what depends on the size alone.
double ln_student(const Eigen::VectorXd& r, const Eigen::MatrixXd& scale) {
  const double n = static_cast<double>(r.size());
  return -0.5 * std::log(scale.determinant()) -
         0.5 * (kTrusted + n) * std::log(1.0 + r.dot(scale.inverse() * r) / kTrusted);
}

/// Seven noisy readings after the tool has moved by a third of a millimetre.
struct RecheckEvidence : testing::Test {
  RecheckEvidence() {
    Measurements rows = arm.poses(7, 11);
    ArmState now = arm.state;
    now.X_TG.p = {0.0503, 0.0799, 0.1001};
    rows.p_M = predict_points(now, rows);
    tests::Random random(3);
    add_noise(rows, kNoise_m, random);
    readings = readings_of(std::move(rows), kNoise_m);
    readings.expected[0].covariance = correlated(readings.lines(), kNoise_m * kNoise_m, random);
  }
  Judged judge(const std::vector<Change>& changes) const {
    return Judge(readings, arm.state, known).judge(changes);
  }

  SmallArm arm;
  KnownNumbers known = arm.known(1e-4);
  Readings readings;
};

/// S + B P B^T as one dense matrix, for each scale of the change by itself.
TEST_F(RecheckEvidence, IsStudentsDensityOfTheDenseCovarianceAveragedOverTheScales) {
  const Change tool = arm.tool();
  const Judged judged = judge({tool});
  const Eigen::MatrixXd B = slopes(readings.rows, judged.state, tool.parameters);
  const Eigen::MatrixXd J = slopes(readings.rows, judged.state, known.parameters);
  const Eigen::VectorXd r = missed_lines(readings.rows, arm.state);
  const Eigen::MatrixXd S = readings.expected[0].covariance + J * known.covariance * J.transpose();
  double sum = 0.0;
  for (const double scale : tool.scales) {
    const Eigen::VectorXd variance = (scale * tool.typical).array().square();
    sum += std::exp(ln_student(r, S + B * variance.asDiagonal() * B.transpose()) - 200.0);
  }
  EXPECT_NEAR(judged.ln_evidence, 200.0 + std::log(sum / 2.0), 1e-5);
}

TEST_F(RecheckEvidence, OfNoChangeIsThatOfTheCalibrationAlone) {
  const Judged judged = judge({});
  const Eigen::MatrixXd J = slopes(readings.rows, arm.state, known.parameters);
  const Eigen::MatrixXd S = readings.expected[0].covariance + J * known.covariance * J.transpose();
  EXPECT_NEAR(judged.ln_evidence, ln_student(missed_lines(readings.rows, arm.state), S), 1e-5);
  EXPECT_EQ(judged.change.size(), 0);
}

/// Change and numbers of the run are solved for together, by least squares with both priors.
TEST_F(RecheckEvidence, TheChangeIsThatOfAJointSolutionWithTheNumbersOfTheRun) {
  const std::vector<Change> changes = {arm.tool(), arm.offset(0)};
  const Judged judged = judge(changes);
  Eigen::MatrixXd A(readings.lines(), 6);
  A << slopes(readings.rows, judged.state, changes[0].parameters),
      slopes(readings.rows, judged.state, changes[1].parameters),
      slopes(readings.rows, judged.state, known.parameters);
  Eigen::MatrixXd prior = Eigen::MatrixXd::Zero(6, 6);
  prior.topLeftCorner(4, 4).diagonal().setConstant(1e6);  // the widest scale of each
  prior.bottomRightCorner(2, 2) = known.covariance.inverse();
  const Eigen::MatrixXd weight = readings.expected[0].covariance.inverse();
  const Eigen::MatrixXd covariance = (A.transpose() * weight * A + prior).inverse();
  const Eigen::VectorXd r =
      missed_lines(readings.rows, judged.state) + A.leftCols(4) * judged.change;
  const Eigen::VectorXd x = covariance * A.transpose() * weight * r;
  const Eigen::MatrixXd expected = covariance.topLeftCorner(4, 4);
  EXPECT_LT((judged.change - x.head(4)).cwiseAbs().maxCoeff(), 1e-3 * std::sqrt(expected.norm()));
  EXPECT_LT((judged.x_covariance - expected).norm(), 1e-5 * expected.norm());
  const ArmState twice = moved(arm.state, changes[1].parameters, judged.change.tail(1));
  EXPECT_EQ(value_of(judged.state, changes[1].parameters[0]),
            value_of(twice, changes[1].parameters[0]));
}

/// What the run's own readings taught holds the errors of its numbers there.
TEST_F(RecheckEvidence, LearntErrorsMoveWithTheNumbersThatTheyWereLearntWith) {
  ExpectedError& view = readings.expected[0];
  view.near = arm.poses(4, 12);
  tests::Random random(8);
  view.weights.resize(readings.rows.size(), 4);
  for (double& w : view.weights.reshaped()) w = random.uniform(-0.5, 0.5);
  for (double& m : view.mean_B.reshaped()) m = random.uniform(-1e-4, 1e-4);
  const Judged judged = judge({});
  const Eigen::MatrixXd old = slopes(view.near, arm.state, known.parameters);
  Eigen::MatrixXd J = slopes(readings.rows, arm.state, known.parameters);
  for (Eigen::Index i = 0; i < readings.rows.size(); ++i)
    for (Eigen::Index k = 0; k < 4; ++k)
      J.middleRows(3 * i, 3) -= view.weights(i, k) * old.middleRows(3 * k, 3);
  const Eigen::MatrixXd S = view.covariance + J * known.covariance * J.transpose();
  const Eigen::Matrix3d R_MB = from_pose(arm.state.X_MB).R;
  Eigen::VectorXd r = missed_lines(readings.rows, arm.state);
  for (Eigen::Index i = 0; i < readings.rows.size(); ++i)
    r.segment<3>(3 * i) -= R_MB * view.mean_B.row(i).transpose();
  EXPECT_NEAR(judged.ln_evidence, ln_student(r, S), 1e-5);
}

TEST_F(RecheckEvidence, TwoViewsAreAveragedAndTheLikelierOneIsKept) {
  const double alone = judge({arm.tool()}).ln_evidence;
  ExpectedError other = readings.expected[0];
  other.covariance *= 4.0;
  std::swap(readings.expected[0], other);
  const double wider = judge({arm.tool()}).ln_evidence;
  readings.expected.push_back(other);
  const Judged both = judge({arm.tool()});
  EXPECT_NEAR(std::exp(both.ln_evidence - alone), 0.5 * (1.0 + std::exp(wider - alone)), 1e-6);
  EXPECT_EQ(both.E, readings.expected[alone > wider ? 1 : 0].covariance);
}

TEST_F(RecheckEvidence, TheOrderOfChangesIsOfNoConsequence) {
  const Judged one = judge({arm.tool(), arm.offset(1)}), other = judge({arm.offset(1), arm.tool()});
  EXPECT_NEAR(one.ln_evidence, other.ln_evidence, 1e-8);
  EXPECT_LT((one.change.head(3) - other.change.tail(3)).norm(), 1e-9);
}

/// Turns the tracker about its own origin: all covariances are equal in every direction.
TEST_F(RecheckEvidence, AnotherMeasurementFrameIsOfNoConsequence) {
  readings = readings_of(readings.rows, kNoise_m);
  const Judged before = judge({arm.tool()});
  const Transformd turn = from_pose({{0.3, 0.2, -0.7}, {0.1, 0.7, -0.5, 0.5}});
  for (Eigen::Index i = 0; i < readings.rows.size(); ++i)
    readings.rows.p_M.row(i) = (turn * Vector3(readings.rows.p_M.row(i).transpose())).transpose();
  arm.state.X_MB = to_pose(turn * from_pose(arm.state.X_MB));
  const Judged after = judge({arm.tool()});
  EXPECT_NEAR(after.ln_evidence, before.ln_evidence, 1e-7);
  EXPECT_LT((after.change - before.change).norm(), 1e-9);
}

/// A density per length: n coordinates in a unit `k` times as long make it k^n times as large.
TEST_F(RecheckEvidence, AnotherUnitOfLengthChangesNothingButTheUnitOfTheDensity) {
  constexpr double k = 4.0;
  Change tool = arm.tool();
  const Judged before = judge({tool});
  for (auto& row : arm.state.arm.calibrated.joints) row.a *= k, row.d *= k;
  for (double& p : arm.state.X_MB.p) p *= k;
  for (double& p : arm.state.X_TG.p) p *= k;
  readings.rows.p_M *= k;
  readings.expected[0].covariance *= k * k;
  tool.typical *= k;
  const Judged after = judge({tool});
  EXPECT_NEAR(after.ln_evidence, before.ln_evidence - readings.lines() * std::log(k), 1e-7);
  EXPECT_LT((after.change - k * before.change).norm(), 1e-9);
}

/// The mean over noise of p(r | change) / p(r | nothing) is the integral of the first one.
TEST_F(RecheckEvidence, TheMeanBayesFactorOfNoiseIsOne) {
  readings = readings_of(arm.poses(3, 21), kNoise_m);
  const Rows3 exact = readings.rows.p_M;
  Change tool = arm.tool();
  tool.typical *= 0.2 * kNoise_m / 1e-3;
  tool.scales = {1.0};
  const Eigen::MatrixXd L = Judge(readings, arm.state, known).judge({}).S.llt().matrixL();
  tests::Random random(5);
  constexpr int kDraws = 400;
  double sum = 0.0, square = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    Eigen::VectorXd z(9);
    for (double& one : z) one = normal(random);
    double chi2 = 0.0;
    for (int i = 0; i < static_cast<int>(kTrusted); ++i) chi2 += std::pow(normal(random), 2);
    const Eigen::VectorXd r = L * z * std::sqrt(kTrusted / chi2);
    readings.rows.p_M = exact + r.reshaped<Eigen::RowMajor>(3, 3);
    const Judge judge(readings, arm.state, known);
    const double bayes = std::exp(judge.judge({tool}).ln_evidence - judge.judge({}).ln_evidence);
    sum += bayes, square += bayes * bayes;
  }
  const double mean = sum / kDraws, scatter = std::sqrt(square / kDraws - mean * mean);
  EXPECT_GT(scatter, 0.01);
  EXPECT_NEAR(mean, 1.0, 4.0 * scatter / std::sqrt(kDraws));
}

/// No gear has half a radian of backlash, whatever few readings say; an uncertain number may be
/// any.
TEST_F(RecheckEvidence, AnEffectOfAnAbsurdSizeIsNotPlausible) {
  EffectEntry entry;
  entry.name = "reversal";
  entry.joints = {1};
  Judged judged;
  judged.begin = {0};
  judged.state = arm.state;
  Measurements rows = arm.poses(5, 4);
  rows.context.direction = RowsN::Ones(5, 3);
  judged.state.arm.effects = {bind_effect(arm.cell, rows, entry)};
  judged.x_covariance = Eigen::MatrixXd::Constant(1, 1, 1e-12);
  Change change{.part = Part::kJoint, .joint = 1, .effect = entry.name};
  change.parameters = {effect_parameters(judged.state.arm).front()};
  double& size = judged.state.arm.effects.front().parameters.front();
  size = 50e-6;
  EXPECT_TRUE(sizes_plausible({change}, 0, judged));
  size = 100.0 * effect_parameter(judged.state.arm, 0, 0).typical;
  EXPECT_TRUE(sizes_plausible({change}, 0, judged)) << "what broke may err much more than usual";
  size = 0.446;
  EXPECT_FALSE(sizes_plausible({change}, 0, judged));
  Judged two = judged;
  two.begin = {0, 3};
  two.x_covariance = 1e-12 * Eigen::MatrixXd::Identity(4, 4);
  EXPECT_FALSE(sizes_plausible({arm.tool(), change}, 1, two));
  two.x_covariance(3, 3) = 1.0;
  EXPECT_TRUE(sizes_plausible({arm.tool(), change}, 1, two));
  judged.x_covariance(0, 0) = 1.0;
  EXPECT_TRUE(sizes_plausible({change}, 0, judged));
  EXPECT_TRUE(sizes_plausible({arm.offset(1)}, 0, judged)) << "an encoder may be mounted anyhow";
}

}  // namespace
}  // namespace plumb::offline::recheck

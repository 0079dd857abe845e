// SPDX-License-Identifier: Apache-2.0
// What products and Gram matrices say, against plain least squares over the rows.
#include "diagnose/trial.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

#include "diagnose/extension.hpp"
#include "fit/effect_binding.hpp"
#include "simulate/blind_case.hpp"

namespace plumb::offline {
namespace {

class TrialTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    BlindRequest request;
    request.effects = {"gear_harmonics:J2:3", "reversal:J3:2"};
    request.poses = 120;
    request.seed = 7;
    blind = new BlindCase(make_blind_case(request));
    std::vector<int> fit, held;
    for (int i = 0; i < blind->measured.measured.size(); ++i)
      (i % 5 == 0 ? held : fit).push_back(i);
    calibration = new Calibration(calibrate(blind->cell, blind->measured.measured, fit));
    std::erase_if(fit, [](int row) {
      return std::any_of(calibration->outliers.begin(), calibration->outliers.end(),
                         [&](const Outlier& o) { return o.row == row; });
    });
    stage = new Stage(make_stage(blind->cell, blind->measured.measured, *calibration, fit, held));
  }
  static EffectEntry entry(const std::string& name, std::vector<int> joints) {
    return {.name = name, .joints = std::move(joints), .options = {}, .place = {}};
  }
  static BlindCase* blind;
  static Calibration* calibration;
  static Stage* stage;
};
BlindCase* TrialTest::blind = nullptr;
Calibration* TrialTest::calibration = nullptr;
Stage* TrialTest::stage = nullptr;

TEST_F(TrialTest, TheModelLeavesNothingThatItsOwnColumnsExplain) {
  const auto U = stage->U.topRows(stage->fit_lines);
  EXPECT_LT((U.transpose() * U - Eigen::MatrixXd::Identity(stage->rank, stage->rank)).norm(), 1e-9);
  EXPECT_LT((U.transpose() * stage->y.head(stage->fit_lines)).norm(), 1e-9 * std::sqrt(stage->Q));
}

TEST_F(TrialTest, MotionsOfABlockAreFiniteDifferencesOfTheForwardModel) {
  for (const auto& e :
       {entry("gear_harmonics", {1}), entry("joint_compliance", {2}), entry("link_flexure", {1}),
        entry("base_compliance", {}), entry("tool_sag", {}), entry("axis_wobble", {3}),
        entry("drift", {}), entry("thermal_growth", {}), entry("wrist_coupling", {})}) {
    const Block block = library_block(*stage, e);
    const Eigen::MatrixXd X = motions(*stage, block);
    ASSERT_GT(X.cols(), 0) << e.name;
    for (Eigen::Index c = 0; c < X.cols(); ++c) {
      ArmState bent = calibration->state;
      bent.arm.effects = {bind_effect(*stage->cell, *stage->measured, e)};
      bent.arm.effects[0].parameters[static_cast<std::size_t>(block.members[c])] =
          1e-3 * block.typical(c);
      const Rows3 moved = (predict_points(bent, *stage->measured) -
                           predict_points(calibration->state, *stage->measured)) *
                          1e3;
      for (Eigen::Index i = 0; i < stage->poses(); i += 17)
        for (int k = 0; k < 3; ++k) {
          const Eigen::Index line = i * 3 + k;
          EXPECT_NEAR(X(line, c) * stage->sigma[line], moved(stage->row[i], k),
                      1e-8 + 1e-3 * std::abs(moved(stage->row[i], k)))
              << e.name << " column " << c;
        }
    }
  }
}

TEST_F(TrialTest, TheFoldGainEqualsRefitsWithoutEachFold) {
  const Judge judge(*stage);
  const Block block = library_block(*stage, entry("gear_harmonics", {1}));
  const Trial trial = judge.judge(block);
  const Eigen::MatrixXd X = motions(*stage, block);
  const double left =
      std::max(judge.scale().variance, stage->Q * (1.0 - trial.explained) / judge.scale().lines);
  const double ridge = std::sqrt(left) / trial.evidence.width;
  double before = 0.0, after = 0.0;
  for (const auto& fold : stage->folds) {
    std::vector<Eigen::Index> in, out;
    for (Eigen::Index line = 0; line < stage->fit_lines; ++line)
      (line >= fold.begin * 3 && line < fold.end * 3 ? out : in).push_back(line);
    const auto held = [&](const Eigen::MatrixXd& A, const Eigen::MatrixXd& penalty) {
      Eigen::MatrixXd rows(static_cast<Eigen::Index>(in.size()) + penalty.rows(), A.cols());
      rows << A(in, Eigen::all), penalty;
      Eigen::VectorXd y(rows.rows());
      y << stage->y(in), Eigen::VectorXd::Zero(penalty.rows());
      const Eigen::VectorXd theta = rows.colPivHouseholderQr().solve(y);
      return (stage->y(out) - A(out, Eigen::all) * theta).squaredNorm();
    };
    Eigen::MatrixXd both(X.rows(), stage->rank + X.cols());
    both << stage->U, X;
    Eigen::MatrixXd penalty = Eigen::MatrixXd::Zero(X.cols(), both.cols());
    penalty.rightCols(X.cols()).diagonal().setConstant(ridge);
    before += held(stage->U, Eigen::MatrixXd::Zero(0, stage->rank));
    after += held(both, penalty);
  }
  EXPECT_NEAR(judge.gain(trial).share, 1.0 - std::sqrt(after / before), 1e-6);
}

TEST_F(TrialTest, ASignThatIsForbiddenIsNeverFitted) {
  const Judge judge(*stage);
  Block block = library_block(*stage, entry("joint_compliance", {1}));
  block.columns = -block.columns;  // springs that push
  const Trial other = judge.judge(block);
  block.columns = -block.columns;
  const Trial right = judge.judge(block);
  EXPECT_GE(other.theta.minCoeff(), 0.0);
  EXPECT_GE(right.theta.minCoeff(), 0.0);
  EXPECT_TRUE(other.theta.isZero(0.0) || right.theta.isZero(0.0));
}

TEST_F(TrialTest, ExtendingAStageExplainsWhatTheBlockExplains) {
  const Block block = library_block(*stage, entry("gear_harmonics", {1}));
  const Stage next = extended(*stage, block);
  const Eigen::Index fit = stage->fit_lines;
  Eigen::MatrixXd both(fit, stage->rank + block.columns.cols());
  both << stage->U.topRows(fit), motions(*stage, block).topRows(fit);
  const Eigen::VectorXd y = stage->y.head(fit);
  const double left = (y - both * both.colPivHouseholderQr().solve(y)).squaredNorm();
  EXPECT_NEAR(next.Q, left, 1e-8 * stage->Q);
  EXPECT_EQ(next.rank, stage->rank + block.columns.cols());
}

}  // namespace
}  // namespace plumb::offline

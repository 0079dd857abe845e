// SPDX-License-Identifier: Apache-2.0
// What products and Gram matrices say, against plain least squares over the rows.
#include "diagnose/regressor_score.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

#include "arm/effect_binding.hpp"
#include "arm/predicted_points.hpp"
#include "diagnose/extension.hpp"
#include "fit/calibrate.hpp"
#include "tests/cases/blind_case.hpp"

namespace plumb::offline {
namespace {

class RegressorScoreTest : public testing::Test {
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
    whitened = new WhitenedFit(
        make_whitened_fit(blind->cell, blind->measured.measured, *calibration, fit, held));
  }
  static EffectEntry entry(const std::string& name, std::vector<int> joints) {
    return {.name = name, .joints = std::move(joints), .options = {}, .place = {}};
  }
  static BlindCase* blind;
  static Calibration* calibration;
  static WhitenedFit* whitened;
};
BlindCase* RegressorScoreTest::blind = nullptr;
Calibration* RegressorScoreTest::calibration = nullptr;
WhitenedFit* RegressorScoreTest::whitened = nullptr;

TEST_F(RegressorScoreTest, TheModelLeavesNothingThatItsOwnColumnsExplain) {
  const auto U = whitened->U.topRows(whitened->fit_lines);
  EXPECT_LT((U.transpose() * U - Eigen::MatrixXd::Identity(whitened->rank, whitened->rank)).norm(),
            1e-9);
  EXPECT_LT((U.transpose() * whitened->y.head(whitened->fit_lines)).norm(),
            1e-9 * std::sqrt(whitened->Q));
}

TEST_F(RegressorScoreTest, MotionsOfABlockAreFiniteDifferencesOfTheForwardModel) {
  for (const auto& e :
       {entry("gear_harmonics", {1}), entry("joint_compliance", {2}), entry("link_flexure", {1}),
        entry("base_compliance", {}), entry("tool_sag", {}), entry("axis_wobble", {3}),
        entry("drift", {}), entry("thermal_growth", {}), entry("wrist_coupling", {})}) {
    const Regressor regressor = library_regressor(*whitened, e);
    const Eigen::MatrixXd X = motions(*whitened, regressor);
    ASSERT_GT(X.cols(), 0) << e.name;
    for (Eigen::Index c = 0; c < X.cols(); ++c) {
      ArmState bent = calibration->state;
      bent.arm.effects = {bind_effect(*whitened->cell, *whitened->measured, e)};
      bent.arm.effects[0].parameters[static_cast<std::size_t>(regressor.members[c])] =
          1e-3 * regressor.typical(c);
      const Rows3 moved = (predict_points(bent, *whitened->measured) -
                           predict_points(calibration->state, *whitened->measured)) *
                          1e3;
      for (Eigen::Index i = 0; i < whitened->poses(); i += 17)
        for (int k = 0; k < 3; ++k) {
          const Eigen::Index line = i * 3 + k;
          EXPECT_NEAR(X(line, c) * whitened->sigma[line], moved(whitened->row[i], k),
                      1e-8 + 1e-3 * std::abs(moved(whitened->row[i], k)))
              << e.name << " column " << c;
        }
    }
  }
}

TEST_F(RegressorScoreTest, TheFoldGainEqualsRefitsWithoutEachFold) {
  const Scorer scorer(*whitened);
  const Regressor regressor = library_regressor(*whitened, entry("gear_harmonics", {1}));
  const RegressorScore scored = scorer.score(regressor);
  const Eigen::MatrixXd X = motions(*whitened, regressor);
  const double ridge = std::sqrt(scored.variance) / scored.evidence.width;
  double before = 0.0, after = 0.0;
  for (const auto& fold : whitened->folds) {
    std::vector<Eigen::Index> in, out;
    for (Eigen::Index line = 0; line < whitened->fit_lines; ++line)
      (line >= fold.begin * 3 && line < fold.end * 3 ? out : in).push_back(line);
    const auto held = [&](const Eigen::MatrixXd& A, const Eigen::MatrixXd& penalty) {
      Eigen::MatrixXd rows(static_cast<Eigen::Index>(in.size()) + penalty.rows(), A.cols());
      rows << A(in, Eigen::all), penalty;
      Eigen::VectorXd y(rows.rows());
      y << whitened->y(in), Eigen::VectorXd::Zero(penalty.rows());
      const Eigen::VectorXd theta = rows.colPivHouseholderQr().solve(y);
      return (whitened->y(out) - A(out, Eigen::all) * theta).squaredNorm();
    };
    Eigen::MatrixXd both(X.rows(), whitened->rank + X.cols());
    both << whitened->U, X;
    Eigen::MatrixXd penalty = Eigen::MatrixXd::Zero(X.cols(), both.cols());
    penalty.rightCols(X.cols()).diagonal().setConstant(ridge);
    before += held(whitened->U, Eigen::MatrixXd::Zero(0, whitened->rank));
    after += held(both, penalty);
  }
  EXPECT_NEAR(scorer.gain(scored).share, 1.0 - std::sqrt(after / before), 1e-6);
}

TEST_F(RegressorScoreTest, TheFoldGainHardlyDependsOnTheSigmaThatIsStated) {
  const Regressor regressor = library_regressor(*whitened, entry("gear_harmonics", {1}));
  const auto gain_with = [&](double times) {
    WhitenedFit stated = *whitened;
    stated.noise.variance *= times * times;
    stated.noise.dof = 4.0;
    const Scorer scorer(stated);
    return scorer.gain(scorer.score(regressor)).share;
  };
  const double right = gain_with(1.0);
  EXPECT_GT(right, 0.1);
  EXPECT_NEAR(gain_with(3.0), right, 0.02);
  EXPECT_NEAR(gain_with(0.3), right, 0.02);
}

TEST_F(RegressorScoreTest, ASignThatIsForbiddenIsNeverFitted) {
  const Scorer scorer(*whitened);
  Regressor regressor = library_regressor(*whitened, entry("joint_compliance", {1}));
  regressor.columns = -regressor.columns;  // springs that push
  const RegressorScore other = scorer.score(regressor);
  regressor.columns = -regressor.columns;
  const RegressorScore right = scorer.score(regressor);
  EXPECT_GE(other.theta.minCoeff(), 0.0);
  EXPECT_GE(right.theta.minCoeff(), 0.0);
  EXPECT_TRUE(other.theta.isZero(0.0) || right.theta.isZero(0.0));
}

TEST_F(RegressorScoreTest, ExtendingAStageExplainsWhatTheBlockExplains) {
  const Regressor regressor = library_regressor(*whitened, entry("gear_harmonics", {1}));
  const WhitenedFit next = extended(*whitened, regressor, {});
  const Eigen::Index fit = whitened->fit_lines;
  Eigen::MatrixXd both(fit, whitened->rank + regressor.columns.cols());
  both << whitened->U.topRows(fit), motions(*whitened, regressor).topRows(fit);
  const Eigen::VectorXd y = whitened->y.head(fit);
  const double left = (y - both * both.colPivHouseholderQr().solve(y)).squaredNorm();
  EXPECT_NEAR(next.Q, left, 1e-8 * whitened->Q);
  EXPECT_EQ(next.rank, whitened->rank + regressor.columns.cols());
}

}  // namespace
}  // namespace plumb::offline

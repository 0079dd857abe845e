// SPDX-License-Identifier: Apache-2.0
// A fitted model as a diagnosis looks at it, against plain differences of the predicted points.
#include "diagnose/whitened_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "arm/predicted_points.hpp"
#include "cell/replicates.hpp"
#include "fit/calibrate.hpp"
#include "plumb/runtime/transform.hpp"
#include "solve/evaluation.hpp"
#include "tests/cases/blind_case.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::offline {
namespace {

constexpr double kStep = 1e-5;  // [m or rad] of a difference

/// An arm with repeats; every fifth pose is held out.
struct Fitted {
  Fitted() {
    BlindRequest request;
    request.poses = 90;
    request.fresh_poses = 1;
    request.seed = 6;
    request.outlier_share = 0.03;
    blind = make_blind_case(request);
    const Measurements& m = blind.measured.measured;
    const std::vector<int> group = pose_groups(m);
    for (int i = 0; i < m.size(); ++i)
      (group[static_cast<std::size_t>(i)] % 5 == 0 ? held : fit).push_back(i);
    calibration = calibrate(blind.cell, m, fit);
    fit = without_outliers(fit, calibration.outliers);
    whitened = make_whitened_fit(blind.cell, m, calibration, fit, held);
  }
  Fitted(const Fitted&) = delete;

  BlindCase blind;
  std::vector<int> fit, held;
  Calibration calibration;
  WhitenedFit whitened;
};

struct Whitened : testing::Test {
  static const Fitted& made() {
    static const Fitted out;
    return out;
  }
  const Measurements& measured() const { return made().blind.measured.measured; }
  const ArmState& state() const { return made().calibration.state; }

  /// Lines of the points of `there` less those of the fitted arm, per unit of the step.
  Eigen::VectorXd moved(const ArmState& there, const Measurements& at) const {
    const Rows3 motion = (predict_points(there, at) - predict_points(state(), measured())) / kStep;
    Eigen::VectorXd out(s.y.size());
    for (Eigen::Index i = 0; i < s.poses(); ++i)
      for (int k = 0; k < 3; ++k) out(3 * i + k) = motion(s.row[i], k) / s.sigma[3 * i + k];
    return out;
  }
  static void expect_near(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const char* what) {
    EXPECT_LT((a - b).norm(), 1e-3 * b.norm()) << what;
  }

  const WhitenedFit& s = made().whitened;
};

TEST_F(Whitened, FoldsDealEveryFittedRowOnceAndKeepRepeatsTogether) {
  std::vector<int> dealt(s.row.begin(), s.row.begin() + s.fit_poses());
  std::sort(dealt.begin(), dealt.end());
  EXPECT_EQ(dealt, made().fit);
  EXPECT_EQ(std::vector<int>(s.row.begin() + s.held.begin, s.row.end()), made().held);
  EXPECT_EQ(s.held.size(), static_cast<Eigen::Index>(made().held.size()));
  const std::vector<int> group = pose_groups(measured());
  std::set<int> before;
  Eigen::Index begin = 0;
  for (const Segment& fold : s.folds) {
    EXPECT_EQ(fold.begin, begin);
    EXPECT_GT(fold.size(), 0);
    begin = fold.end;
    std::set<int> here;
    for (Eigen::Index i = fold.begin; i < fold.end; ++i)
      here.insert(group[static_cast<std::size_t>(s.row[i])]);
    for (const int one : here) EXPECT_TRUE(before.insert(one).second) << "in two folds";
  }
  EXPECT_EQ(begin, s.fit_poses());
}

TEST_F(Whitened, JointsMoveThePointAsTheArmDoes) {
  for (int j = 0; j < s.joints(); ++j) {
    Measurements turned = measured();
    turned.q.col(j).array() += kStep;
    expect_near(s.joint[j], moved(state(), turned), "joint");
  }
}

TEST_F(Whitened, BaseAndToolMoveThePointAsFrameAndReflectorDo) {
  for (int k = 0; k < 6; ++k) {
    format::Twist twist{};
    (k < 3 ? twist.d[k] : twist.e[k - 3]) = kStep;
    ArmState there = state();
    there.X_MB = to_pose(from_pose(there.X_MB) * exp(twist));
    expect_near(s.base.col(k), moved(there, measured()), "base");
  }
  for (int k = 0; k < 3; ++k) {
    ArmState there = state();
    there.X_TG.p[k] += kStep;
    expect_near(s.tool.col(k), moved(there, measured()), "tool");
  }
}

/// What is left is what was measured less what is predicted, less its best fit by the model.
TEST_F(Whitened, WhatIsLeftIsOrthogonalToTheModelAndDiffersFromTheErrorByAMotionOfIt) {
  const Rows3 error = residuals(measured(), predict_points(state(), measured()));
  Eigen::VectorXd lines(s.y.size());
  for (Eigen::Index i = 0; i < s.poses(); ++i)
    for (int k = 0; k < 3; ++k) lines(3 * i + k) = error(s.row[i], k) / s.sigma[3 * i + k];
  const auto U = s.U.topRows(s.fit_lines);
  EXPECT_LT((U.transpose() * s.y.head(s.fit_lines)).norm(), 1e-8 * s.y.norm());
  const Eigen::VectorXd change = lines - s.y;
  EXPECT_LT((change - s.U * (U.transpose() * change.head(s.fit_lines))).norm(),
            1e-6 * lines.norm());
  EXPECT_NEAR(s.Q, s.y.head(s.fit_lines).squaredNorm(), 1e-9 * s.Q);
}

TEST_F(Whitened, InformationIsThatOfTheParameters) {
  FitData data;
  data.measured = &measured();
  data.rows = std::vector<int>(s.row.begin(), s.row.begin() + s.fit_poses());
  data.sigma_m = Rows3::Zero(measured().size(), 3);
  for (Eigen::Index i = 0; i < s.poses(); ++i)
    for (int k = 0; k < 3; ++k) data.sigma_m(s.row[i], k) = s.sigma[3 * i + k];
  const Eigen::MatrixXd J = evaluate(data, state(), made().calibration.parameters).jacobian;
  const Eigen::MatrixXd one = s.inverse_information() * (J.transpose() * J);
  EXPECT_EQ(s.rank, J.cols());
  EXPECT_LT((one - Eigen::MatrixXd::Identity(J.cols(), J.cols())).cwiseAbs().maxCoeff(), 1e-4);
}

TEST_F(Whitened, ClearingTwiceIsClearingOnceAndKnowsWhatItTookOut) {
  WhitenedFit some = s;
  tests::Random random(3);
  for (double& line : some.y) line = random.uniform(-1.0, 1.0);
  const Eigen::VectorXd before = some.y;
  const Eigen::VectorXd taken = clear_residual(some);
  EXPECT_LT((some.y + some.U * taken - before).norm(), 1e-9 * before.norm());
  const Eigen::VectorXd once = some.y;
  EXPECT_LT(clear_residual(some).norm(), 1e-9 * before.norm());
  EXPECT_LT((some.y - once).norm(), 1e-9 * before.norm());
}

TEST_F(Whitened, SumsOfAPoseAreThoseOfItsLines) {
  for (const int j : {0, 3}) {
    for (const Eigen::Index i : {Eigen::Index{0}, Eigen::Index{17}, s.poses() - 1}) {
      double square = 0.0, with_y = 0.0;
      Eigen::RowVectorXd with_U = Eigen::RowVectorXd::Zero(s.rank);
      for (Eigen::Index line = 3 * i; line < 3 * i + 3; ++line) {
        square += s.joint[j](line) * s.joint[j](line);
        with_y += s.joint[j](line) * s.y(line);
        with_U += s.joint[j](line) * s.U.row(line);
      }
      EXPECT_NEAR(s.joint_square[j](i), square, 1e-9 * square);
      EXPECT_NEAR(s.joint_y[j](i), with_y, 1e-9 * std::sqrt(square) * s.y.norm());
      EXPECT_LT((s.joint_U[j].row(i) - with_U).norm(), 1e-9 * std::sqrt(square));
    }
  }
}

TEST_F(Whitened, WhiteningIsUndoneAndCountsInStandardDeviations) {
  const Eigen::VectorXd lines = Eigen::Vector3d(1e-3, -2e-4, 3e-5);
  for (const Eigen::Index pose : {Eigen::Index{0}, s.poses() - 1}) {
    Eigen::VectorXd here = lines;
    whiten(s, pose, here);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(here(k) * s.sigma[3 * pose + k], lines(k), 1e-15);
    unwhiten(s, pose, here);
    EXPECT_LT((here - lines).norm(), 1e-15);
  }
}

TEST_F(Whitened, ReadingsThatTheFitLeftOutAreKeptAsContradicted) {
  ASSERT_FALSE(made().calibration.outliers.empty());
  EXPECT_EQ(s.contradicted_m.size(), made().calibration.outliers.size());
  for (const Outlier& outlier : made().calibration.outliers)
    EXPECT_EQ(std::count(s.row.begin(), s.row.end(), static_cast<int>(outlier.row)), 0);
}

TEST_F(Whitened, AnAxisThatWasNotMeasuredHasNoLines) {
  Measurements flat = measured();
  flat.has_axis[1] = false;
  const WhitenedFit two =
      make_whitened_fit(made().blind.cell, flat, made().calibration, made().fit, made().held);
  EXPECT_EQ(two.table.most(), 2);
  ASSERT_EQ(two.row, s.row);
  for (Eigen::Index i = 0; i < s.poses(); i += 7) {
    EXPECT_NEAR(two.joint[2](2 * i), s.joint[2](3 * i), 1e-12 * std::abs(s.joint[2](3 * i)));
    EXPECT_NEAR(two.joint[2](2 * i + 1), s.joint[2](3 * i + 2),
                1e-12 * std::abs(s.joint[2](3 * i + 2)));
  }
}

}  // namespace
}  // namespace plumb::offline

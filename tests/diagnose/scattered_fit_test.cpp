// SPDX-License-Identifier: Apache-2.0
// Noise and scatter of the joints in one covariance, against dense matrices of all lines.
#include "diagnose/scattered_fit.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numeric>

#include "arm/predicted_points.hpp"
#include "tests/diagnose/whitened_arm.hpp"

namespace plumb::offline {
namespace {

/// Every tenth pose read three times.
struct RepeatedArm {
  RepeatedArm() {
    BlindRequest request;
    request.poses = 80;
    request.fresh_poses = 1;
    request.repeats = 3;
    request.seed = 8;
    blind = make_blind_case(request);
    const Measurements& m = blind.measured.measured;
    std::vector<int> rows(static_cast<std::size_t>(m.size()));
    std::iota(rows.begin(), rows.end(), 0);
    calibration = calibrate(blind.cell, m, rows);
    whitened = make_whitened_fit(blind.cell, m, calibration,
                                 without_outliers(rows, calibration.outliers), {});
  }
  RepeatedArm(const RepeatedArm&) = delete;

  BlindCase blind;
  Calibration calibration;
  WhitenedFit whitened;
};

const WhitenedFit& with_repeats() {
  static const RepeatedArm arm;
  return arm.whitened;
}

JointScatter of_joints(const WhitenedFit& s, const std::vector<double>& std_rad,
                       double noise_variance = 1.0) {
  JointScatter out;
  out.variance = Eigen::VectorXd::Zero(s.joints());
  for (std::size_t j = 0; j < std_rad.size(); ++j)
    out.variance(static_cast<Eigen::Index>(j)) = std_rad[j] * std_rad[j];
  out.noise_variance = noise_variance;
  return out;
}

JointScatter some_scatter(const WhitenedFit& s) {
  return of_joints(s, {40e-6, 10e-6, 0.0, 60e-6, 0.0, 25e-6}, 1.3);
}

/// Covariance of all lines, of poses that are read once each.
Eigen::MatrixXd covariance(const WhitenedFit& s, const JointScatter& scatter) {
  const Eigen::Index lines = s.y.size();
  Eigen::MatrixXd out = scatter.noise_variance * Eigen::MatrixXd::Identity(lines, lines);
  for (Eigen::Index a = 0; a < lines; ++a)
    for (Eigen::Index b = 0; b < lines; ++b)
      for (int j = 0; j < s.joints() && s.table.reading(a) == s.table.reading(b); ++j)
        out(a, b) += scatter.variance(j) * s.joint[j](a) * s.joint[j](b);
  return out;
}

TEST(ScatteredFit, LeavesWhatGeneralisedLeastSquaresLeaves) {
  const WhitenedFit& s = whitened_arm().whitened;
  const JointScatter scatter = some_scatter(s);
  const WhitenedFit there = with_scatter(s, scatter);
  const Eigen::Index fit = s.fit_lines;
  const Eigen::MatrixXd W = covariance(s, scatter).topLeftCorner(fit, fit).inverse();
  const auto U = s.U.topRows(fit);
  const auto y = s.y.head(fit);
  const Eigen::VectorXd b = (U.transpose() * W * U).ldlt().solve(U.transpose() * W * y);
  const Eigen::VectorXd left = y - U * b;
  EXPECT_NEAR(there.Q, left.dot(W * left), 1e-8 * there.Q);
  EXPECT_EQ(there.rank, s.rank);
}

TEST(ScatteredFit, WeighsAJointByItsOwnScatter) {
  const WhitenedFit& s = whitened_arm().whitened;
  constexpr int kJoint = 1;
  for (const double rad : {1e-6, 50e-6, 1e-2}) {
    const WhitenedFit there = with_scatter(s, of_joints(s, {0.0, rad}));
    for (Eigen::Index i = 0; i < s.poses(); i += 9) {
      // g^T (1 + v g g^T)^-1 g = g^T g / (1 + v g^T g). [Sherman & Morrison 1950]
      const double gg = s.joint_square[kJoint](i);
      EXPECT_NEAR(there.joint_square[kJoint](i), gg / (1.0 + rad * rad * gg), 1e-9 * gg);
      EXPECT_LT(there.joint_square[kJoint](i) * rad * rad, 1.0 + 1e-9);
    }
  }
}

TEST(ScatteredFit, WithoutScatterOrRepeatsIsTheSameFit) {
  const WhitenedFit& s = whitened_arm().whitened;
  const WhitenedFit there = with_scatter(s, of_joints(s, {}));
  EXPECT_EQ(there.row, s.row);
  EXPECT_LT((there.y - s.y).norm(), 1e-9 * s.y.norm());
  EXPECT_NEAR(there.Q, s.Q, 1e-9 * s.Q);
  EXPECT_NEAR(there.sigma_m, s.sigma_m, 1e-12);
  EXPECT_LT((there.inverse_information() - s.inverse_information()).norm(),
            1e-6 * s.inverse_information().norm());
}

TEST(ScatteredFit, OfTwiceTheNoiseIsFourTimesTheInverseInformation) {
  const WhitenedFit& s = whitened_arm().whitened;
  const WhitenedFit one = with_scatter(s, of_joints(s, {}));
  const WhitenedFit two = with_scatter(s, of_joints(s, {}, 4.0));
  EXPECT_NEAR(two.Q, one.Q / 4.0, 1e-9 * one.Q);
  EXPECT_LT((two.inverse_information() - 4.0 * one.inverse_information()).norm(),
            1e-6 * two.inverse_information().norm());
  EXPECT_NEAR(two.sigma_m, 2.0 * one.sigma_m, 1e-9 * one.sigma_m);
}

TEST(ScatteredFit, WhitensThePartsOfOnePoseAlike) {
  const WhitenedFit& s = whitened_arm().whitened;
  const WhitenedFit there = with_scatter(s, some_scatter(s));
  for (const Eigen::Index pose : {Eigen::Index{0}, Eigen::Index{40}, s.poses() - 1}) {
    Eigen::VectorXd lines = s.tool.col(1).segment(s.table.begin(pose), s.table.count(pose));
    unwhiten(s, pose, lines);
    const Eigen::VectorXd motion_m = lines;
    whiten(there, pose, lines);
    EXPECT_LT((lines - there.tool.col(1).segment(s.table.begin(pose), s.table.count(pose))).norm(),
              1e-9 * lines.norm());
    unwhiten(there, pose, lines);
    EXPECT_LT((lines - motion_m).norm(), 1e-9 * motion_m.norm());
  }
}

TEST(ScatteredFit, ReadingsOfOneStopAreOnePoseOfTheirMean) {
  const WhitenedFit& s = with_repeats();
  const WhitenedFit there = with_scatter(s, of_joints(s, {}));
  const Measurements& m = *s.measured;
  EXPECT_EQ(there.poses(), 80) << "as many as poses were chosen";
  EXPECT_LT(there.poses(), s.poses());
  const auto U = s.U.topRows(s.fit_lines);
  for (Eigen::Index i = 0; i < there.poses(); ++i) {
    // All readings at the same joint positions.
    int count = 0;
    for (const int row : s.row)
      count += (m.q.row(row) - m.q.row(there.row[i])).norm() == 0.0 ? 1 : 0;
    for (Eigen::Index k = 0; k < s.table.count(i); ++k) {
      const auto of = [&](const WhitenedFit& fit, Eigen::Index pose) {
        return fit.sigma[static_cast<std::size_t>(fit.table.begin(pose) + k)];
      };
      EXPECT_NEAR(of(there, i) * std::sqrt(count), of(s, 0), 1e-12) << i;
    }
  }
  // Repeats tell the noise, and no more of the model: the information stays.
  EXPECT_LT((there.inverse_information() - s.inverse_information()).norm(),
            1e-6 * s.inverse_information().norm());
  EXPECT_LT(there.Q, s.Q);
  EXPECT_LT((U.transpose() * U - Eigen::MatrixXd::Identity(s.rank, s.rank)).norm(), 1e-9);
}

TEST(ScatterLinesOfAFit, AreItsOwnWhereNothingIsRepeated) {
  const WhitenedFit& s = whitened_arm().whitened;
  const ScatterLines lines = scatter_lines(s);
  EXPECT_LT((lines.y - s.y.head(s.fit_lines)).norm(), 1e-12);
  for (int j = 0; j < s.joints(); ++j)
    EXPECT_LT((lines.joint[j] - s.joint[j].head(s.fit_lines)).norm(), 1e-9);
}

TEST(ScatterLinesOfAFit, BesideFurtherColumnsHoldThemInTheModel) {
  const WhitenedFit& s = whitened_arm().whitened;
  const Eigen::MatrixXd columns = motions(s, library_regressor(s, entry_of("gear_harmonics", {1})));
  const ScatterLines lines = scatter_lines(s, columns);
  const Eigen::Index fit = s.fit_lines;
  EXPECT_EQ(lines.U.cols(), s.rank + columns.cols());
  for (const Eigen::MatrixXd& held :
       {Eigen::MatrixXd(s.U.topRows(fit)), Eigen::MatrixXd(columns.topRows(fit))})
    EXPECT_LT((held - lines.U * (lines.U.transpose() * held)).norm(), 1e-8 * held.norm());
}

/// Turns every joint by its standard deviation, one after the other.
TEST(RepeatabilityOfAFit, AtAMeasuredCoordinateIsWhatTheJointsDoThere) {
  const WhitenedArm& arm = whitened_arm();
  const WhitenedFit& s = arm.whitened;
  const JointScatter scatter = some_scatter(s);
  const Repeatability found = repeatability_of(s, scatter);
  const Measurements all =
      pick(arm.blind.measured.measured, {s.row.begin(), s.row.begin() + s.fit_poses()});
  const Rows3 before = predict_points(arm.calibration.state, all);
  double variance = scatter.noise_variance * s.sigma_m * s.sigma_m;
  for (int j = 0; j < s.joints(); ++j) {
    const double std = std::sqrt(scatter.variance(j));
    ASSERT_NEAR(found.std[static_cast<std::size_t>(j)], std, 1e-12);
    Measurements turned = all;
    turned.q.col(j).array() += std;
    variance += (predict_points(arm.calibration.state, turned) - before).squaredNorm() /
                static_cast<double>(before.size());
  }
  EXPECT_NEAR(found.sigma_m, std::sqrt(variance), 1e-3 * found.sigma_m);
}

}  // namespace
}  // namespace plumb::offline

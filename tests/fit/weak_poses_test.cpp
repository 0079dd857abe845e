// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "arm/predicted_points.hpp"
#include "fit/calibrate.hpp"
#include "solve/weak_directions.hpp"

/// Poses along a path or on a surface: sound data that say little of some numbers of the arm.
namespace plumb::offline {
namespace {

constexpr double kNoise_m = 10e-6;
constexpr int kPoses = 150;

enum class Way { kHelix, kLineWithLittleWrist, kSweepOfTwoJoints, kWristAlmostStill };

/// Joint positions along such a way, inside the limits of the arm.
RowsN along(const Cell& cell, Way way) {
  RowsN q(kPoses, cell.joints());
  for (int i = 0; i < kPoses; ++i) {
    const double t = static_cast<double>(i) / (kPoses - 1);
    const auto [a, b] = std::pair(std::cos(8.0 * M_PI * t), std::sin(8.0 * M_PI * t));
    for (int j = 0; j < cell.joints(); ++j) {
      double u = 0.0;  // of half the range
      if (way == Way::kHelix) u = 0.5 * (j % 2 == 0 ? a : b) * (j < 3 ? 1.0 : 0.3) + 0.2 * t;
      if (way == Way::kLineWithLittleWrist) u = (j < 3 ? 0.6 : 0.05) * (2.0 * t - 1.0) + 0.02 * a;
      if (way == Way::kSweepOfTwoJoints) u = j == 0 ? 0.7 * a : j == 1 ? 0.6 * (t - 0.5) : 0.03 * b;
      if (way == Way::kWristAlmostStill) u = j < 3 ? 0.7 * std::sin((3.0 + j) * 6.0 * t) : 0.02 * a;
      const auto& row = cell.nominal.joints[static_cast<std::size_t>(j)];
      q(i, j) = 0.5 * (row.q_min + row.q_max) + u * 0.5 * (row.q_max - row.q_min);
    }
  }
  return q;
}

/// A six-axis arm of about 1.5 m, the wrist not spherical.
Cell six_axis_arm() {
  return parse_cell(
      "schema = \"cell/1\"\n[robot]\ndh_convention = \"standard\"\njoints = [\n"
      "{ alpha = -90, a = 150, d = 450, q = [-160, 160] },\n"
      "{ a = 600, q = [-150, 60], parallel_next = true },\n"
      "{ alpha = -90, a = 120, q = [-120, 120] },\n"
      "{ alpha = 90, d = 640, q = [-180, 180] },\n"
      "{ alpha = -90, a = 30, q = [-115, 115] },\n"
      "{ d = 95, q = [-180, 180] }]\n",
      "/cell/cell.toml");
}

/// Joint positions at which the point `at_flange` [m] moves along a straight line of half a metre;
/// the wrist turns to either side by `turn` [rad]. The line differs from `number` to `number`.
RowsN along_a_line(const Cell& cell, int number, const Vector3& at_flange, double turn) {
  constexpr int kNewtonSteps = 30;
  constexpr double kStep_rad = 1e-6, kMostTurn_rad = 0.1;
  ArmState nominal;
  nominal.arm.nominal = nominal.arm.calibrated = cell.nominal;
  nominal.X_TG.p = {at_flange.x(), at_flange.y(), at_flange.z()};
  const double n = number;
  RowsN first(1, 6);
  first << 0.1 * n, 0.1 * n - 1.0, 0.3, 0.2, 0.6, 0.1 * n;
  const Eigen::Vector3d middle = predict_points(nominal, first).row(0).transpose();
  const Eigen::Vector3d way = Eigen::Vector3d(std::cos(n), std::sin(n), 0.4).normalized();
  RowsN q(kPoses, 6);
  for (int i = 0; i < kPoses; ++i) {
    const double t = static_cast<double>(i) / (kPoses - 1);
    RowsN at = i > 0 ? RowsN(q.row(i - 1)) : first;
    at(0, 3) = 0.2 + turn * std::cos(7.0 * t);
    at(0, 4) = 0.6 + turn * std::sin(5.0 * t);
    at(0, 5) = 0.1 * n + turn * std::cos(4.0 * t + 1.0);
    for (int step = 0; step < kNewtonSteps; ++step) {
      const Eigen::Vector3d here = predict_points(nominal, at).row(0).transpose();
      Eigen::Matrix3d J;
      for (int j = 0; j < 3; ++j) {
        RowsN moved = at;
        moved(0, j) += kStep_rad;
        J.col(j) = (predict_points(nominal, moved).row(0).transpose() - here) / kStep_rad;
      }
      const Eigen::Vector3d by = J.inverse() * (middle + 0.5 * (t - 0.5) * way - here);
      at.leftCols<3>() += by.cwiseMax(-kMostTurn_rad).cwiseMin(kMostTurn_rad).transpose();
    }
    q.row(i) = at;
  }
  return q;
}

const Vector3 kReflector_m(0.03, 0.02, 0.12);

/// Waves of a tenth of a milliradian at joints 2 and 4.
RowsN with_waves(const RowsN& q) {
  RowsN out = q;
  for (const int joint : {1, 3})
    for (const int k : {1, 2, 5, 11})
      out.col(joint).array() +=
          100e-6 / std::sqrt(k) * (k * q.col(joint).array() + joint + k).sin();
  return out;
}

/// The arm at these poses, its lengths and angles wrong by `error` (1 sigma, [m] and [rad]).
Measurements measured_at(const Cell& cell, const RowsN& q, std::uint64_t seed, double error) {
  std::mt19937_64 dice(seed);
  std::normal_distribution<double> normal;
  ArmState truth;
  truth.arm.nominal = truth.arm.calibrated = cell.nominal;
  for (auto& row : truth.arm.calibrated.joints)
    for (double* number : {&row.theta, &row.d, &row.a, &row.alpha}) *number += error * normal(dice);
  truth.X_MB.p = {2.1, -1.2, 0.3};
  truth.X_TG.p = {0.03, 0.02, 0.12};
  Measurements m;
  m.q = q;
  m.p_M = predict_points(truth, q);
  for (Eigen::Index i = 0; i < m.p_M.size(); ++i) m.p_M.data()[i] += kNoise_m * normal(dice);
  const auto n = static_cast<std::size_t>(q.rows());
  m.pose.assign(n, "p");
  m.set.assign(n, SetMark::kUnmarked);
  m.replicate_group.resize(n);
  std::iota(m.replicate_group.begin(), m.replicate_group.end(), 0);
  m.has_axis = {true, true, true};
  return m;
}

Measurements measured_along(const Cell& cell, Way way, std::uint64_t seed, double error = 0.5e-3) {
  return measured_at(cell, along(cell, way), seed, error);
}

/// Poses all over the joint limits.
RowsN all_over(const Cell& cell) {
  std::mt19937_64 dice(7);
  std::uniform_real_distribution<double> share;
  RowsN q(200, cell.joints());
  for (Eigen::Index i = 0; i < q.rows(); ++i)
    for (int j = 0; j < cell.joints(); ++j) {
      const auto& row = cell.nominal.joints[static_cast<std::size_t>(j)];
      q(i, j) = row.q_min + share(dice) * (row.q_max - row.q_min);
    }
  return q;
}

Calibration fitted(const Cell& cell, const Measurements& m) {
  std::vector<int> rows(static_cast<std::size_t>(m.size()));
  std::iota(rows.begin(), rows.end(), 0);
  return calibrate(cell, m, rows);
}

/// Poses from `first` on, every second one.
std::vector<int> every_second(int first) {
  std::vector<int> out;
  for (int i = first; i < kPoses; i += 2) out.push_back(i);
  return out;
}

Cell with_series(Cell cell) {
  cell.effects = {{"geometry", {}, {}, {}},
                  {"joint_series",
                   {0, 1, 2, 3, 4, 5},
                   {{"waves", 12.0}, {"size_urad", 100.0}, {"slope", 0.5}},
                   {}}};
  return cell;
}

/// RMS of what is left per axis, over the noise.
double held_out_excess(const Calibration& c, const Measurements& m) {
  const Rows3 e = residuals(m, predict_points(c.state, m));
  return std::sqrt(e.squaredNorm() / static_cast<double>(e.size())) / kNoise_m;
}

bool says_so(const Calibration& c) {
  return std::any_of(c.remarks.begin(), c.remarks.end(),
                     [](const Problem& p) { return p.code == "N-FIT-PRIOR"; });
}

class PosesAlongAWay : public ::testing::TestWithParam<Way> {};

TEST_P(PosesAlongAWay, AreFittedToTheNoiseAndTheArmStaysNearNominal) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Cell cell = six_axis_arm();
    const Measurements m = measured_along(cell, GetParam(), seed);
    const Calibration c = fitted(cell, m);
    EXPECT_LT(held_out_excess(c, m), 1.15) << "seed " << seed;
    EXPECT_TRUE(says_so(c)) << "seed " << seed;
    for (const auto& e : c.estimates)
      if (e.of_robot) {
        EXPECT_LT(std::abs(e.value - e.nominal), 8e-3) << e.name << " seed " << seed;
        EXPECT_LT(e.std, 3e-3) << e.name << " seed " << seed;
      }
  }
}

// That these poses are hard: without the prior some number of the arm is lost, or the fit is.
TEST_P(PosesAlongAWay, LeaveNumbersOfTheArmOpenWithoutThePrior) {
  Cell cell = six_axis_arm();
  cell.fit.prior_m = cell.fit.prior_rad = 0.0;
  const Measurements m = measured_along(cell, GetParam(), 1);
  double widest = 0.0;
  try {
    for (const auto& e : fitted(cell, m).estimates)
      if (e.of_robot) widest = std::max(widest, e.std);
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit_code(), Exit::kNumbersSayNo);
    widest = 1.0;
  }
  RecordProperty("widest_um", static_cast<int>(1e6 * widest));
  EXPECT_GT(widest, 0.5e-3);
}

// An arm may be built ten times worse than the prior says.
TEST_P(PosesAlongAWay, AreFittedToTheNoiseEvenOfAnArmThatIsMillimetresOff) {
  const Cell cell = six_axis_arm();
  const Measurements m = measured_along(cell, GetParam(), 1, 5e-3);
  EXPECT_LT(held_out_excess(fitted(cell, m), m), 1.5);
}

/// A prior that is not the usual one, by next to nothing: a cell that states its own keeps it.
Cell with_a_prior_of_its_own(Cell cell) {
  cell.fit.prior_m = cell.fit.prior_rad = 0.5001e-3;
  return cell;
}

/// How much larger the error at poses all over is if the prior may be widened by what the poses
/// tell, than if it stays: mean of the logarithm over some arms, and its standard error.
struct Larger {
  double mean = 0.0, error = 0.0;
};

/// Of arms that are wrong by `error` (1 sigma, [m] and [rad]).
Larger with_a_prior_by_evidence(Way way, double error) {
  constexpr std::uint64_t kFirst = 11, kLast = 22;
  const Cell cell = six_axis_arm();
  const Cell stays = with_a_prior_of_its_own(cell);
  double sum = 0.0, squares = 0.0;
  for (std::uint64_t seed = kFirst; seed <= kLast; ++seed) {
    const Measurements m = measured_along(cell, way, seed, error);
    const Measurements elsewhere = measured_at(cell, all_over(cell), seed, error);
    const double here = std::log(held_out_excess(fitted(cell, m), elsewhere) /
                                 held_out_excess(fitted(stays, m), elsewhere));
    sum += here;
    squares += here * here;
  }
  constexpr double kArms = kLast - kFirst + 1;
  const double mean = sum / kArms;
  return {mean, std::sqrt((squares / kArms - mean * mean) / (kArms - 1.0))};
}

// How far this arm is built from nominal is decided by what its poses clearly tell.
TEST_P(PosesAlongAWay, OfAnArmThatIsMillimetresOffPredictOthersAsWell) {
  constexpr double kLittle = 0.1;  // beside errors of millimetres there
  EXPECT_LT(with_a_prior_by_evidence(GetParam(), 4e-3).mean, kLittle);
}

TEST_P(PosesAlongAWay, OfAnArmBuiltAsArmsAreKeepTheUsualPrior) {
  EXPECT_NEAR(with_a_prior_by_evidence(GetParam(), 0.5e-3).mean, 0.0, 0.002);
}

TEST(PriorOfGeometry, IsWidenedWhereAnArmIsMillimetresOffAndPredictsOtherPosesBetter) {
  for (const Way way : {Way::kHelix, Way::kWristAlmostStill}) {
    const Larger larger = with_a_prior_by_evidence(way, 4e-3);
    EXPECT_LT(larger.mean, -2.0 * larger.error);
  }
}

INSTANTIATE_TEST_SUITE_P(All, PosesAlongAWay,
                         ::testing::Values(Way::kHelix, Way::kLineWithLittleWrist,
                                           Way::kSweepOfTwoJoints, Way::kWristAlmostStill));

/// Along a line the poses say so little of the arm that its numbers wander along with the series.
TEST(PosesAlongALine, AreFittedWithASeriesThatPredictsOtherPosesOfTheLineNoWorse) {
  for (const int number : {0, 2, 6}) {
    const Cell cell = six_axis_arm();
    const RowsN q = along_a_line(cell, number, kReflector_m, 0.03);
    Measurements m = measured_at(cell, with_waves(q), static_cast<std::uint64_t>(number), 0.5e-3);
    m.q = q;
    const Measurements unseen = pick(m, every_second(1));
    const Calibration plain = calibrate(cell, m, every_second(0));
    const Calibration series = calibrate(with_series(cell), m, every_second(0));
    EXPECT_GT(series.series_dof, 0.0);
    EXPECT_LT(held_out_excess(series, unseen), 1.05 * held_out_excess(plain, unseen)) << number;
    for (const auto& e : series.estimates)
      if (e.of_robot) {
        EXPECT_LT(std::abs(e.value - e.nominal), 8e-3) << e.name << ' ' << number;
      }
  }
}

/// Turned the wrong way about the line, the frame leaves two or three millimetres: little beside
/// the reach, but the numbers of the arm wander far off to take them up.
TEST(PosesAlongALine, AreFittedFromTheRightTurnOfTheFrameAboutIt) {
  for (const int number : {2, 24, 25, 29}) {
    const Cell cell = six_axis_arm();
    const RowsN q = along_a_line(cell, number, Vector3::Zero(), 0.06);
    const Measurements m = measured_at(cell, q, static_cast<std::uint64_t>(number), 0.5e-3);
    std::vector<int> rows(static_cast<std::size_t>(m.size()));
    std::iota(rows.begin(), rows.end(), 0);
    const Rows3 placed = residuals(m, predict_points(place_nominal(cell, m, rows), m));
    EXPECT_LT(placed.rowwise().norm().maxCoeff(), 0.5e-3) << number;
    const Calibration c = fitted(cell, m);
    EXPECT_LT(held_out_excess(c, m), 1.15) << number;
    for (const auto& e : c.estimates)
      if (e.of_robot) {
        EXPECT_LT(std::abs(e.value - e.nominal), 8e-3) << e.name << ' ' << number;
      }
  }
}

TEST(Prior, LeavesWhatThePosesShowClearlyExactlyAsItIs) {
  Cell cell = six_axis_arm();
  const Measurements m = measured_at(cell, all_over(cell), 3, 5e-3);
  const Calibration with = fitted(cell, m);
  cell.fit.prior_m = cell.fit.prior_rad = 0.0;
  const Calibration without = fitted(cell, m);
  EXPECT_FALSE(says_so(with));
  ASSERT_EQ(with.estimates.size(), without.estimates.size());
  for (std::size_t i = 0; i < with.estimates.size(); ++i)
    EXPECT_NEAR(with.estimates[i].value, without.estimates[i].value,
                0.01 * without.estimates[i].std)
        << with.estimates[i].name;
}

TEST(Prior, NamesTheJointThatHardlyMovesAndSaysHowFarItsNumbersMayGo) {
  const Cell cell = six_axis_arm();
  const Calibration c = fitted(cell, measured_along(cell, Way::kWristAlmostStill, 2));
  ASSERT_TRUE(says_so(c));
  for (const auto& p : c.remarks)
    if (p.code == "N-FIT-PRIOR") {
      EXPECT_NE(p.message.find("0.5 mm and 0.5 mrad"), std::string::npos) << p.message;
      EXPECT_NE(p.message.find("J"), std::string::npos) << p.message;
    }
}

}  // namespace
}  // namespace plumb::offline

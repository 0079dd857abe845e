// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "arm/arm_change.hpp"
#include "arm/predicted_points.hpp"
#include "cell/artefacts.hpp"
#include "fit/calibrate.hpp"
#include "fit/cell_data.hpp"
#include "fit/fit_cell.hpp"
#include "fit/point_distances.hpp"
#include "fit/point_sense.hpp"
#include "fit/unseen_points.hpp"
#include "noise/noise_floor.hpp"
#include "noise/stated_touch.hpp"
#include "noise/weights.hpp"
#include "solve/evaluation.hpp"
#include "solve/fit_lines.hpp"
#include "tests/cases/socket_arm.hpp"
#include "tests/cell/support.hpp"

/// Arms that touch sockets, simulated with kinematics of their own (tests/cases/socket_arm.hpp).
namespace plumb::offline {
namespace {

struct Touched {
  explicit Touched(const SocketPlan& plan) : arm(plan) {
    const auto file = folder.put("cell.toml", arm.cell_toml());
    folder.put("measurements.csv", arm.measurements_csv());
    cell = read_cell(file);
    measured = read_cell_measurements(cell);
  }
  std::vector<int> all_rows() const {
    std::vector<int> out(static_cast<std::size_t>(measured.size()));
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = static_cast<int>(i);
    return out;
  }

  Folder folder;
  SocketArm arm;
  Cell cell;
  MeasurementFiles measured;
};

std::vector<std::string> codes(const std::vector<Problem>& problems) {
  std::vector<std::string> out;
  for (const auto& p : problems) out.push_back(p.code);
  return out;
}

bool has(const std::vector<Problem>& problems, const std::string& code) {
  const auto all = codes(problems);
  return std::find(all.begin(), all.end(), code) != all.end();
}

double error_at_fresh_joints(Touched& touched, const ArmState& state) {
  return touched.arm.error_at_fresh_joints([&](const SocketArm::Joints& q) {
    Measurements one;
    one.q = Eigen::Map<const Eigen::RowVectorXd>(q.data(), 6);
    return Eigen::Vector3d(predict_points(state, one).row(0).transpose());
  });
}

TEST(TouchedPoints, ACalibrationFromThemIsTheTrueArm) {
  Touched t({.seed = 1, .known_distance = true});
  const Calibration c = calibrate(t.cell, t.measured, t.all_rows());
  EXPECT_LT(error_at_fresh_joints(t, c.state), 0.15e-3);
  for (std::size_t k = 0; k < t.arm.sockets().size(); k += 2) {
    const Eigen::Vector3d a = from_pose(c.state.frame(static_cast<int>(k))).p,
                          b = from_pose(c.state.frame(static_cast<int>(k) + 1)).p;
    EXPECT_NEAR((a - b).norm(), 0.080, 0.1e-3);
  }
}

/// Position readings of six axes tell 27 numbers: the arm's, the target's 3 and the frame's 6. Of
/// touched points the frame's 6 and the size are open, and each point adds 3.
TEST(TouchedPoints, TellAsManyNumbersAsAClosedFormCountSays) {
  Touched t({.seed = 2});
  const auto points = static_cast<int>(t.arm.sockets().size());
  EXPECT_EQ(calibrate(t.cell, t.measured, t.all_rows()).rank, 27 - 6 - 1 + 3 * points);
  Touched with({.seed = 2, .known_distance = true});
  EXPECT_EQ(calibrate(with.cell, with.measured, with.all_rows()).rank, 27 - 6 + 3 * points);
}

/// Least squares alone would make the arm smaller, and the more so the more the model lacks.
TEST(TouchedPoints, DoNotShrinkTheArmWhereTheModelLacksAnEffect) {
  Touched t({.seed = 3, .touches = 30, .yields_rad_per_Nm = 60e-6});
  const Calibration c = calibrate(t.cell, t.measured, t.all_rows());
  const auto size = [](const format::Chain& chain) {
    double squares = 0.0;
    for (std::size_t i = 1; i < chain.joints.size(); ++i)
      squares += std::pow(chain.joints[i].a, 2) + std::pow(chain.joints[i].d, 2);
    return std::sqrt(squares);
  };
  EXPECT_NEAR(size(c.state.arm.calibrated) / size(t.cell.nominal), 1.0, 1e-3);
  // An effect is there: the arm misses by more than the play of 30 um leaves, 48 um.
  const Rows3 left = residuals(t.measured, predict_points(c.state, t.measured));
  EXPECT_GT(left.rowwise().norm().mean(), 0.1e-3);
}

TEST(TouchedPoints, LinesHaveTheGradientOfTheirCost) {
  Touched t({.seed = 4, .placements = 4, .touches = 6});
  const Calibration c = calibrate(t.cell, t.measured, t.all_rows());
  FitData data;
  data.cell = &t.cell;
  data.measured = &t.measured;
  data.rows = t.all_rows();
  data.sigma_m = stated_sigma(t.cell, t.measured);
  data.touches = touch_density(t.measured, data.rows, c.state, c.parameters);
  // Beside the minimum, so that the gradient is not 0.
  Eigen::VectorXd away =
      1e-4 * Eigen::VectorXd::LinSpaced(static_cast<Eigen::Index>(c.parameters.size()), -1.0, 1.0);
  const ArmState start = moved(c.state, c.parameters, away);
  const Solution here = evaluate(data, start, c.parameters);
  const Eigen::VectorXd gradient = -here.jacobian.transpose() * here.residual;
  const FitLines lines(data, start, c.parameters);
  const auto cost = [&](Eigen::Index k, double step) {
    Eigen::VectorXd residual(lines.count());
    const Eigen::VectorXd change = step * Eigen::VectorXd::Unit(away.size(), k);
    EXPECT_TRUE(lines.evaluate(change, residual.data(), nullptr));
    return 0.5 * residual.squaredNorm();
  };
  for (Eigen::Index k = 0; k < away.size(); ++k) {
    const double numeric = (cost(k, 1e-7) - cost(k, -1e-7)) / 2e-7;
    EXPECT_NEAR(gradient(k), numeric, 1e-4 * gradient.norm()) << c.parameters[k].name;
  }
}

TEST(TouchedPoints, AreHeldOutByWholePlacements) {
  Touched t({.seed = 5});
  const Fit fit = fit_cell(t.cell, t.measured, {});
  EXPECT_EQ(fit.split.folds, 6);
  std::map<int, std::set<int>> placements;
  for (int i = 0; i < t.measured.size(); ++i)
    placements[fit.split.fold[static_cast<std::size_t>(i)]].insert(
        t.measured.placement[static_cast<std::size_t>(i)]);
  ASSERT_EQ(placements.size(), 6u);
  for (const auto& [fold, inside] : placements) EXPECT_EQ(inside.size(), 1u) << fold;
  // 30 um about each axis are 48 um on average; some more, because the arm is not known exactly.
  EXPECT_GT(fit.held.mean, 0.04e-3);
  EXPECT_LT(fit.held.mean, 0.08e-3);
}

TEST(TouchedPoints, TheIntervalOfADistanceHoldsTheTrueOne) {
  int inside = 0, count = 0;
  for (std::uint64_t seed = 11; seed < 15; ++seed) {
    Touched t({.seed = seed, .placements = 5, .touches = 12});
    const Calibration c = calibrate(t.cell, t.measured, t.all_rows());
    for (const PointDistance& d : point_distances(t.cell.measurement, c)) {
      EXPECT_GT(d.half_m, 5e-6);
      EXPECT_LT(d.half_m, 0.5e-3);
      inside += std::abs(d.length_m - 0.080) <= d.half_m ? 1 : 0;
      ++count;
    }
  }
  EXPECT_EQ(count, 20);
  EXPECT_GE(inside, 17);  // 95 % of 20; 16 or fewer have a chance of 0.3 %
}

TEST(TouchedPoints, ThatMovedOrContradictAreNamed) {
  const auto remarks = [](const Touched& t) {
    const Calibration c = calibrate(t.cell, t.measured, t.all_rows());
    return point_remarks(t.cell.measurement, t.measured, c);
  };
  Touched sound({.seed = 6, .known_distance = true});
  EXPECT_EQ(codes(remarks(sound)), std::vector<std::string>{});
  Touched moved_half_way({.seed = 6, .moved_m = 0.5e-3});
  const auto found = remarks(moved_half_way);
  ASSERT_EQ(codes(found), std::vector<std::string>{"W-FIT-POINT-MOVED"});
  EXPECT_NE(found.front().message.find("from pose T11 on, the tool meets '0/0'"), std::string::npos)
      << found.front().message;
  sound.cell.measurement.lengths.front().length_m = 0.082;
  EXPECT_TRUE(has(remarks(sound), "W-FIT-LENGTH"));
}

TEST(TouchedPoints, WithTwoLabelsForOneAreNamed) {
  Touched t({.seed = 7, .placements = 5});
  // Every other row of the first point gets the label of a point of its own.
  auto twin = t.cell.measurement.setups.front();
  twin.name = "twin";
  twin.target_of = 0;
  const int added = static_cast<int>(t.cell.measurement.setups.size());
  t.cell.measurement.setups.push_back(twin);
  for (int i = 0; i < 20; i += 2) t.measured.setup[static_cast<std::size_t>(i)] = added;
  const Calibration c = calibrate(t.cell, t.measured, t.all_rows());
  EXPECT_EQ(codes(point_remarks(t.cell.measurement, t.measured, c)),
            std::vector<std::string>{"W-FIT-POINT-SAME"});
}

TEST(UnseenPoints, StandWhereTheirRowsAreOnAverage) {
  Touched t({.seed = 8, .placements = 4});
  std::vector<int> fitted;
  for (int i = 40; i < t.measured.size(); ++i) fitted.push_back(i);
  Calibration c = calibrate(t.cell, t.measured, fitted);
  place_unseen_points(t.cell.measurement, t.measured, fitted, c.state);
  const Rows3 left = residuals(t.measured, predict_points(c.state, t.measured));
  EXPECT_LT(left.topRows(20).colwise().mean().norm(), 1e-12);
  EXPECT_LT(left.topRows(40).rowwise().norm().mean(), 0.1e-3);
  const Rows3 plain = predict_points(c.state, t.measured);
  const Rows3 held = predict_held_out(t.cell.measurement, t.measured, fitted, {3, 50}, c.state);
  EXPECT_NEAR(held.row(0).norm(), plain.row(3).norm() * std::sqrt(20.0 / 19.0), 1e-12);
  EXPECT_EQ(held.row(1), plain.row(50));
}

TEST(TouchedPoints, HaveTheSigmaThatTheCellStatesOfThemAndAloneThatOfAllReadings) {
  Touched t({.seed = 7, .placements = 4, .touches = 4});
  t.cell.measurement.sigma_m = 20e-6;
  EXPECT_EQ(sigma_of_touches(t.cell, t.measured), 20e-6);
  EXPECT_EQ(noise_floor(t.cell, t.measured).sigma_m, 20e-6);
  t.cell.measurement.sigma_touch_m = 40e-6;
  EXPECT_EQ(noise_floor(t.cell, t.measured).sigma_m, 40e-6);
  t.cell.measurement.sigma_m.reset();
  EXPECT_EQ(noise_floor(t.cell, t.measured).sigma_m, 40e-6);
}

}  // namespace
}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "arm/arm_change.hpp"
#include "arm/predicted_points.hpp"
#include "cell/artefacts.hpp"
#include "fit/calibrate.hpp"
#include "fit/cell_data.hpp"
#include "fit/distance_unit.hpp"
#include "fit/fit_cell.hpp"
#include "noise/weights.hpp"
#include "solve/artefact_start.hpp"
#include "solve/evaluation.hpp"
#include "solve/fit_lines.hpp"
#include "solve/frame_start.hpp"
#include "tests/cases/artefact_readings.hpp"
#include "tests/cell/support.hpp"

/// Arms whose readings are about planes, spheres and anchors, simulated with kinematics of their
/// own (tests/cases/artefact_readings.hpp).
namespace plumb::offline {
namespace {

using Kind = ArtefactPlan::Kind;

struct Read {
  explicit Read(const ArtefactPlan& plan, std::uint64_t seed) : arm({.seed = seed}) {
    const auto file = folder.put("cell.toml", arm.cell_toml());
    folder.put("measurements.csv", artefact_readings(arm, plan));
    cell = read_cell(file);
    measured = read_cell_measurements(cell);
    rows.resize(static_cast<std::size_t>(measured.size()));
    std::iota(rows.begin(), rows.end(), 0);
  }
  double error(const ArmState& state) {
    return arm.error_at_fresh_joints([&](const SocketArm::Joints& q) {
      Measurements one;
      one.q = Eigen::Map<const Eigen::RowVectorXd>(q.data(), 6);
      return Eigen::Vector3d(predict_points(state, one).row(0).transpose());
    });
  }

  Folder folder;
  SocketArm arm;
  Cell cell;
  MeasurementFiles measured;
  std::vector<int> rows;
};

struct Expected {
  Kind kind;
  int length_numbers;  // unknown lengths of one artefact
  bool size;           // whether the readings tell the size of the arm, formally
  bool length;         // whether they hold a length that tells it well
  double error_m;  // at fresh joints, of 120 readings of 20 um; without a length that of the size
};

/// Heights of some millimetres tell a size of some hundred only formally.
constexpr Expected kAll[] = {
    {Kind::kPlane, 0, false, false, 1e-3},    {Kind::kHeight, 0, true, false, 1e-3},
    {Kind::kSphere, 1, false, false, 1e-3},   {Kind::kBall, 0, true, true, 0.15e-3},
    {Kind::kDistance, 0, true, true, 0.1e-3}, {Kind::kWire, 1, true, true, 0.1e-3}};

/// Position readings of six axes tell 27 numbers: the arm's, the target's 3 and the frame's 6. Of
/// artefacts the frame's 6 are open, and the size of the arm where no length is known; each adds
/// three numbers and its unknown length.
TEST(Artefacts, TellAsManyNumbersAsAClosedFormCountSaysAndTheTrueArm) {
  for (const Expected& e : kAll) {
    SCOPED_TRACE(static_cast<int>(e.kind));
    Read read({.kind = e.kind}, 2);
    EXPECT_EQ(lacks_length(read.cell), !e.length);
    const Calibration c = calibrate(read.cell, read.measured, read.rows);
    EXPECT_EQ(c.rank, 27 - 6 - (e.size ? 0 : 1) + 6 * (3 + e.length_numbers));
    EXPECT_LT(read.error(c.state), e.error_m);
  }
}

TEST(Artefacts, LinesHaveTheGradientOfTheirCost) {
  for (const Expected& e : kAll) {
    SCOPED_TRACE(static_cast<int>(e.kind));
    Read read({.kind = e.kind, .artefacts = 4}, 4);
    const Calibration c = calibrate(read.cell, read.measured, read.rows);
    FitData data;
    data.cell = &read.cell;
    data.measured = &read.measured;
    data.rows = read.rows;
    data.sigma_m = stated_sigma(read.cell, read.measured);
    data.touches = touch_density(read.measured, data.rows, c.state, c.parameters);
    EXPECT_EQ(data.touches.empty(),
              e.kind == Kind::kHeight || e.kind == Kind::kDistance || e.kind == Kind::kWire);
    const auto count = static_cast<Eigen::Index>(c.parameters.size());
    const ArmState start =
        moved(c.state, c.parameters, 1e-4 * Eigen::VectorXd::LinSpaced(count, -1.0, 1.0));
    const Solution here = evaluate(data, start, c.parameters);
    const Eigen::VectorXd gradient = -here.jacobian.transpose() * here.residual;
    const FitLines lines(data, start, c.parameters);
    const auto cost = [&](Eigen::Index k, double step) {
      Eigen::VectorXd residual(lines.count());
      const Eigen::VectorXd change = step * Eigen::VectorXd::Unit(count, k);
      EXPECT_TRUE(lines.evaluate(change, residual.data(), nullptr));
      return 0.5 * residual.squaredNorm();
    };
    for (Eigen::Index k = 0; k < count; ++k) {
      const double numeric = (cost(k, 1e-7) - cost(k, -1e-7)) / 2e-7;
      EXPECT_NEAR(gradient(k), numeric, 1e-4 * gradient.norm())
          << c.parameters[static_cast<std::size_t>(k)].name;
    }
  }
}

/// The held-out error is that at artefacts of which no reading was fitted, about the plane or the
/// sphere that fits their own readings best, corrected for that: about the noise of one line.
TEST(Artefacts, AreHeldOutWholeAndJudgedByTheirOwnSpread) {
  for (const Kind kind : {Kind::kPlane, Kind::kBall, Kind::kDistance, Kind::kWire}) {
    SCOPED_TRACE(static_cast<int>(kind));
    Read read({.kind = kind, .artefacts = 8, .readings = 25}, 5);
    const Fit fit = fit_cell(read.cell, read.measured, {});
    EXPECT_EQ(fit.split.folds, 8);
    const double noise = std::sqrt(2.0 / M_PI) * 20e-6;  // mean of |normal|
    EXPECT_GT(fit.held.mean, 0.9 * noise);
    EXPECT_LT(fit.held.mean, 2.0 * noise);
  }
}

/// A reading that is left out of the fit is one bad reading of its placement, and no more.
TEST(Artefacts, ABadReadingDoesNotSpoilTheOthersOfItsPlacement) {
  Read read({.kind = Kind::kDistance, .artefacts = 8, .readings = 25}, 5);
  const double clean = fit_cell(read.cell, read.measured, {}).held.mean;
  read.measured.p_M(30, 0) += 0.003;
  const Fit fit = fit_cell(read.cell, read.measured, {});
  ASSERT_EQ(fit.held_outliers.size(), 1u);
  EXPECT_EQ(fit.held_outliers.front().row, 30);
  EXPECT_LT(fit.held_without_outliers.mean, 1.2 * clean);
}

TEST(Artefacts, OfFewPlacesAreSaidToSayLittleOfOthers) {
  const auto says = [](int artefacts) {
    Read read({.kind = Kind::kBall, .artefacts = artefacts, .readings = 60}, 9);
    const Fit fit = fit_cell(read.cell, read.measured, {});
    return std::any_of(fit.remarks.begin(), fit.remarks.end(),
                       [](const Problem& p) { return p.code == "W-FIT-PLACES"; });
  };
  EXPECT_TRUE(says(2));
  EXPECT_FALSE(says(4));
}

/// A length that hardly tells the size leaves it open: here distances as short as some millimetres.
TEST(Artefacts, LeaveTheSizeOpenWhereTheirLengthsTellItLessWellThanTheTolerance) {
  Read wire({.kind = Kind::kWire, .artefacts = 6, .readings = 30}, 10);
  EXPECT_FALSE(fit_cell(wire.cell, wire.measured, {}).size_unknown);
  wire.cell.tolerance_m = 1e-6;
  EXPECT_TRUE(fit_cell(wire.cell, wire.measured, {}).size_unknown);
}

TEST(Artefacts, ThatAreLeftOutAreNoFolds) {
  Read read({.kind = Kind::kPlane, .artefacts = 8, .readings = 25}, 5);
  for (int i = 0; i < 50; ++i) read.measured.set[static_cast<std::size_t>(i)] = SetMark::kIgnore;
  EXPECT_EQ(fit_cell(read.cell, read.measured, {}).split.folds, 6);
}

TEST(Artefacts, APlaneThatMovedIsSaid) {
  Read still({.kind = Kind::kPlane}, 6), moved({.kind = Kind::kPlane, .moved_m = 2e-3}, 6);
  const auto says = [](const Fit& fit) {
    return std::any_of(fit.remarks.begin(), fit.remarks.end(),
                       [](const Problem& p) { return p.code == "W-FIT-POINT-MOVED"; });
  };
  EXPECT_FALSE(says(fit_cell(still.cell, still.measured, {})));
  EXPECT_TRUE(says(fit_cell(moved.cell, moved.measured, {})));
}

TEST(DistanceUnit, IsDoubtedWhereOnlyAnotherOneMeetsTheArm) {
  for (const Kind kind : {Kind::kDistance, Kind::kWire}) {
    Read read({.kind = kind}, 8);
    const auto remarks = [&](double times) {
      MeasurementFiles some = read.measured;
      some.p_M *= times;
      some.tables.front().remarks.clear();
      warn_of_distance_unit(read.cell, some);
      return some.tables.front().remarks;
    };
    EXPECT_TRUE(remarks(1.0).empty());
    EXPECT_TRUE(remarks(1.05).empty());
    ASSERT_EQ(remarks(1.0 / 25.4).size(), 1u);
    EXPECT_NE(remarks(1.0 / 25.4)[0].message.find("as inches are to mm"), std::string::npos);
    EXPECT_NE(remarks(1e3)[0].message.find("as mm are to metres"), std::string::npos);
  }
}

TEST(ArtefactStart, OfAWireIsItsAnchorAndItsZeroWhereTheTargetIsKnown) {
  Read read({.kind = Kind::kWire, .artefacts = 1, .readings = 30, .sigma_m = 0.0}, 7);
  ArmState truth;
  truth.arm.calibrated = read.cell.nominal;
  place_as_given(read.cell.measurement, truth);
  for (std::size_t i = 0; i < 6; ++i) {
    auto& row = truth.arm.calibrated.joints[i];
    row.theta = read.arm.rows()[i][0];
    row.d = read.arm.rows()[i][1];
    row.a = read.arm.rows()[i][2];
    row.alpha = read.arm.rows()[i][3];
  }
  truth.target(0).p = {0.0123, -0.0081, 0.095};
  const ArmState start = artefact_starts(read.measured, truth, 0, true).front();
  EXPECT_NEAR(start.length(0), 0.3127, 1e-6);
  const Rows3 left = residuals(read.measured, predict_points(start, read.measured));
  EXPECT_LT(left.cwiseAbs().maxCoeff(), 1e-6);
}

}  // namespace
}  // namespace plumb::offline

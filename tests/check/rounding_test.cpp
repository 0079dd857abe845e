// SPDX-License-Identifier: Apache-2.0
// Numbers that were written with too few digits, and what that costs.
#include "check/rounding.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "arm/predicted_points.hpp"
#include "tests/check/simulated_arm.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::offline {
namespace {

constexpr double kDegree = M_PI / 180.0;

Column column_of(const std::string& name, const std::string& unit, double si_of_unit,
                 const std::vector<double>& in_unit) {
  Column out;
  out.header = name + "_" + unit;
  out.name = name;
  out.unit = unit;
  for (const double value : in_unit) out.values.push_back(value * si_of_unit);
  return out;
}

/// A file that holds nothing but these columns.
Table table_of(std::vector<Column> columns) {
  Table out;
  out.file = "measurements.csv";
  out.columns = std::move(columns);
  for (std::size_t i = 0; i < out.columns.front().values.size(); ++i)
    out.lines.push_back(static_cast<int>(i) + 2);
  out.raw_rows.resize(out.lines.size());
  out.header_line = 1;
  for (const Column& column : out.columns)
    out.raw_header += (out.raw_header.empty() ? "" : ",") + column.header;
  return out;
}

MeasurementFiles files_of(std::vector<Table> tables) {
  MeasurementFiles out;
  out.tables = std::move(tables);
  return out;
}

/// Multiples of a step, neighbours among them, so that no coarser step fits all.
std::vector<double> multiples_of(double step, tests::Random& random, int count = 40) {
  std::vector<double> out;
  for (int i = 0; i < count; ++i) out.push_back(step * (i < 2 ? 100 + i : random.below(3000)));
  return out;
}

std::vector<double> any_values(tests::Random& random, int count = 40) {
  std::vector<double> out;
  for (int i = 0; i < count; ++i) out.push_back(random.uniform(-2000.0, 2000.0));
  return out;
}

NoiseFloor noise_of(double sigma_m) {
  NoiseFloor out;
  out.sigma_m = sigma_m;
  out.rms_m = std::sqrt(3.0) * sigma_m;
  out.source = NoiseFloor::Source::kSigma;
  return out;
}

TEST(PointSteps, AreThoseThatTheValuesWereRoundedTo) {
  tests::Random random(1);
  for (const auto& [unit, si] : {std::pair{"mm", 1e-3}, std::pair{"um", 1e-6}, std::pair{"m", 1.0}})
    for (const double leading : {1.0, 2.0, 2.5, 5.0})
      for (int tens = -4; tens <= 2; ++tens) {
        const double step = leading * std::pow(10.0, tens);
        const auto found = point_steps(
            files_of({table_of({column_of("x", unit, si, any_values(random)),
                                column_of("z", unit, si, multiples_of(step, random))})}));
        EXPECT_NEAR(found[2], step * si, 1e-9 * step * si) << unit << " " << step;
        EXPECT_EQ(found[0], 0.0);
        EXPECT_EQ(found[1], 0.0);
      }
}

TEST(PointSteps, AreNotTakenFromAFewValues) {
  tests::Random random(2);
  const auto of = [&](const std::vector<double>& x) {
    return point_steps(files_of({table_of({column_of("x", "mm", 1e-3, x)})}))[0];
  };
  EXPECT_EQ(of(multiples_of(1.0, random, 5)), 0.0);
  EXPECT_EQ(of(std::vector<double>(100, 250.0)), 0.0) << "one value, often";
  EXPECT_GT(of(multiples_of(1.0, random, 40)), 0.0);
}

TEST(PointSteps, OfSeveralFilesAreTheCoarsest) {
  tests::Random random(3);
  std::vector<Table> tables;
  for (const double step : {0.01, 0.5, 0.1})
    tables.push_back(table_of({column_of("x", "mm", 1e-3, multiples_of(step, random))}));
  EXPECT_NEAR(point_steps(files_of(tables))[0], 0.5e-3, 1e-12);
}

/// Noise of sigma and a uniform error of +-step/2 together scatter by
/// sqrt(sigma^2 + step^2 / 12).
TEST(CoarsePoints, AreSaidWhereRoundingAddsATenthOrMoreToTheNoise) {
  tests::Random random(4);
  constexpr double kStep_m = 0.1e-3;
  const MeasurementFiles files =
      files_of({table_of({column_of("y", "mm", 1e-3, multiples_of(0.1, random))})});
  int said = 0, silent = 0;
  for (double sigma = 5e-6; sigma < 500e-6; sigma *= 1.1) {
    const double more = std::sqrt(sigma * sigma + kStep_m * kStep_m / 12.0) / sigma - 1.0;
    if (more > 0.1 && more < 0.13) continue;  // about the edge
    const auto found = coarse_points(files, noise_of(sigma));
    EXPECT_EQ(found.size(), more > 0.1 ? 1U : 0U) << sigma;
    (found.empty() ? silent : said) += 1;
  }
  EXPECT_GT(said, 10);
  EXPECT_GT(silent, 10);
}

TEST(CoarsePoints, AreSaidOnceAFileWithItsWorstCoordinate) {
  tests::Random random(5);
  const Table coarse = table_of({column_of("x", "mm", 1e-3, multiples_of(0.2, random)),
                                 column_of("y", "mm", 1e-3, multiples_of(1.0, random)),
                                 column_of("z", "mm", 1e-3, any_values(random))});
  const Table fine = table_of({column_of("x", "mm", 1e-3, any_values(random))});
  const auto found = coarse_points(files_of({coarse, fine, coarse}), noise_of(20e-6));
  ASSERT_EQ(found.size(), 2U);
  for (const Problem& problem : found) {
    EXPECT_EQ(problem.code, "W-CHECK-COARSE");
    EXPECT_TRUE(holds(problem.message, "rounded to 1 mm")) << problem.message;
  }
}

TEST(CoarsePoints, OfAnUnknownNoiseAreThoseThatNoTrackerWrites) {
  tests::Random random(6);
  const auto of = [&](double step_mm) {
    return coarse_points(
        files_of({table_of({column_of("x", "mm", 1e-3, multiples_of(step_mm, random))})}), {});
  };
  EXPECT_TRUE(of(0.001).empty());
  EXPECT_TRUE(of(0.01).empty());
  EXPECT_EQ(of(0.5).size(), 1U);
}

/// An arm that holds its joint positions in files, rounded to these steps [rad or m].
struct Rounded {
  Rounded(Cell of, const std::vector<double>& steps, const std::vector<std::string>& units)
      : cell(std::move(of)) {
    const Simulation simulation = simulate(cell, plan_of_arm(3, 60, 0.0));
    measured = simulation.measured;
    placed.arm.calibrated = cell.nominal;
    placed.X_MB = simulation.X_MB;
    placed.X_TG = simulation.X_TG;
    std::vector<Column> columns;
    for (int j = 0; j < cell.joints(); ++j) {
      const double step = steps[static_cast<std::size_t>(j)];
      Column column;
      column.name = fmt::format("q{}", j + 1);
      column.unit = units[static_cast<std::size_t>(j)];
      for (double& q : measured.q.col(j)) {
        if (step > 0.0) q = step * std::round(q / step);
        column.values.push_back(q);
      }
      columns.push_back(column);
    }
    measured.tables = {table_of(std::move(columns))};
    for (int i = 0; i < measured.size(); ++i) rows.push_back(i);
  }
  std::optional<Rounding> found() const { return joint_rounding(cell, measured, rows, placed); }

  Cell cell;
  MeasurementFiles measured;
  ArmState placed;
  std::vector<int> rows;
};

/// Root mean square of the motion of the reflector if every reading is off by up to half a step.
double by_trial(const Rounded& at, const std::vector<double>& steps) {
  constexpr int kTrials = 100;
  tests::Random random(7);
  const Rows3 before = predict_points(at.placed, at.measured.q);
  double squares = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    RowsN q = at.measured.q;
    for (Eigen::Index j = 0; j < q.cols(); ++j)
      for (double& one : q.col(j))
        one += steps[static_cast<std::size_t>(j)] * random.uniform(-0.5, 0.5);
    squares += (predict_points(at.placed, q) - before).squaredNorm();
  }
  return std::sqrt(squares / (kTrials * static_cast<double>(at.measured.size())));
}

TEST(JointRounding, AtTheToolIsWhatReadingsOffByHalfAStepDo) {
  const double hundredth = 0.01 * kDegree, tenth = 0.1 * kDegree;
  const std::vector<double> turning{hundredth, tenth, hundredth, 0.0, tenth, tenth};
  const Rounded six(six_joint_cell(3), turning, std::vector<std::string>(6, "deg"));
  const auto found = six.found();
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->at_tool_m, by_trial(six, turning), 0.02 * found->at_tool_m);
  EXPECT_NEAR(found->step, tenth, 1e-12) << "the coarsest of all";
  EXPECT_NEAR(found->step_in_unit, 0.1, 1e-12);
  EXPECT_EQ(found->unit, "deg");

  const std::vector<double> sliding{hundredth, hundredth, 1e-3, hundredth};
  const Rounded scara(random_cell(3, 4, format::Convention::kStandard, ArmKind::kScara), sliding,
                      {"deg", "deg", "mm", "deg"});
  const auto of_scara = scara.found();
  ASSERT_TRUE(of_scara);
  EXPECT_NEAR(of_scara->at_tool_m, by_trial(scara, sliding), 0.02 * of_scara->at_tool_m);
  EXPECT_EQ(of_scara->unit, "mm");
}

TEST(JointRounding, IsNoneWhereAllDigitsAreThereOrOneFileHasThem) {
  const std::vector<std::string> degrees(6, "deg");
  const Rounded exact(six_joint_cell(3), std::vector<double>(6, 0.0), degrees);
  EXPECT_FALSE(exact.found());
  Rounded both(six_joint_cell(3), std::vector<double>(6, 0.01 * kDegree), degrees);
  EXPECT_TRUE(both.found());
  both.measured.tables.push_back(exact.measured.tables.front());
  EXPECT_FALSE(both.found());
}

Rounding of_size(double at_tool_m) {
  Rounding out;
  out.step = out.step_in_unit = 0.01;
  out.unit = "deg";
  out.at_tool_m = at_tool_m;
  return out;
}

TEST(RoundingFindings, AreSaidFromASizeOnThatTheNoiseDoesNotHide) {
  const NoiseFloor floor = noise_of(20e-6);
  bool before = false;
  for (double size = 1e-6; size < 1e-3; size *= 1.2) {
    const bool said = !rounding_findings(of_size(size), floor, std::nullopt).empty();
    EXPECT_TRUE(said || !before) << size;
    before = said;
    if (size < 0.2 * floor.rms_m) {
      EXPECT_FALSE(said) << size;
    }
    if (size > floor.rms_m) {
      EXPECT_TRUE(said) << size;
    }
  }
}

TEST(RoundingFindings, AreNotSaidOfRoundCommandsWhichLeaveLessThanTheirRounding) {
  const Rounding rounding = of_size(0.2e-3);
  for (const NoiseFloor& floor : {noise_of(20e-6), NoiseFloor{}}) {
    EXPECT_TRUE(rounding_findings(rounding, floor, 0.03e-3).empty());
    const auto said = rounding_findings(rounding, floor, 0.21e-3);
    ASSERT_EQ(said.size(), 1U);
    EXPECT_EQ(said.front().code, "W-CHECK-ROUNDED");
  }
}

TEST(RoundingFindings, OfAnUnknownNoiseAskForAFitThatLeavesJustThat) {
  const Rounding rounding = of_size(0.2e-3);
  EXPECT_TRUE(rounding_findings(rounding, {}, std::nullopt).empty());
  EXPECT_TRUE(rounding_findings(rounding, {}, 2e-3).empty()) << "something else is left";
  EXPECT_FALSE(rounding_findings(rounding, noise_of(20e-6), std::nullopt).empty());
}

}  // namespace
}  // namespace plumb::offline

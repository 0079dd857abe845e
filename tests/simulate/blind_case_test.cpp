// SPDX-License-Identifier: Apache-2.0
#include "tests/cases/blind_case.hpp"
#include "cell/measurement_reader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "program/file.hpp"

namespace plumb::offline {
namespace {

using Eigen::Vector3d;

TEST(BlindCase, TheSameRequestGivesTheSameBytes) {
  BlindRequest request;
  request.effects = {"thermal_growth::4", "reversal:J2:2"};
  request.outlier_share = 0.02;
  request.choice.order = PoseChoice::Order::kNearest;
  const auto a = make_blind_case(request), b = make_blind_case(request);
  EXPECT_EQ(a.cell_toml, b.cell_toml);
  EXPECT_EQ(a.measurements_csv, b.measurements_csv);
  EXPECT_EQ(a.fresh_csv, b.fresh_csv);
  EXPECT_EQ(a.fresh_robot_csv, b.fresh_robot_csv);
  EXPECT_EQ(a.truth_json, b.truth_json);
  request.seed = 2;
  EXPECT_NE(make_blind_case(request).measurements_csv, a.measurements_csv);
}

TEST(BlindCase, WhatADiagnosisSeesDoesNotTellWhatIsHidden) {
  BlindRequest plain, hiding;
  plain.fresh_poses = hiding.fresh_poses = 5;
  hiding.effects = {"tool_wander::5", "settling_lag::2"};
  const auto a = make_blind_case(plain), b = make_blind_case(hiding);
  EXPECT_EQ(a.cell_toml, b.cell_toml);
  const auto header = [](const std::string& csv) { return csv.substr(0, csv.find("\nP0")); };
  EXPECT_EQ(header(a.measurements_csv), header(b.measurements_csv));
  EXPECT_EQ(a.measured.measured.q, b.measured.measured.q);
}

TEST(BlindCase, NoiseHasTheRequestedSigmaAndOutliersAreListed) {
  BlindRequest request;
  request.poses = 3000;
  request.repeats = 1;
  request.fresh_poses = 5;
  request.sigma_m = 25e-6;
  request.outlier_share = 0.02;
  request.effects = {"gear_ripple:J2:2"};
  const auto made = make_blind_case(request);
  const auto& s = made.measured;
  ASSERT_EQ(s.outliers.size(), 60U);
  const auto listed = nlohmann::json::parse(made.truth_json)["outliers"];
  ASSERT_EQ(listed.size(), 60U);
  Rows3 noise = s.measured.p_M - s.true_p_M;
  for (std::size_t k = 0; k < 60; ++k) {
    EXPECT_EQ(listed[k]["pose"], s.measured.pose[s.outliers[k].row]);
    const Vector3d moved(s.outliers[k].shift_M.data());
    EXPECT_GE(moved.norm(), 29.9 * request.sigma_m);
    noise.row(s.outliers[k].row) -= moved.transpose();
  }
  const double n = 3.0 * 3000;
  EXPECT_NEAR((noise / request.sigma_m).squaredNorm(), n, 4 * std::sqrt(2 * n));
}

// Reads texts with the strict reader.
MeasurementFiles read_back(const std::string& csv, int joints) {
  const auto file = std::filesystem::temp_directory_path() / "plumb_blind_case_test.csv";
  write_file_atomically(file, csv);
  const auto out =
      read_measurements({file}, std::vector<bool>(joints, true), Needs::kJointsAndPosition);
  std::filesystem::remove(file);
  return out;
}

TEST(BlindCase, EveryFileIsAcceptedByTheStrictReaders) {
  for (const auto arm :
       {BlindArm::kHeavy, BlindArm::kLight, BlindArm::kPlanarPublished, BlindArm::kPlanarPrinted}) {
    BlindRequest request;
    request.arm = arm;
    request.held_share = 0.2;
    request.fresh_poses = 40;
    const auto made = make_blind_case(request);
    const Cell cell = parse_cell(made.cell_toml, "/nowhere/cell.toml");
    EXPECT_EQ(cell.joints(), made.cell.joints());
    EXPECT_EQ(cell.measurement.sigma_m, request.sigma_m);
    const auto back = read_back(made.measurements_csv, cell.joints());
    EXPECT_EQ(back.size(), 150 + 15 * 2);
    EXPECT_GT(std::count(back.set.begin(), back.set.end(), SetMark::kHeld), 10);
    EXPECT_LT((back.p_M - made.measured.measured.p_M).cwiseAbs().maxCoeff(), 1e-12);
    for (const auto& column : made.measured.context) {
      ASSERT_NE(back.tables.at(0).find(column.name), nullptr) << column.header;
    }
    EXPECT_EQ(read_back(made.fresh_csv, cell.joints()).size(), 40);
    EXPECT_EQ(read_back(made.fresh_robot_csv, cell.joints()).size(), 40);
  }
}

TEST(BlindCase, ContextsVaryAndAllReadingsOfAPoseShareThem) {
  const auto made = make_blind_case({});
  const auto& table = made.measured.measured.tables.at(0);
  for (const char* name :
       {"payload", "payload_cx", "temp", "temp_room", "temp_elbow", "dir_j3", "travel_j3", "t"}) {
    const auto* column = table.find(name);
    ASSERT_NE(column, nullptr) << name;
    const auto [low, high] = std::minmax_element(column->values.begin(), column->values.end());
    EXPECT_LT(*low, *high) << name;
  }
  const auto& groups = made.measured.measured.replicate_group;
  for (std::size_t row = 1; row < groups.size(); ++row) {
    if (groups[row] != groups[row - 1]) continue;
    for (const char* name : {"payload", "dir_j3", "travel_j3"}) {
      EXPECT_EQ(table.find(name)->values[row], table.find(name)->values[row - 1]);
    }
  }
}

TEST(BlindCase, TheArmAtFreshPosesIsTheSameArm) {
  BlindRequest request;
  request.effects = {"step_reflector::20", "gear_harmonics:J2:5"};
  const auto made = make_blind_case(request);
  EXPECT_EQ(made.fresh.true_chain, made.measured.true_chain);
  EXPECT_EQ(made.fresh.X_MB, made.measured.X_MB);
  EXPECT_EQ(made.fresh.measured.p_M, made.fresh.true_p_M);
  ASSERT_EQ(made.fresh.effects.size(), 2U);
  EXPECT_EQ(made.fresh.effects[0].size, made.measured.effects[0].size);
  EXPECT_EQ(made.fresh.effects[0].numbers, made.measured.effects[0].numbers);
  ASSERT_EQ(made.fresh_robot.effects.size(), 1U) << "the reflector does not slip on the robot";
  EXPECT_EQ(made.fresh_robot.effects[0].name, "gear_harmonics");
  // Both sets agree until the reflector slips, and differ by the slip afterwards.
  const double at_s = made.measured.effects[0].numbers.at("at_s");
  const auto& t = made.fresh.context.front().values;
  const double slip = *made.measured.effects[0].size;
  for (int row = 0; row < 500; ++row) {
    const double apart = (made.fresh.true_p_M.row(row) - made.fresh_robot.true_p_M.row(row)).norm();
    EXPECT_NEAR(apart, t[row] > at_s ? slip : 0.0, 1e-9);
  }
}

TEST(BlindCase, GridPosesLieOnTheirGridAndTheVisitingOrderIsShort) {
  BlindRequest request;
  request.choice.grid_levels = 7;
  request.repeats = 1;
  request.fresh_poses = 5;
  const auto grid = make_blind_case(request).measured.measured.q;
  for (int j = 0; j < 6; ++j) {
    std::vector<double> values(grid.rows());
    for (int row = 0; row < grid.rows(); ++row) values[row] = std::round(1e9 * grid(row, j));
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    EXPECT_LE(values.size(), 7U);
  }
  const auto way = [](const RowsN& q) {
    return (q.bottomRows(q.rows() - 1) - q.topRows(q.rows() - 1)).rowwise().norm().sum();
  };
  request.choice = {};
  const auto drawn = make_blind_case(request).measured.measured.q;
  request.choice.order = PoseChoice::Order::kNearest;
  const auto sorted = make_blind_case(request).measured.measured.q;
  EXPECT_LT(way(sorted), 0.7 * way(drawn));
  EXPECT_NEAR(sorted.sum(), drawn.sum(), 1e-9) << "the same poses in another order";
}

TEST(BlindCase, AnInvisibleEffectIsRefusedWithAReason) {
  BlindRequest request;
  request.climate = SimulationPlan::Climate::kConstant;
  request.effects = {"thermal_growth::3"};
  try {
    make_blind_case(request);
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.problems().at(0).code, "E-SIM-SIZE");
    EXPECT_EQ(failure.exit_code(), Exit::kUsage);
  }
}

}  // namespace
}  // namespace plumb::offline

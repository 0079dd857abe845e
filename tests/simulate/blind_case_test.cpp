// SPDX-License-Identifier: Apache-2.0
#include "simulate/blind_case.hpp"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "cell/file.hpp"
#include "simulate/arm.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::offline {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Derivatives of every measured point by the twists of the chain, by central differences through
// the simulator's own kinematics: base, behind every joint, tool.
MatrixXd geometry_columns(const BlindCase& made) {
  const auto& s = made.measured;
  const int n = made.cell.joints();
  const double h = 1e-5;
  MatrixXd J(3 * s.measured.size(), 6 * (n + 2));
  const auto nudged = [&](int column, double by) {
    format::Chain chain = s.true_chain;
    const int slot = column / 6, k = column % 6;
    format::Twist& twist = slot == 0       ? chain.base_twist
                           : slot == n + 1 ? chain.tool_twist
                                           : chain.joints[slot - 1].post;
    (k < 3 ? twist.d[k] : twist.e[k - 3]) += by;
    return sim::Arm(chain);
  };
  for (int column = 0; column < J.cols(); ++column) {
    const sim::Arm up = nudged(column, h), down = nudged(column, -h);
    for (int row = 0; row < s.measured.size(); ++row) {
      const VectorXd q = s.measured.q.row(row).transpose();
      const Vector3d p(s.X_TG.p.data());
      J.block<3, 1>(3 * row, column) = sim::to_isometry(s.X_MB).linear() *
                                       (up.frames(q).tool * p - down.frames(q).tool * p) / (2 * h);
    }
  }
  return J;
}

// Shift of every point by the hidden effects: what was measured less what the rigid arm would give.
VectorXd shift(const BlindCase& made) {
  const auto& s = made.measured;
  const sim::Arm arm(s.true_chain);
  VectorXd out(3 * s.measured.size());
  for (int row = 0; row < s.measured.size(); ++row) {
    const VectorXd q = s.measured.q.row(row).transpose();
    out.segment<3>(3 * row) =
        s.true_p_M.row(row).transpose() -
        sim::to_isometry(s.X_MB) * (arm.frames(q).tool * Vector3d(s.X_TG.p.data()));
  }
  return out;
}

// Per-axis RMS of what least squares in the geometry leaves.
double left_over(const MatrixXd& J, const VectorXd& y) {
  const Eigen::BDCSVD<MatrixXd> svd(J, Eigen::ComputeThinU | Eigen::ComputeThinV);
  int rank = 0;
  while (rank < svd.singularValues().size() &&
         svd.singularValues()(rank) > 1e-7 * svd.singularValues()(0)) {
    ++rank;
  }
  EXPECT_EQ(rank, 27) << "six joints seen through one point";
  const MatrixXd U = svd.matrixU().leftCols(rank);
  return (y - U * (U.transpose() * y)).norm() / std::sqrt(static_cast<double>(y.size()));
}

std::vector<std::string> unsized_names() { return {"planar_published", "planar_printed"}; }

std::vector<std::string> arm_effects() {
  std::vector<std::string> out;
  const auto no = unsized_names();
  for (const auto& [name, line] : simulated_effects()) {
    if (std::find(no.begin(), no.end(), name) == no.end()) out.push_back(name);
  }
  return out;
}

TEST(BlindCase, EveryEffectHasTheRequestedVisibleSizeOnBothArms) {
  for (const auto arm : {BlindArm::kHeavy, BlindArm::kLight}) {
    MatrixXd J;
    for (const auto& name : arm_effects()) {
      BlindRequest request;
      request.arm = arm;
      request.poses = 80;
      request.fresh_poses = 5;
      request.seed = 11;
      request.effects = {name + "::3"};
      const auto made = make_blind_case(request);
      if (J.size() == 0) J = geometry_columns(made);  // same poses for all of them
      const double left = left_over(J, shift(made));
      EXPECT_NEAR(left / request.sigma_m, 3.0, 0.03) << name;
      const auto size = nlohmann::json::parse(made.truth_json)["effects"][0]["size"];
      EXPECT_NEAR(size["visible_sigma"], 3.0, 0.01) << name;
    }
  }
}

TEST(BlindCase, SeveralEffectsHaveEachItsOwnSize) {
  BlindRequest request;
  request.effects = {"joint_compliance:J2:5", "gear_harmonics:J1:2", "drift::1"};
  request.fresh_poses = 5;
  const auto made = make_blind_case(request);
  const auto truth = nlohmann::json::parse(made.truth_json)["effects"];
  const double wanted[] = {5.0, 2.0, 1.0};
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(truth[k]["size"]["visible_sigma"], wanted[k], 0.01);
}

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
Measurements read_back(const std::string& csv, int joints) {
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

TEST(BlindCase, RandomCasesAreFiniteAndAlwaysOfTheRequestedSize) {
  const long count = tests::scaled(1000);
  const std::uint64_t seed = 20260801;
  std::cout << count << " random cases, seed " << seed << "\n";
  tests::Random random(seed);
  const auto names = arm_effects();
  long refused = 0;
  for (long k = 0; k < count; ++k) {
    BlindRequest request;
    request.arm = random.below(2) == 0 ? BlindArm::kHeavy : BlindArm::kLight;
    request.seed = random.bits();
    request.poses = 30 + random.below(30);
    request.fresh_poses = 10;
    request.sigma_m = random.uniform(10e-6, 30e-6);
    request.outlier_share = random.below(4) == 0 ? 0.02 : 0.0;
    request.choice.grid_levels = random.below(4) == 0 ? 5 + random.below(4) : 0;
    request.choice.range = random.uniform(0.5, 1.0);
    if (random.below(3) == 0) request.choice.order = PoseChoice::Order::kNearest;
    if (random.below(4) == 0) request.payloads = BlindRequest::Payloads::kConstant;
    const double size = random.uniform(0.5, 10.0);
    const std::string& name = names[static_cast<std::size_t>(k) % names.size()];
    request.effects = {name + "::" + std::to_string(size)};
    try {
      const auto made = make_blind_case(request);
      EXPECT_TRUE(made.measured.measured.p_M.allFinite()) << name;
      EXPECT_TRUE(made.fresh.true_p_M.allFinite()) << name;
      EXPECT_EQ(made.truth_json.find("null"), std::string::npos) << name;  // JSON's NaN
      EXPECT_NEAR(made.measured.sizes.at(0).visible_m / request.sigma_m / size, 1.0, 0.01) << name;
    } catch (const Failure& failure) {
      ++refused;
      ADD_FAILURE() << name << ": " << failure.what();
    }
  }
  EXPECT_EQ(refused, 0);
}

TEST(Laws, StayFiniteOnRandomArmsOrSayWhyTheyCannotBe) {
  const long count = tests::scaled(1000);
  const std::uint64_t seed = 77;
  std::cout << count << " random arms, seed " << seed << "\n";
  tests::Random random(seed);
  const auto names = arm_effects();
  long made = 0;
  for (long k = 0; k < count; ++k) {
    const bool scara = random.below(4) == 0;
    const Cell cell = random_cell(
        random.bits() % 100000, scara ? 4 : 4 + random.below(4),
        random.below(2) == 0 ? format::Convention::kStandard : format::Convention::kModified,
        scara ? ArmKind::kScara : ArmKind::kRevolute);
    SimulationPlan plan;
    plan.poses = 25;
    plan.seed = random.bits();
    plan.truth.mass_share = 0.3;
    const std::string& name = names[static_cast<std::size_t>(k) % names.size()];
    plan.truth.effects = {name};
    if (random.below(2) == 0) plan.payloads = {{0.0, {}}, {8.0, {0.1, 0.0, 0.05}}};
    try {
      const auto s = simulate(cell, plan);
      ++made;
      EXPECT_TRUE(s.measured.p_M.allFinite()) << name;
      const double rms_mm = s.sizes.at(0).rms_m * 1e3;
      EXPECT_LT(rms_mm, 2.0) << name << " at its usual size";
      for (const auto& column : s.context) {
        for (const double value : column.values) ASSERT_TRUE(std::isfinite(value)) << column.header;
      }
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.exit_code(), Exit::kUsage) << name;
      EXPECT_EQ(failure.problems().at(0).code, "E-SIM-JOINT") << name;
    }
  }
  EXPECT_GT(made, count * 7 / 10);
}

}  // namespace
}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#include "simulate/simulate.hpp"
#include "cell/measurement_reader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "program/file.hpp"
#include "simulate/random.hpp"

namespace plumb::offline {
namespace {

SimulationPlan everything(std::uint64_t seed) {
  SimulationPlan plan = make_demo("gear").plan;
  plan.seed = seed;
  plan.truth.effects = {"joint_compliance", "gear_harmonics", "link_flexure", "drift", "reversal"};
  return plan;
}

TEST(Random, IsTheSameOnEveryCompiler) {
  sim::Random random(1, "pinned");
  EXPECT_EQ(random.bits(), 8894199013123876538ULL);
  EXPECT_EQ(random.bits(), 3732680988957024364ULL);
  EXPECT_NEAR(random.normal(), -1.7335111309692441, 1e-15);
}

TEST(Random, NormalValuesHaveTheirFirstFourMoments) {
  const int n = 200000;
  sim::Random random(5, "moments");
  std::cout << n << " values, seed 5\n";
  double m1 = 0, m2 = 0, m3 = 0, m4 = 0;
  for (int k = 0; k < n; ++k) {
    const double x = random.normal();
    m1 += x / n, m2 += x * x / n, m3 += x * x * x / n, m4 += x * x * x * x / n;
  }
  const double se = 1.0 / std::sqrt(n);
  EXPECT_NEAR(m1, 0.0, 4 * se);
  EXPECT_NEAR(m2, 1.0, 4 * std::sqrt(2.0) * se);
  EXPECT_NEAR(m3, 0.0, 4 * std::sqrt(15.0) * se);
  EXPECT_NEAR(m4, 3.0, 4 * std::sqrt(96.0) * se);
}

TEST(Simulate, GivesTheSameBitsForTheSamePlan) {
  const Cell cell = make_demo("gear").cell;
  const auto a = simulate(cell, everything(3)), b = simulate(cell, everything(3));
  EXPECT_EQ(a.truth_json, b.truth_json);
  EXPECT_EQ(a.measured.p_M, b.measured.p_M);
  EXPECT_EQ(a.measured.q, b.measured.q);
  EXPECT_NE(simulate(cell, everything(4)).truth_json, a.truth_json);
}

TEST(Simulate, SeedOfTheArmKeepsTheArmAtFreshPoses) {
  const Cell cell = make_demo("gear").cell;
  SimulationPlan plan = everything(3);
  plan.truth.seed = 3;
  const auto a = simulate(cell, plan);
  plan.seed = 99;
  plan.poses = 77;
  const auto b = simulate(cell, plan);
  EXPECT_NE(a.measured.q.row(0), b.measured.q.row(0));
  auto ta = nlohmann::json::parse(a.truth_json), tb = nlohmann::json::parse(b.truth_json);
  for (auto* truth : {&ta, &tb}) {  // seen at other poses, the same numbers have another size
    for (auto& effect : (*truth)["effects"]) EXPECT_EQ(effect.erase("size"), 1U);
  }
  for (const char* key : {"parameters", "frame", "target_mm", "effects"})
    EXPECT_EQ(ta[key], tb[key]);
}

TEST(Simulate, NoiseIsWhiteGaussianWithTheStatedSigma) {
  Demo demo = make_demo("compliance");
  demo.plan.poses = 4000;
  demo.plan.repeats = 1;
  demo.plan.noise_m = 17e-6;
  const auto simulation = simulate(demo.cell, demo.plan);
  const Rows3 z = (simulation.measured.p_M - simulation.true_p_M) / 17e-6;
  const double n = static_cast<double>(z.rows());
  std::cout << n << " poses, seed " << demo.plan.seed << "\n";
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(z.col(k).squaredNorm(), n, 4 * std::sqrt(2 * n)) << "chi^2 of axis " << k;
    EXPECT_NEAR(z.col(k).sum(), 0.0, 4 * std::sqrt(n));
    EXPECT_NEAR(z.col(k).dot(z.col((k + 1) % 3)), 0.0, 4 * std::sqrt(n));
    EXPECT_NEAR(z.col(k).head(z.rows() - 1).dot(z.col(k).tail(z.rows() - 1)), 0.0,
                4 * std::sqrt(n));
    EXPECT_NEAR((z.col(k).array().abs() > 1.96).cast<double>().mean(), 0.05, 0.014);
  }
}

TEST(Simulate, PosesFillTheJointLimitsUniformly) {
  Demo demo = make_demo("scara");
  demo.plan.poses = 5000;
  demo.plan.repeats = 1;
  const auto q = simulate(demo.cell, demo.plan).measured.q;
  for (int j = 0; j < demo.cell.joints(); ++j) {
    const auto& row = demo.cell.nominal.joints[j];
    const auto u = (q.col(j).array() - row.q_min) / (row.q_max - row.q_min);
    EXPECT_GE(u.minCoeff(), 0.0);
    EXPECT_LE(u.maxCoeff(), 1.0);
    std::array<int, 10> count{};
    for (const double x : u.eval()) ++count[static_cast<std::size_t>(10 * x)];
    double chi2 = 0.0;
    for (const int c : count) chi2 += (c - 500.0) * (c - 500.0) / 500.0;
    EXPECT_LT(chi2, 27.9) << "joint " << j;  // 0.1 % of chi^2 with 9 degrees of freedom
  }
}

TEST(Simulate, EveryTenthPoseIsRepeatedUnderItsName) {
  Demo demo = make_demo("clean");
  demo.plan.poses = 25;
  demo.plan.repeats = 4;
  const auto simulation = simulate(demo.cell, demo.plan);
  const auto& measured = simulation.measured;
  ASSERT_EQ(measured.size(), 25 + 3 * 3);
  for (int row = 0; row < measured.size(); ++row) {
    const int group = measured.replicate_group[row];
    const auto times = std::count(measured.pose.begin(), measured.pose.end(), measured.pose[row]);
    EXPECT_EQ(times, group % 10 == 0 ? 4 : 1);
  }
  EXPECT_EQ(measured.pose.front(), "P001");
  EXPECT_EQ(measured.pose.back(), "P025");
  EXPECT_EQ(simulation.true_p_M.row(0), simulation.true_p_M.row(3));
  EXPECT_NE(measured.p_M.row(0), measured.p_M.row(3));
}

TEST(Simulate, FrameAndTargetComeFromThePlanElseTheCellElseAtRandom) {
  Demo demo = make_demo("clean");
  const auto random = simulate(demo.cell, demo.plan);
  const double away = Eigen::Vector3d(random.X_MB.p.data()).norm();
  EXPECT_GE(away, 3.0);
  EXPECT_LE(away, 5.0);
  demo.cell.measurement.fit_frame = false;
  demo.cell.measurement.X_MB.p = {1, 2, 3};
  demo.cell.measurement.fit_target = false;
  demo.cell.measurement.target_T = {0.01, 0.02, 0.03};
  const auto given = simulate(demo.cell, demo.plan);
  EXPECT_EQ(given.X_MB, demo.cell.measurement.X_MB);
  EXPECT_EQ(given.X_TG.p, demo.cell.measurement.target_T);
  EXPECT_EQ(given.X_TG.q, (std::array<double, 4>{1, 0, 0, 0}));
  demo.plan.truth.X_MB = format::Pose{{4, 5, 6}, {0.6, 0.8, 0, 0}};
  demo.plan.truth.target_T = {0.1, 0, 0};
  const auto planned = simulate(demo.cell, demo.plan);
  EXPECT_EQ(planned.X_MB.p, (std::array<double, 3>{4, 5, 6}));
  EXPECT_EQ(planned.X_TG.p, (std::array<double, 3>{0.1, 0, 0}));
}

TEST(Simulate, GeometryErrorsHaveTheStatedSigmaAndHayatiReplacesD) {
  const Cell cell = make_demo("compliance").cell;
  SimulationPlan plan;
  plan.poses = 1;
  plan.truth.geometry_m = 2e-4;
  plan.truth.geometry_rad = 3e-4;
  double lengths = 0.0, angles = 0.0;
  int n_lengths = 0, n_angles = 0;
  for (plan.seed = 1; plan.seed <= 200; ++plan.seed) {
    const auto chain = simulate(cell, plan).true_chain;
    for (int i = 0; i < cell.joints(); ++i) {
      const auto &n = cell.nominal.joints[i], &t = chain.joints[i];
      EXPECT_EQ(t.d == n.d, i == 1);     // J2 is parallel to J3,
      EXPECT_EQ(t.beta != 0.0, i == 2);  // whose row holds the link between them
      for (const double x : {t.d - n.d, t.a - n.a}) lengths += x * x, n_lengths += x != 0.0;
      for (const double x : {t.theta - n.theta, t.alpha - n.alpha, t.beta}) {
        angles += x * x, n_angles += x != 0.0;
      }
    }
  }
  EXPECT_NEAR(lengths / n_lengths / 4e-8, 1.0, 4 * std::sqrt(2.0 / n_lengths));
  EXPECT_NEAR(angles / n_angles / 9e-8, 1.0, 4 * std::sqrt(2.0 / n_angles));
}

TEST(Simulate, OrientationIsMeasuredWhenAskedFor) {
  Demo demo = make_demo("clean");
  EXPECT_FALSE(simulate(demo.cell, demo.plan).measured.has_orientation());
  demo.plan.noise_rad = 20e-6;
  demo.plan.noise_m = 0.0;
  const auto noisy = simulate(demo.cell, demo.plan);
  demo.plan.noise_rad = 0.0;
  const auto exact = simulate(demo.cell, demo.plan);
  ASSERT_EQ(noisy.measured.quat_M.rows(), noisy.measured.size());
  double sum = 0.0;
  for (int row = 0; row < noisy.measured.size(); ++row) {
    EXPECT_NEAR(noisy.measured.quat_M.row(row).norm(), 1.0, 1e-12);
    const double cosine = noisy.measured.quat_M.row(row).dot(exact.measured.quat_M.row(row));
    const double sine2 =
        (noisy.measured.quat_M.row(row) - (cosine > 0 ? 1 : -1) * exact.measured.quat_M.row(row))
            .squaredNorm();
    sum += 4.0 * sine2;  // |angle|^2
  }
  const double n = 3.0 * noisy.measured.size();
  EXPECT_NEAR(sum / (20e-6 * 20e-6) / n, 1.0, 4 * std::sqrt(2 / n));
}

TEST(Simulate, RefusesAPlanThatMakesNoSense) {
  const Demo good = make_demo("clean");
  const auto refused = [&](auto change) {
    Demo demo = good;
    change(demo);
    try {
      simulate(demo.cell, demo.plan);
    } catch (const Failure& failure) {
      return failure.exit_code() == Exit::kUsage;
    }
    return false;
  };
  EXPECT_TRUE(refused([](Demo& d) { d.plan.poses = 0; }));
  EXPECT_TRUE(refused([](Demo& d) { d.plan.repeats = 0; }));
  EXPECT_TRUE(refused([](Demo& d) { d.plan.noise_m = -1e-6; }));
  EXPECT_TRUE(refused([](Demo& d) { d.plan.noise_rad = std::nan(""); }));
  EXPECT_TRUE(refused([](Demo& d) { d.plan.truth.geometry_m = -1.0; }));
  EXPECT_TRUE(refused([](Demo& d) { d.plan.q = RowsN::Zero(3, 5); }));
  EXPECT_TRUE(refused([](Demo& d) { d.cell.nominal.joints[2].q_max = -9.0; }));
}

TEST(Simulate, TruthFileHoldsTheNoiseFreePointOfEveryRow) {
  const Demo demo = make_demo("gear");
  const auto simulation = simulate(demo.cell, demo.plan);
  const auto truth = nlohmann::json::parse(simulation.truth_json);
  ASSERT_EQ(truth["poses"].size(), static_cast<std::size_t>(simulation.measured.size()));
  for (int row = 0; row < simulation.measured.size(); ++row) {
    EXPECT_EQ(truth["poses"][row]["pose"], simulation.measured.pose[row]);
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(double(truth["poses"][row]["p_mm"][k]), simulation.true_p_M(row, k) * 1e3);
    }
  }
  EXPECT_EQ(truth["effects"][0]["effect"], "gear_harmonics");
  EXPECT_EQ(truth["effects"][0]["joints"], (std::vector<std::string>{"J2", "J3"}));
  EXPECT_EQ(truth["noise_sigma_um"], 10.0);
}

TEST(SimulatedCsv, SaysNothingAboutWhatIsHidden) {
  const Demo demo = make_demo("gear");
  const auto text = simulated_csv(demo.cell, simulate(demo.cell, demo.plan));
  EXPECT_EQ(text.find("gear"), std::string::npos);
  EXPECT_EQ(text.find("seed"), std::string::npos);
}

TEST(SimulatedCsv, ReadsBackToTheSameMeasurements) {
  const Demo demo = make_demo("scara");
  SimulationPlan plan = demo.plan;
  plan.directions = Recorded::kAlways;
  plan.noise_rad = 1e-5;
  const auto simulation = simulate(demo.cell, plan);
  const auto file = std::filesystem::temp_directory_path() / "plumb_simulated_csv_test.csv";
  write_file_atomically(file, simulated_csv(demo.cell, simulation));
  const auto back = read_measurements({file}, {true, true, false, true}, Needs::kJointsAndPosition);
  std::filesystem::remove(file);
  ASSERT_EQ(back.size(), simulation.measured.size());
  EXPECT_EQ(back.pose, simulation.measured.pose);
  EXPECT_EQ(back.replicate_group, simulation.measured.replicate_group);
  EXPECT_LT((back.q - simulation.measured.q).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((back.p_M - simulation.measured.p_M).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((back.quat_M - simulation.measured.quat_M).cwiseAbs().maxCoeff(), 1e-12);
  for (const auto& column : simulation.context) {
    const Column* found = back.tables.at(0).find(column.name);
    ASSERT_NE(found, nullptr) << column.name;
    for (int row = 0; row < back.size(); ++row) {
      EXPECT_NEAR(found->values[row], column.values[row], 1e-9) << column.header;
    }
  }
}

}  // namespace
}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
// Two effects that random poses at one payload confound: the planned contrast is carried out on the
// simulator, whose laws are its own, and fitted.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <random>

#include "cell/measurement_reader.hpp"
#include "effects/registry.hpp"
#include "fit/calibrate.hpp"
#include "plan/planning.hpp"
#include "simulate/simulate.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::offline {
namespace {

constexpr double kNoise_m = 20e-6;

EffectEntry effect(const std::string& name, int joint) { return {name, {joint}, {}, {}}; }

PlanRequest asked(int n, int pool, const EffectEntry& a, const EffectEntry& b) {
  PlanRequest out;
  out.n = n;
  out.rules.pool = pool;
  out.separate = {a, b};
  return out;
}

Cell heavy_cell() {
  Cell cell = make_demo("compliance").cell;
  cell.measurement.sigma_m = kNoise_m;
  cell.effects = {
      {"geometry", {}, {}, {}}, effect("joint_compliance", 1), effect("gear_harmonics", 1)};
  return cell;
}

RowsN joints_of(const PosePlan& plan, int payload) {
  std::vector<Eigen::VectorXd> q;
  for (const auto& pose : plan.poses)
    if (pose.how.payload == payload) q.push_back(pose.q);
  RowsN out(static_cast<Eigen::Index>(q.size()), q.front().size());
  for (std::size_t i = 0; i < q.size(); ++i)
    out.row(static_cast<Eigen::Index>(i)) = q[i].transpose();
  return out;
}

double load(const PosePlan& plan, int payload) {
  return plan.circumstances.payloads[static_cast<std::size_t>(payload)].mass_kg;
}

/// One arm measured at poses q with a payload; the file that would be written.
std::string measured_at(const Cell& cell, const RowsN& q, double payload_kg, std::uint64_t seed,
                        std::uint64_t noise) {
  SimulationPlan plan;
  plan.q = q;
  plan.poses = static_cast<int>(q.rows());
  plan.noise_m = kNoise_m;
  plan.seed = seed * 1000 + noise;
  plan.truth.seed = seed;
  plan.truth.geometry_m = 0.2e-3;
  plan.truth.geometry_rad = 0.2e-3;
  plan.payloads = {{payload_kg, cell.payload.com_m}};
  return simulated_csv(cell, simulate(cell, plan));
}

Measurements read_back(const Cell& cell, const std::vector<std::string>& files) {
  const auto folder = std::filesystem::temp_directory_path() /
                      ("plumb-separation-" + std::to_string(std::random_device{}()));
  std::filesystem::create_directories(folder);
  std::vector<std::filesystem::path> paths;
  for (const auto& text : files) {
    paths.push_back(folder / (std::to_string(paths.size()) + ".csv"));
    std::ofstream(paths.back()) << text;
  }
  const Measurements out =
      read_measurements(paths, std::vector<bool>(static_cast<std::size_t>(cell.joints()), true),
                        Needs::kJointsAndPosition);
  std::filesystem::remove_all(folder);
  return out;
}

/// The fitted compliance and its own 1 sigma.
Estimate compliance(const Cell& cell, const Measurements& measured) {
  std::vector<int> rows(static_cast<std::size_t>(measured.size()));
  std::iota(rows.begin(), rows.end(), 0);
  for (const auto& e : calibrate(cell, measured, rows).estimates)
    if (e.name.starts_with("joint_compliance")) return e;
  return {};
}

TEST(Separation, ThePlanDeliversTheStandardDeviationItPromises) {
  const int count = static_cast<int>(tests::scaled(16));
  std::printf("[ seeds    ] 1 .. %d\n", count);
  const Cell cell = heavy_cell();
  const PlanRequest request =
      asked(60, 400, effect("joint_compliance", 1), effect("gear_harmonics", 1));
  const PosePlan plan = plan_poses(cell, nothing_measured(cell), request);
  ASSERT_EQ(plan.circumstances.contrasts(), std::vector<Contrast>{Contrast::kTwoPayloads});
  ASSERT_EQ(plan.numbers.front().name.substr(0, 16), "joint_compliance");
  const double promised = plan.numbers.front().after;
  double planned = 0.0, at_random = 0.0, told = 0.0;
  for (int seed = 1; seed <= count; ++seed) {
    const auto s = static_cast<std::uint64_t>(seed);
    const Estimate found = compliance(
        cell, read_back(cell, {measured_at(cell, joints_of(plan, 0), load(plan, 0), s, 1),
                               measured_at(cell, joints_of(plan, 1), load(plan, 1), s, 2)}));
    RowsN q(60, cell.joints());
    tests::Random random(s);
    for (Eigen::Index i = 0; i < q.rows(); ++i)
      for (int j = 0; j < cell.joints(); ++j) {
        const auto& row = cell.nominal.joints[static_cast<std::size_t>(j)];
        q(i, j) = random.uniform(row.q_min, row.q_max);
      }
    const Estimate random_poses =
        compliance(cell, read_back(cell, {measured_at(cell, q, load(plan, 1), s, 3)}));
    planned += found.value * found.value / count;  // nothing is hidden: the truth is 0
    at_random += random_poses.value * random_poses.value / count;
    told += found.std / count;
  }
  std::printf("[ 1 sigma  ] promised %.3g, fit says %.3g, scatter %.3g, at random poses %.3g\n",
              promised, told, std::sqrt(planned), std::sqrt(at_random));
  EXPECT_NEAR(told / promised, 1.0, 0.1);
  EXPECT_GT(std::sqrt(planned) / promised, 1.0 - 2.5 / std::sqrt(2.0 * count));
  EXPECT_LT(std::sqrt(planned) / promised, 1.0 + 2.5 / std::sqrt(2.0 * count));
  EXPECT_LT(std::sqrt(planned), 0.6 * std::sqrt(at_random));
}

TEST(Separation, LowersTheMutualReproductionOfConfoundedEffects) {
  const Cell cell = heavy_cell();
  SimulationPlan recipe;
  recipe.poses = 60;
  recipe.noise_m = kNoise_m;
  const Measurements measured = simulate(cell, recipe).measured;
  const PosePlan plan = plan_poses(
      cell, measured, asked(60, 400, effect("joint_compliance", 1), effect("gear_harmonics", 1)));
  ASSERT_TRUE(plan.apart_before.a_by_b && plan.apart_after.a_by_b);
  EXPECT_LT(*plan.apart_after.a_by_b, 0.8 * *plan.apart_before.a_by_b);
  EXPECT_LT(plan.numbers.front().after, 0.5 * *plan.numbers.front().before);
}

TEST(Separation, RefusesEffectsThatAreOneAndTheSame) {
  Cell cell = heavy_cell();
  cell.effects.resize(1);  // else its own harmonics stand for both
  EffectEntry first = effect("gear_ripple", 1);
  first.options["cycles_per_turn"] = 1.0;
  try {
    plan_poses(cell, nothing_measured(cell),
               asked(40, 200, effect("encoder_eccentricity", 1), first));
    FAIL() << "planned what cannot be told apart";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.problems().front().code, "E-PLAN-SAME");
    EXPECT_EQ(failure.exit_code(), Exit::kNumbersSayNo);
  }
}

TEST(Separation, ExpectsLittleFromFewReadingsAndMoreFromMore) {
  const Cell cell = heavy_cell();
  SimulationPlan recipe;
  recipe.poses = 60;
  recipe.noise_m = kNoise_m;
  recipe.truth.effects = {"joint_compliance:J2:2"};
  const Measurements measured = simulate(cell, recipe).measured;
  const auto least = [&](int n) {
    const PosePlan plan = plan_poses(
        cell, measured, asked(n, 300, effect("joint_compliance", 1), effect("gear_harmonics", 1)));
    EXPECT_TRUE(plan.expected.today);
    return plan.expected.least();
  };
  const double two = least(2), ten = least(10), thirty = least(30);
  std::printf("[ expected ] %.1f nats from 2 readings, %.1f from 10, %.1f from 30\n", two, ten,
              thirty);
  EXPECT_LT(two, ten);
  EXPECT_LT(ten, thirty);
}

TEST(Separation, WithoutAKnownLoadItPlansPosesAloneAndSaysWhatIsNeeded) {
  Cell cell = heavy_cell();
  cell.payload.mass_kg = 0.0;
  PlanRequest request = asked(6, 60, effect("joint_compliance", 1), effect("gear_harmonics", 1));
  const PosePlan alone = plan_poses(cell, nothing_measured(cell), request);
  EXPECT_TRUE(alone.circumstances.contrasts().empty());
  EXPECT_EQ(alone.remarks.back().code, "N-PLAN-PAYLOAD");
  request.payloads_kg = {0.0, 25.0};
  const PosePlan loaded = plan_poses(cell, nothing_measured(cell), request);
  EXPECT_EQ(load(loaded, 1), 25.0);
  EXPECT_GT(loaded.expected.least(), alone.expected.least());
  EXPECT_GT(joints_of(loaded, 0).rows(), 0);
  EXPECT_GT(joints_of(loaded, 1).rows(), 0);
}

std::vector<Contrast> varied(const Cell& cell, const char* a, const char* b) {
  return circumstances_of(cell, nothing_measured(cell), effect(a, 1), effect(b, 1), {}).contrasts();
}

TEST(Circumstances, AreThoseThatOneEffectDependsOnAndNotTheOther) {
  using List = std::vector<Contrast>;
  const Cell cell = heavy_cell();
  EXPECT_EQ(varied(cell, "reversal", "settling_lag"), List{Contrast::kShortAndLong});
  EXPECT_EQ(varied(cell, "reversal", "gear_harmonics"), List{Contrast::kBothSides});
  EXPECT_EQ(varied(cell, "joint_compliance", "gear_harmonics"), List{Contrast::kTwoPayloads});
  EXPECT_EQ(varied(cell, "thermal_growth", "encoder_scale"), List{Contrast::kColdAndWarm});
  EXPECT_EQ(varied(cell, "gear_harmonics", "gear_ripple"), List{});
  EXPECT_EQ(varied(cell, "drift", "gear_harmonics"), List{Contrast::kEndAgain});
}

TEST(Separation, EveryReadingHasANameOfItsOwnAndSaysWhatToDo) {
  const Cell cell = heavy_cell();
  const std::pair<const char*, const char*> pairs[] = {{"reversal", "settling_lag"},
                                                       {"reversal", "gear_harmonics"},
                                                       {"drift", "gear_harmonics"},
                                                       {"thermal_growth", "gear_harmonics"},
                                                       {"joint_compliance", "reversal"}};
  for (const auto& [a, b] : pairs) {
    const PosePlan plan =
        plan_poses(cell, nothing_measured(cell), asked(12, 60, effect(a, 1), effect(b, 1)));
    ASSERT_EQ(plan.poses.size(), 12U) << a;
    for (std::size_t i = 0; i < plan.poses.size(); ++i) {
      const auto& pose = plan.poses[i];
      EXPECT_EQ(pose.note, instruction(plan.circumstances, pose.how));
      EXPECT_FALSE(pose.note.empty()) << a << b;
      if (pose.how.approach.size() == 0) continue;
      for (int j = 0; j < cell.joints(); ++j) {  // where it comes from can be reached
        const auto& row = cell.nominal.joints[static_cast<std::size_t>(j)];
        const double from = pose.q(j) - pose.how.approach(j);
        EXPECT_GE(from, row.q_min);
        EXPECT_LE(from, row.q_max);
      }
    }
    for (std::size_t i = 1; i < plan.poses.size(); ++i) {
      EXPECT_NE(plan.poses[i].name, plan.poses[i - 1].name);
      EXPECT_LE(plan.poses[i - 1].how.second_block, plan.poses[i].how.second_block);
    }
  }
}

}  // namespace
}  // namespace plumb::offline

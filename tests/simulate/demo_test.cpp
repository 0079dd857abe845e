// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <iostream>

#include "simulate/simulate.hpp"
#include "tests/cases/random_cell.hpp"

namespace plumb::offline {
namespace {

// Mean and largest shift of the measured point by the hidden effects alone [mm].
std::pair<double, double> effect_mm(const Cell& cell, SimulationPlan plan) {
  plan.truth.sized = simulate(cell, plan).effects;
  plan.noise_m = 0.0;
  const auto with = simulate(cell, plan);
  plan.truth.effects.clear();
  plan.truth.sized.clear();
  const auto without = simulate(cell, plan);
  const auto shift = (1e3 * (with.true_p_M - without.true_p_M)).rowwise().norm().eval();
  return {shift.mean(), shift.maxCoeff()};
}

TEST(Demo, TheFirstOneIsTheDefault) {
  EXPECT_EQ(demo_cells().front().first, "compliance");
  EXPECT_EQ(make_demo("").cell.serial, make_demo("compliance").cell.serial);
}

TEST(Demo, EveryOneCanBeMeasured) {
  for (const auto& [name, line] : demo_cells()) {
    EXPECT_FALSE(line.empty());
    const Demo demo = make_demo(name);
    const auto simulation = simulate(demo.cell, demo.plan);
    EXPECT_GE(simulation.measured.size(), 200) << name;
    EXPECT_EQ(demo.plan.noise_m, demo.cell.measurement.sigma_m) << name;
    EXPECT_EQ(demo.cell.mechanics.size(), demo.cell.nominal.joints.size()) << name;
    ASSERT_EQ(demo.cell.effects.size(), 1U) << name;
    EXPECT_EQ(demo.cell.effects[0].name, "geometry") << name;
    const auto [mean, max] = effect_mm(demo.cell, demo.plan);
    std::cout << name << ": hidden effect mean " << mean << " mm, max " << max << " mm\n";
    EXPECT_EQ(max == 0.0, name == "clean");
  }
}

TEST(Demo, AnUnknownNameIsAnsweredWithANearOne) {
  try {
    make_demo("complience");
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit_code(), Exit::kUsage);
    EXPECT_EQ(failure.problems().at(0).help, "did you mean 'compliance'?");
  }
}

TEST(HiddenEffects, HaveDefaultSizesThatMatterOnIndustrialArms) {
  for (const char* arm : {"compliance", "gear", "clean"}) {
    for (const char* effect :
         {"joint_compliance", "gear_harmonics", "link_flexure", "drift", "reversal"}) {
      Demo demo = make_demo(arm);
      demo.plan.truth.effects = {effect};
      const auto [mean, max] = effect_mm(demo.cell, demo.plan);
      std::cout << arm << " " << effect << ": mean " << mean << " mm, max " << max << " mm\n";
      EXPECT_GT(mean, 0.02) << arm << " " << effect;
      EXPECT_LT(mean, 0.6) << arm << " " << effect;
    }
  }
}

TEST(RandomCell, MakesSensibleArmsOfEveryKind) {
  using format::Convention;
  const std::uint64_t seed = 1;
  std::cout << "50 arms a kind, seed " << seed << "\n";
  for (const auto convention : {Convention::kStandard, Convention::kModified}) {
    for (int k = 0; k < 50; ++k) {
      const bool scara = k % 5 == 4;
      const int joints = scara ? 4 : 4 + k % 5;
      const Cell cell =
          random_cell(seed + k, joints, convention, scara ? ArmKind::kScara : ArmKind::kRevolute);
      EXPECT_EQ(cell.joints(), joints);
      for (const auto& row : cell.nominal.joints) EXPECT_LT(row.q_min + 0.1, row.q_max);
      SimulationPlan plan;
      plan.noise_m = 0.0;
      const auto p = simulate(cell, plan).measured.p_M;
      const double spread = (p.rowwise() - p.colwise().mean()).rowwise().norm().mean();
      EXPECT_GT(spread, 0.15) << "seed " << seed + k;
      EXPECT_LT(spread, 3.0) << "seed " << seed + k;
    }
  }
  EXPECT_THROW(random_cell(1, 8, Convention::kStandard, ArmKind::kRevolute), std::invalid_argument);
  EXPECT_THROW(random_cell(1, 5, Convention::kStandard, ArmKind::kScara), std::invalid_argument);
}

TEST(RandomCell, IsTheSameArmInBothConventions) {
  using format::Convention;
  for (const auto kind : {ArmKind::kRevolute, ArmKind::kScara}) {
    SimulationPlan plan;
    plan.noise_m = 0.0;
    const auto standard = simulate(random_cell(7, 4, Convention::kStandard, kind), plan);
    const auto modified = simulate(random_cell(7, 4, Convention::kModified, kind), plan);
    EXPECT_LT((standard.true_p_M - modified.true_p_M).cwiseAbs().maxCoeff(), 1e-12);
  }
}

}  // namespace
}  // namespace plumb::offline

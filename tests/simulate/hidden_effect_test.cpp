// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "simulate/hidden_effect_reader.hpp"
#include "simulate/simulate.hpp"

namespace plumb::offline {
namespace {

Problem problem_of(const std::string& spec) {
  try {
    parse_hidden_effect(spec, make_demo("scara").cell);
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit_code(), Exit::kUsage);
    return failure.problems().at(0);
  }
  ADD_FAILURE() << "accepted: " << spec;
  return {};
}

TEST(HiddenEffect, IsANameWithOptionalSizesAndJoints) {
  const Cell cell = make_demo("gear").cell;
  const auto plain = parse_hidden_effect("drift", cell);
  EXPECT_EQ(plain.name, "drift");
  EXPECT_FALSE(plain.size);
  EXPECT_TRUE(plain.joints.empty());
  const auto full = parse_hidden_effect("gear_harmonics=0.1mrad:J2,J3=150urad", cell);
  EXPECT_DOUBLE_EQ(full.size.value(), 1e-4);
  ASSERT_EQ(full.joints.size(), 2U);
  EXPECT_EQ(full.joints[0].joint, 1);
  EXPECT_FALSE(full.joints[0].size);
  EXPECT_EQ(full.joints[1].joint, 2);
  EXPECT_DOUBLE_EQ(full.joints[1].size.value(), 150e-6);
  EXPECT_DOUBLE_EQ(parse_hidden_effect("drift=1.5e-1mm", cell).size.value(), 1.5e-4);
}

TEST(HiddenEffect, MistakesAreShownWhereTheyStandWithSomethingToDo) {
  const struct {
    std::string spec;
    int column, length;
    std::string help;
  } mistakes[] = {
      {"gear_harmonic:J1", 1, 13, "did you mean 'gear_harmonics'?"},
      {"gear_harmonics:J11", 16, 3, "did you mean 'J1'?"},
      {"gear_harmonics:J1,J1", 19, 2, "remove it"},
      {"gear_harmonics:J1,", 19, 1, ""},
      {"gear_harmonics:", 16, 1, ""},
      {"gear_harmonics:J1=", 18, 1, "such as 150urad"},
      {"gear_harmonics:J1=fast", 19, 4, "such as 150urad"},
      {"gear_harmonics:J1=-3urad", 19, 6, "such as 150urad"},
      {"gear_harmonics:J1=3um", 19, 3, "use urad, mrad, rad or deg"},
      {"drift=3", 7, 1, "use um, mm or m"},
      {"drift:J1", 6, 1, "no joints here"},
      {"planar_printed=3um", 16, 3, "remove it"},
      {"", 1, 1, ""},
  };
  for (const auto& mistake : mistakes) {
    const auto problem = problem_of(mistake.spec);
    EXPECT_EQ(problem.code, "E-SIM-EFFECT");
    ASSERT_TRUE(problem.place) << mistake.spec;
    EXPECT_EQ(problem.place->column, mistake.column) << mistake.spec;
    EXPECT_EQ(problem.place->length, mistake.length) << mistake.spec;
    if (!mistake.help.empty()) {
      EXPECT_EQ(problem.help, mistake.help) << mistake.spec;
    }
    EXPECT_FALSE(problem.help.empty()) << mistake.spec;
  }
}

TEST(HiddenEffect, IsRefusedOnAJointWhereItCannotBe) {
  const Demo demo = make_demo("scara");
  for (const char* spec :
       {"gear_harmonics:J3", "reversal:J3", "joint_compliance:J1", "joint_compliance"}) {
    SimulationPlan plan = demo.plan;
    plan.truth.effects = {spec};
    EXPECT_THROW(simulate(demo.cell, plan), Failure) << spec;
  }
}

}  // namespace
}  // namespace plumb::offline

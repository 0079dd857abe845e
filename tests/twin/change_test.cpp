// SPDX-License-Identifier: Apache-2.0
#include "twin/change.hpp"

#include <gtest/gtest.h>

#include "twin/sister.hpp"
#include "twin/twin_file.hpp"

namespace plumb::offline::twin {
namespace {

using Of = Change::Of;

Cell heavy() { return make_demo("compliance").cell; }

Hidden hidden_of_demo(const Demo& demo) {
  return hidden_of_truth(simulate(demo.cell, demo.plan).truth_json, "truth.json");
}

/// Points of the true arm at twelve poses without noise.
Rows3 points_of(const Cell& cell, const HiddenTruth& truth) {
  SimulationPlan plan;
  plan.poses = 12;
  plan.truth = truth;
  return simulate(cell, plan).true_p_M;
}

double moved_m(const Rows3& a, const Rows3& b) { return (a - b).rowwise().norm().mean(); }

TEST(ArmChange, IsReadWithItsUnit) {
  const Cell cell = heavy();
  const Change encoder = parse_change("encoder:J2=-120urad", cell, 1);
  EXPECT_EQ(encoder.of, Of::kEncoder);
  EXPECT_EQ(encoder.joint, 1);
  EXPECT_DOUBLE_EQ(encoder.size, -120e-6);
  const Change spring = parse_change("stiffness:J3=+25%", cell, 1);
  EXPECT_EQ(spring.joint, 2);
  EXPECT_DOUBLE_EQ(spring.size, 0.25);
  const Change base = parse_change("base=0.3,0,-1e-1mm", cell, 1);
  EXPECT_DOUBLE_EQ(base.shift_m[0], 0.3e-3);
  EXPECT_DOUBLE_EQ(base.shift_m[1], 0.0);
  EXPECT_DOUBLE_EQ(base.shift_m[2], -0.1e-3);
  const auto shift = parse_change("tool=200um", cell, 1).shift_m;
  EXPECT_NEAR(Eigen::Vector3d(shift.data()).norm(), 0.2e-3, 1e-12);
}

TEST(ArmChange, MistakesAreShownWhereTheyStand) {
  const Cell cell = make_demo("scara").cell;
  const struct {
    const char* text;
    int column;
  } cases[] = {{"", 1},
               {"encodr:J2=1urad", 1},
               {"encoder=1urad", 1},
               {"tool:J2=1mm", 1},
               {"encoder:J2", 1},
               {"encoder:J9=1urad", 9},
               {"encoder:J3=1urad", 9},  // it slides
               {"encoder:J2=1mm", 12},
               {"encoder:J2=much", 12},
               {"stiffness:J2=-100%", 14},
               {"stiffness:J2=-15", 14},
               {"tool=1", 6},
               {"tool=nanmm", 6},
               {"tool=1,2mm", 6},
               {"tool=1,2,3,4mm", 6},
               {"tool=1urad", 6}};
  for (const auto& [text, column] : cases) {
    SCOPED_TRACE(text);
    try {
      parse_change(text, cell, 1);
      ADD_FAILURE() << "accepted";
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.exit_code(), Exit::kUsage);
      const Problem& problem = failure.problems().front();
      EXPECT_EQ(problem.code, "E-TWIN-CHANGE");
      EXPECT_EQ(problem.place.value().column, column);
      EXPECT_FALSE(problem.help.empty());
    }
  }
}

TEST(ArmChange, MovesThePointsByWhatItSays) {
  const Demo demo = make_demo("compliance");
  const HiddenTruth before = truth_of(demo.cell, hidden_of_demo(demo));
  const Rows3 was = points_of(demo.cell, before);
  const auto moved = [&](const char* text) {
    HiddenTruth now = before;
    apply(parse_change(text, demo.cell, 1), demo.cell, now);
    return moved_m(points_of(demo.cell, now), was);
  };
  EXPECT_NEAR(moved("base=0.3,0,0mm"), 0.3e-3, 1e-9);
  EXPECT_NEAR(moved("tool=0,-0.2,0mm"), 0.2e-3, 1e-6);
  const double encoder = moved("encoder:J2=120urad");
  EXPECT_GT(encoder, 50e-6);
  EXPECT_NEAR(moved("encoder:J2=-120urad"), encoder, 1e-7);
  const double soft = moved("stiffness:J3=-50%"), softer = moved("stiffness:J3=-75%");
  EXPECT_GT(soft, 5e-6);
  EXPECT_NEAR(softer / soft, 3.0, 0.01) << "an angle under load is inverse to the stiffness";
}

TEST(ArmChange, AStiffJointHasNoStiffnessThatChanges) {
  const Demo demo = make_demo("compliance");
  HiddenTruth truth = truth_of(demo.cell, hidden_of_demo(demo));
  try {
    apply(parse_change("stiffness:J5=-15%", demo.cell, 1), demo.cell, truth);
    ADD_FAILURE() << "accepted";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit_code(), Exit::kUsage);
    EXPECT_NE(failure.problems().front().help.find("J2, J3"), std::string::npos);
  }
}

/// Sizes in sigma, joints that nobody named, steps with a time: whatever a demo hides.
TEST(TruthOfASample, IsTheArmThatWasMeasured) {
  for (const char* name : {"compliance", "gear", "ripple", "bumped", "mixed", "scara", "clean"}) {
    SCOPED_TRACE(name);
    const Demo demo = make_demo(name);
    const Simulation made = simulate(demo.cell, demo.plan);
    const Hidden hidden = hidden_of_truth(made.truth_json, "truth.json");
    SimulationPlan again = demo.plan;
    again.truth = truth_of(demo.cell, hidden);
    EXPECT_LT(moved_m(simulate(demo.cell, again).true_p_M, made.true_p_M), 1e-9);
    EXPECT_DOUBLE_EQ(hidden.noise_m, demo.plan.noise_m);
  }
}

TEST(TruthOfASample, IsRefusedWhereItDoesNotSayEnough) {
  Demo demo = make_demo("clean");
  demo.plan.imperfections.encoder_step = 1e-6;
  const std::string more = simulate(demo.cell, demo.plan).truth_json;
  for (const std::string& text : {more, std::string("{}"), std::string("no JSON"),
                                  std::string(R"({"arm": {"effects": [3]}})")}) {
    EXPECT_THROW(hidden_of_truth(text, "truth.json"), Failure);
  }
}

TEST(Sister, IsAnotherArmOfTheSameType) {
  const Cell cell = heavy();
  const Hidden hidden = hidden_of_demo(make_demo("compliance"));
  const auto chain = [&](const HiddenTruth& truth) {
    SimulationPlan plan;
    plan.truth = truth;
    return simulate(cell, plan).true_chain;
  };
  const HiddenTruth one = sister_of(cell, hidden, 1), two = sister_of(cell, hidden, 2);
  EXPECT_EQ(chain(one), chain(sister_of(cell, hidden, 1)));
  EXPECT_NE(chain(one), chain(two));
  EXPECT_NE(chain(one), chain(truth_of(cell, hidden)));
  EXPECT_NE(one.X_MB, two.X_MB) << "each has its own tracker";
  ASSERT_EQ(one.sized.size(), 1U);
  EXPECT_NE(one.sized[0].joints[0].size, two.sized[0].joints[0].size);
  const Cell named = cell_of_sister(cell, 2, "arm2/measurements.csv");
  EXPECT_NE(named.serial, cell.serial);
  EXPECT_EQ(named.nominal, cell.nominal);
}

}  // namespace
}  // namespace plumb::offline::twin

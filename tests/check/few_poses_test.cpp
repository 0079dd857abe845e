// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "check/check.hpp"
#include "fit/few_poses.hpp"
#include "fit/fit_cell.hpp"
#include "fit/held_out_excess.hpp"
#include "fit/verdict.hpp"
#include "simulate/simulate.hpp"
#include "tests/cases/random_cell.hpp"

/// Where poses are few, check and fit must say the same, and few poses are no missing physics.
namespace plumb::offline {
namespace {

constexpr double kTolerance_m = 100e-6;

struct Few {
  Cell cell;
  MeasurementFiles measured;
  std::string name;
};

Few few(int poses, int repeats, std::uint64_t seed) {
  Cell cell = random_cell(5, 6, format::Convention::kStandard, ArmKind::kRevolute);
  SimulationPlan plan;
  plan.poses = poses;
  plan.repeats = repeats;
  plan.noise_m = 10e-6;
  plan.seed = seed;
  plan.truth.seed = seed;
  plan.truth.geometry_m = plan.truth.geometry_rad = 0.5e-3;
  MeasurementFiles measured = simulate(cell, plan).measured;
  cell.measurement.sigma_m = 10e-6;
  return {std::move(cell), std::move(measured),
          fmt::format("{} poses, repeats {}, seed {}", poses, repeats, seed)};
}

/// The code of the refusal; empty if the cell could be fitted.
std::string refusal_of_fit(const Few& at) {
  try {
    fit_cell(at.cell, at.measured);
    return "";
  } catch (const Failure& failure) {
    return failure.problems().front().code;
  }
}

TEST(FewPoses, CheckCallsUsableWhatFitAccepts) {
  int refused = 0, accepted = 0;
  for (const int repeats : {1, 4})
    for (int poses = 4; poses <= 18; ++poses) {
      const Few at = few(poses, repeats, 3);
      const bool usable = check_cell(at.cell, at.measured).exit == Exit::kDone;
      const std::string refusal = refusal_of_fit(at);
      // Fewer distinct poses than numbers to find: fit holds the rest near nominal, check says
      // more.
      if (usable) {
        EXPECT_EQ(refusal, "") << at.name;
      }
      refused += usable ? 0 : 1;
      accepted += usable ? 1 : 0;
    }
  EXPECT_GT(refused, 5);
  EXPECT_GT(accepted, 5);
}

TEST(FewPoses, CheckEndsAsFitDoesWhereTheHeldOutRuleCannotBeMet) {
  Few at = few(30, 1, 1);
  at.cell.measurement.held_out = {.kind = HeldOutRule::Kind::kFolds, .folds = 40};
  try {
    fit_cell(at.cell, at.measured);
    FAIL() << "30 poses in 40 folds";
  } catch (const Failure& failure) {
    ASSERT_EQ(failure.problems().front().code, "E-SPLIT");
    const Check check = check_cell(at.cell, at.measured);
    EXPECT_EQ(check.exit, failure.exit_code());
    EXPECT_TRUE(std::any_of(check.findings.begin(), check.findings.end(),
                            [](const Problem& p) { return p.code == "E-SPLIT"; }));
  }
}

TEST(FewPoses, AnArmThatIsRightLacksNoPhysicsHoweverManyRepeatsItsFewPosesHave) {
  for (const int repeats : {1, 4})
    for (const int poses : {14, 16, 18, 20, 25})
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const Few at = few(poses, repeats, seed);
        if (!refusal_of_fit(at).empty()) continue;
        const Fit fit = fit_cell(at.cell, at.measured);
        EXPECT_EQ(verdict(fit, kTolerance_m).find("physical"), std::string::npos)
            << at.name << ": " << verdict(fit, kTolerance_m);
      }
}

TEST(FewPoses, RepeatsAddNoCoordinates) {
  const Few at = few(20, 4, 1);
  ASSERT_GT(at.measured.size(), 20);
  Split split;
  const auto rows = static_cast<std::size_t>(at.measured.size());
  split.fold.assign(rows, -1);
  split.held.assign(rows, false);
  split.used.assign(rows, true);
  EXPECT_EQ(fitted_coordinates(at.measured, split), 60.0);
  EXPECT_EQ(fewest_fitted(split), rows);
}

TEST(FewPoses, TheMoreThePosesTheLessIsUnavoidable) {
  double before = 1e9;
  for (const double coordinates : {30.0, 60.0, 120.0, 600.0, 6000.0}) {
    const double now = unavoidable_ratio(coordinates, 27.0);
    EXPECT_LT(now, before);
    EXPECT_GE(now, 1.0);
    before = now;
  }
  EXPECT_FALSE((HeldOutExcess{1.0, before}.few_poses()));
}

}  // namespace
}  // namespace plumb::offline

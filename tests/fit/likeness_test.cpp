// SPDX-License-Identifier: Apache-2.0
#include "fit/likeness.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "arm/arm_change.hpp"
#include "arm/predicted_points.hpp"
#include "cell/earlier_arm.hpp"
#include "fit/calibrate.hpp"
#include "simulate/simulate.hpp"
#include "tests/cases/random_cell.hpp"

namespace plumb::offline {
namespace {

constexpr double kNoise_m = 20e-6;
constexpr int kJudged = 200;

Cell some_cell(std::uint64_t seed) {
  Cell cell = random_cell(seed, 6, format::Convention::kStandard, ArmKind::kRevolute);
  cell.measurement.sigma_m = kNoise_m;
  return cell;
}

/// `poses` readings, the first ones, and as many others as judge.
Simulation measured(const Cell& cell, int poses, std::uint64_t arm, std::uint64_t session,
                    double geometry) {
  SimulationPlan plan;
  plan.poses = poses + kJudged;
  plan.noise_m = kNoise_m;
  plan.seed = session;
  plan.truth.seed = arm;
  plan.truth.geometry_m = plan.truth.geometry_rad = geometry;
  return simulate(cell, plan);
}

std::vector<int> first(int n) {
  std::vector<int> out(static_cast<std::size_t>(n));
  std::iota(out.begin(), out.end(), 0);
  return out;
}

/// Mean distance from the truth at the readings that judge.
double error_of(const Calibration& c, const Simulation& s, int poses) {
  const Rows3 off = predict_points(c.state, s.measured) - s.true_p_M;
  return off.bottomRows(s.measured.size() - poses).rowwise().norm().mean();
}

std::shared_ptr<const EarlierArm> earlier(const Calibration& c) {
  auto out = std::make_shared<EarlierArm>();
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < c.estimates.size(); ++i) {
    const Estimate& e = c.estimates[i];
    if (!e.of_robot) continue;
    out->numbers.push_back({e.name, e.value, e.nominal, !e.unit.empty()});
    rows.push_back(static_cast<Eigen::Index>(i));
  }
  out->covariance = c.covariance(rows, rows);
  for (const auto& row : c.state.arm.calibrated.joints)
    out->rows.push_back(
        {row.name, row.type == format::JointType::kPrismatic, row.theta, row.d, row.a, row.alpha});
  out->left_m = kNoise_m;
  out->modified = c.state.arm.calibrated.convention == format::Convention::kModified;
  for (std::size_t k = 0; k < 3; ++k) out->target_T[k] = c.state.X_TG.p[k];
  return out;
}

/// An arm of the cell, calibrated with many poses.
Calibration reference_of(const Cell& cell, std::uint64_t seed) {
  return calibrate(cell, measured(cell, 150, seed, 1, 0.3e-3).measured, first(150));
}

struct Outcome {
  double alone = 0.0, with = 0.0;
  Calibration found;
};

/// An arm of `cell`, measured at so many poses, alone and with what the reference knows.
Outcome outcome_of(const Cell& cell, const Simulation& s, int poses, const Calibration& reference) {
  Cell with = cell;
  with.fit.earlier = earlier(reference);
  Outcome out;
  out.alone = error_of(calibrate(cell, s.measured, first(poses)), s, poses);
  out.found = calibrate(with, s.measured, first(poses));
  out.with = error_of(out.found, s, poses);
  return out;
}

double median_of(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
  return v[v.size() / 2];
}

constexpr std::uint64_t kSeeds[] = {11, 12, 13, 14, 15, 16, 17};

TEST(Likeness, TheSameArmNeedsFewPosesOnly) {
  std::vector<double> times;
  int same = 0;
  for (const auto seed : kSeeds) {
    const Cell cell = some_cell(seed);
    const auto reference = reference_of(cell, seed);
    const auto later = measured(cell, 150, seed, 2, 0.3e-3);
    // Nobody can do better than with the true arm, tracker and reflector from the same poses.
    Cell known = cell;
    known.nominal = later.true_chain;
    const Rows3 off =
        predict_points(place_nominal(known, later.measured, first(12)), later.measured) -
        later.true_p_M;
    const double best = off.bottomRows(kJudged).rowwise().norm().mean();
    Cell with = cell;
    with.fit.earlier = earlier(reference);
    const auto found = calibrate(with, later.measured, first(12));
    same += found.likeness->kind == Likeness::Kind::kSame ? 1 : 0;
    times.push_back(error_of(found, later, 150) / best);
  }
  EXPECT_LT(median_of(times), 1.3);
  EXPECT_GE(same, 6);
}

TEST(Likeness, ASisterHelpsAsMuchAsIfHerLikenessWereKnown) {
  std::vector<double> times;
  for (const auto seed : kSeeds) {
    const Cell cell = some_cell(seed);
    const auto before = measured(cell, 150, seed, 1, 0.3e-3);
    const auto reference = reference_of(cell, seed);
    Cell around = cell;  // arms that differ by 0.03 mm and mrad from the reference
    around.nominal = before.true_chain;
    const auto sister = measured(around, 14, seed + 100, 2, 0.03e-3);
    const auto outcome = outcome_of(cell, sister, 14, reference);
    EXPECT_LT(outcome.with, outcome.alone) << seed;
    Cell told = cell;  // by somebody who knows how much the arms differ
    for (const auto& e : reference.estimates)
      if (e.of_robot)
        told.fit.priors.push_back({.name = e.name, .sigma = 0.03e-3, .mean = e.value - e.nominal});
    times.push_back(outcome.with /
                    error_of(calibrate(told, sister.measured, first(14)), sister, 14));
    EXPECT_NE(outcome.found.likeness->kind, Likeness::Kind::kUnlike) << seed;
    EXPECT_LT(outcome.found.decided, 33.0);
  }
  EXPECT_LT(median_of(times), 1.1);
}

TEST(Likeness, AnArmThatSharesNothingIsSeenAndDoesNoHarm) {
  std::vector<double> times;
  int unlike = 0;
  for (const auto seed : kSeeds) {
    const Cell cell = some_cell(seed);
    const auto reference = reference_of(cell, seed);
    const auto other = measured(cell, 40, seed + 200, 2, 0.3e-3);
    const auto outcome = outcome_of(cell, other, 40, reference);
    times.push_back(outcome.with / outcome.alone);
    EXPECT_LT(outcome.with, 1.2 * outcome.alone) << seed;
    EXPECT_LT(outcome.found.likeness->same_chance, 0.01) << seed;
    unlike += outcome.found.likeness->kind == Likeness::Kind::kUnlike ? 1 : 0;
  }
  EXPECT_LT(median_of(times), 1.05);
  EXPECT_GE(unlike, 4);
}

TEST(Likeness, OneEncoderThatMovedIsNamedAndTheRestIsKept) {
  for (const auto seed : kSeeds) {
    const Cell cell = some_cell(seed);
    const auto reference = reference_of(cell, seed);
    auto later = measured(cell, 16, seed, 2, 0.3e-3);
    later.measured.q.col(2).array() -= 1.5e-3;  // the readings of the third encoder
    const auto outcome = outcome_of(cell, later, 16, reference);
    EXPECT_EQ(outcome.found.likeness->changed, "J3.theta") << seed;
    EXPECT_LT(outcome.with, outcome.alone) << seed;
  }
}

TEST(Likeness, OneWrongReadingIsSeenThoughThereAreFew) {
  for (const auto seed : kSeeds) {
    const Cell cell = some_cell(seed);
    auto later = measured(cell, 12, seed, 2, 0.3e-3);
    later.measured.p_M(5, 1) += 5e-3;
    const auto outcome = outcome_of(cell, later, 12, reference_of(cell, seed));
    ASSERT_EQ(outcome.found.outliers.size(), 1U) << seed;
    EXPECT_EQ(outcome.found.outliers[0].row, 5);
    EXPECT_LT(outcome.with, 0.1e-3);
  }
}

TEST(Likeness, NoiseBeyondWhatWasStatedIsNoDifferenceOfTheArms) {
  for (const double noise : {0.1e-3, 0.5e-3, 3e-3})
    for (const auto seed : kSeeds) {
      const Cell cell = some_cell(seed);
      SimulationPlan plan;
      plan.poses = 16 + kJudged;
      plan.noise_m = noise;
      plan.seed = 2;
      plan.truth.seed = seed;
      plan.truth.geometry_m = plan.truth.geometry_rad = 0.3e-3;
      const auto later = simulate(cell, plan);
      const auto outcome = outcome_of(cell, later, 16, reference_of(cell, seed));
      EXPECT_LT(outcome.with, outcome.alone) << noise << " " << seed;
      EXPECT_NE(outcome.found.likeness->kind, Likeness::Kind::kUnlike) << noise << " " << seed;
    }
}

TEST(Likeness, OffsetsOfSeveralJointsMayHaveChanged) {
  for (const auto seed : kSeeds) {
    const Cell cell = some_cell(seed);
    auto later = measured(cell, 16, seed, 2, 0.3e-3);
    for (int j = 1; j < 5; ++j) later.measured.q.col(j).array() += 1e-3 * (j % 2 == 0 ? 2 : -3);
    const auto outcome = outcome_of(cell, later, 16, reference_of(cell, seed));
    EXPECT_EQ(outcome.found.likeness->changed, "offsets") << seed;
    EXPECT_LT(outcome.with, outcome.alone) << seed;
  }
}

/// The earlier run fitted tracker and reflector, which here are given: what it held at nominal in
/// their place is free now.
TEST(Likeness, WhatTheEarlierRunHeldIsFittedWhereItCanBe) {
  for (const auto seed : kSeeds) {
    const Cell cell = some_cell(seed);
    const auto later = measured(cell, 40, seed, 2, 0.3e-3);
    const auto reference = reference_of(cell, seed);
    Cell frame = cell, target = cell;
    frame.measurement.fit_frame = false;
    frame.measurement.X_MB = later.X_MB;
    target.measurement.fit_target = false;
    target.measurement.target_T = {later.X_TG.p[0], later.X_TG.p[1], later.X_TG.p[2]};
    for (const Cell& given : {frame, target}) {
      const auto outcome = outcome_of(given, later, 40, reference);
      EXPECT_LT(outcome.with, 1.2 * outcome.alone) << seed;
    }
  }
}

/// The truth lies within the stated uncertainty as often as it should, whatever the arms share.
TEST(Likeness, StatesItsUncertaintyHonestly) {
  int inside = 0, all = 0;
  for (const double spread : {0.01e-3, 0.05e-3, 0.2e-3})
    for (const auto seed : kSeeds) {
      const Cell cell = some_cell(seed);
      const auto before = measured(cell, 150, seed, 1, 0.3e-3);
      const auto reference = reference_of(cell, seed);
      Cell around = cell;
      around.nominal = before.true_chain;
      const auto sister = measured(around, 16, seed + 300, 2, spread);
      const auto outcome = outcome_of(cell, sister, 16, reference);
      ArmState truth;
      truth.arm.calibrated = sister.true_chain;
      for (std::size_t i = 0; i < outcome.found.estimates.size(); ++i) {
        const Estimate& e = outcome.found.estimates[i];
        // Alone of its kind: no number held at nominal acts as a length between parallel axes does.
        if (!e.of_robot || e.name.find(".a") == std::string::npos) continue;
        ++all;
        const double off = value_of(truth, outcome.found.parameters[i]) - e.value;
        inside += std::abs(off) < 2.0 * e.std ? 1 : 0;
      }
    }
  EXPECT_GT(inside, 0.88 * all);
  EXPECT_LT(inside, 1.00 * all);
}

/// An arm with the usual wrist, whose second joint has an eccentric encoder.
Cell arm_with_usual_wrist() {
  Cell cell = random_cell(1, 6, format::Convention::kModified, ArmKind::kRevolute);
  cell.measurement.sigma_m = kNoise_m;
  constexpr double kRight = M_PI / 2.0;
  constexpr double kRows[6][4] = {{0.0, 0.0, 0.6, 0.0},     {-kRight, 0.2, 0.0, -kRight},
                                  {0.0, 0.9, 0.0, kRight},  {kRight, 0.0, 0.8, 0.0},
                                  {-kRight, 0.0, 0.0, 0.0}, {kRight, 0.0, 0.2, 0.0}};
  for (std::size_t j = 0; j < 6; ++j) {
    auto& row = cell.nominal.joints[j];
    row.alpha = kRows[j][0], row.a = kRows[j][1], row.d = kRows[j][2], row.theta = kRows[j][3];
    row.q_min = -2.0, row.q_max = 2.0;
  }
  cell.effects.push_back(
      {.name = "encoder_eccentricity", .joints = {1}, .options = {}, .place = {}});
  return cell;
}

/// Poses of it in which the tool points up.
RowsN with_vertical_tool(const Cell& cell, int poses) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> within(-2.0, 2.0);
  RowsN out(poses, cell.joints());
  for (Eigen::Index i = 0; i < poses; ++i) {
    do {
      for (Eigen::Index j = 0; j < out.cols(); ++j) out(i, j) = within(random);
      out(i, 3) = 0.0;
      out(i, 4) = -out(i, 1) - out(i, 2);
    } while (std::abs(out(i, 4)) > 2.0);
  }
  return out;
}

TEST(Likeness, WhereTheReflectorSitsIsTakenOverIfThePosesCannotTell) {
  const Cell cell = arm_with_usual_wrist();
  SimulationPlan plan;
  plan.poses = 120;
  plan.noise_m = kNoise_m;
  plan.truth.seed = 4;
  plan.truth.geometry_m = plan.truth.geometry_rad = 0.3e-3;
  plan.truth.effects = {"encoder_eccentricity=100urad:J2"};
  plan.truth.target_T = {0.03, -0.02, 0.15};
  const auto before = simulate(cell, plan);
  const auto reference = calibrate(cell, before.measured, first(120));
  plan.seed = 2;
  plan.q = with_vertical_tool(cell, 120);
  const auto later = simulate(cell, plan);
  Cell with = cell;
  with.fit.earlier = earlier(reference);
  const auto found = calibrate(with, later.measured, first(80));
  EXPECT_EQ(std::count(found.held.begin(), found.held.end(), "target.z"), 1);
  EXPECT_NEAR(found.state.X_TG.p[2], reference.state.X_TG.p[2], 1e-12);
  EXPECT_EQ(std::count_if(found.remarks.begin(), found.remarks.end(),
                          [](const Problem& p) { return p.code == "N-FIT-REFLECTOR"; }),
            1);
  EXPECT_LT(error_of(found, later, 80), kNoise_m);
  // Of too few poses it is their number that leaves it open.
  EXPECT_THROW(calibrate(with, later.measured, first(7)), Failure);
}

TEST(Likeness, AnotherModelIsRefused) {
  const Cell cell = some_cell(1);
  const auto s = measured(cell, 40, 1, 1, 0.3e-3);
  auto other = std::make_shared<EarlierArm>(*earlier(calibrate(cell, s.measured, first(40))));
  other->numbers.front().nominal += 1e-3;
  Cell with = cell;
  with.fit.earlier = other;
  try {
    calibrate(with, s.measured, first(40));
    FAIL() << "not refused";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.problems().front().code, "E-FIT-EARLIER");
  }
}

}  // namespace
}  // namespace plumb::offline

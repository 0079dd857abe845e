// SPDX-License-Identifier: Apache-2.0
#include "fit/controller_base.hpp"

#include <gtest/gtest.h>

#include "arm/predicted_points.hpp"
#include "fit/fit.hpp"
#include "fit/fit_cell.hpp"
#include "plumb/runtime/transform.hpp"
#include "simulate/simulate.hpp"
#include "tests/cases/random_cell.hpp"

namespace plumb::offline {
namespace {

const Cell kCell = random_cell(4, 6, format::Convention::kModified, ArmKind::kRevolute);

SimulationPlan plan_of(double noise_m) {
  SimulationPlan plan;
  plan.poses = 150;
  plan.noise_m = noise_m;
  plan.seed = 9;
  plan.truth.geometry_m = 0.5e-3;
  plan.truth.geometry_rad = 0.5e-3;
  plan.truth.seed = 9;
  plan.truth.target_T = {0.02, -0.01, 0.3};
  return plan;
}

/// These points as a controller shows them whose base stands elsewhere.
Rows3 seen_from_elsewhere(const Rows3& p) {
  const Transformd X = translation(0.3, -1.2, 0.4) * rot_z(2.0) * rot_x(0.7);
  Rows3 out = p * X.R.transpose();
  out.rowwise() += X.p.transpose();
  return out;
}

Rows3 of_nominal_arm(const MeasurementFiles& m, const Vector3& tool_T) {
  ArmState nominal;
  nominal.arm.calibrated = kCell.nominal;
  for (int k = 0; k < 3; ++k) nominal.X_TG.p[k] = tool_T(k);
  return predict_points(nominal, m.q);
}

Cell without_geometry(Cell cell) {
  cell.effects.clear();
  return cell;
}

TEST(ControllerBase, AControllerThatKnowsTheTrueArmLeavesNothingButNoise) {
  const Simulation s = simulate(kCell, plan_of(10e-6));
  MeasurementFiles m = s.measured;
  m.nominal_B = seen_from_elsewhere(s.true_p_M);
  const Cell cell = without_geometry(kCell);
  const double by_the_cell = fit_cell(cell, m).held.rms;
  stand_on_controller(cell, m);
  const Fit fit = fit_cell(cell, m);
  EXPECT_EQ(fit.base, Base::kController);
  EXPECT_GT(by_the_cell, 300e-6);
  EXPECT_LT(fit.held.rms, 21e-6);  // sqrt(3) times 10 um, and the frame
  EXPECT_GT(departure_of(m).mean, 100e-6);
}

TEST(ControllerBase, AControllerThatKnowsTheNominalArmChangesNothing) {
  MeasurementFiles m = simulate(kCell, plan_of(10e-6)).measured;
  const Fit plain = fit_cell(kCell, m);
  m.nominal_B = seen_from_elsewhere(of_nominal_arm(m, {0.02, -0.01, 0.3}));
  stand_on_controller(kCell, m);
  EXPECT_LT(departure_of(m).max, 1e-9);
  const Fit fit = fit_cell(kCell, m);
  EXPECT_NEAR(fit.held.rms, plain.held.rms, 1e-9);
  ASSERT_EQ(fit.calibration.estimates.size(), plain.calibration.estimates.size());
  for (std::size_t i = 0; i < fit.calibration.estimates.size(); ++i)
    EXPECT_NEAR(fit.calibration.estimates[i].value, plain.calibration.estimates[i].value, 1e-7)
        << fit.calibration.estimates[i].name;
}

TEST(ControllerBase, GeometryIsFittedOnTopOfWhatTheControllerKnows) {
  const Simulation s = simulate(kCell, plan_of(0.0));
  SimulationPlan other = plan_of(0.0);
  other.truth.seed = 10;  // the same poses of an arm that is wrong otherwise
  MeasurementFiles m = s.measured;
  const Simulation known = simulate(kCell, other);
  ASSERT_EQ(known.measured.q, m.q);
  m.nominal_B = known.true_p_M;
  stand_on_controller(kCell, m);
  // The second order of half a millimetre and half a milliradian, joint by joint, is left.
  EXPECT_LT(fit_cell(kCell, m).held.rms, 10e-6);
}

TEST(ControllerBase, FewRowsStandWhereTheMeasuredOnesPutThem) {
  const Simulation s = simulate(kCell, plan_of(0.0));
  MeasurementFiles m = s.measured;
  m.nominal_B = seen_from_elsewhere(s.true_p_M);
  MeasurementFiles two = pick(m, {3, 77});
  stand_on_controller(kCell, m, two);
  stand_on_controller(kCell, m);
  EXPECT_LT((two.departure_B - pick(m, {3, 77}).departure_B).norm(), 1e-12);
}

std::string refusal(MeasurementFiles m) {
  try {
    stand_on_controller(kCell, m);
  } catch (const Failure& failure) {
    return failure.problems().front().code;
  }
  return "";
}

TEST(ControllerBase, MissingPositionsAndThoseOfAnotherArmAreRefused) {
  MeasurementFiles m = simulate(kCell, plan_of(0.0)).measured;
  EXPECT_EQ(refusal(m), "E-FIT-BASE");
  m.nominal_B = 1e3 * of_nominal_arm(m, Vector3::Zero());  // mm taken for m
  EXPECT_EQ(refusal(m), "E-FIT-BASE-FAR");
  m.nominal_B = of_nominal_arm(m, Vector3::Zero()).colwise().reverse();  // other rows
  EXPECT_EQ(refusal(m), "E-FIT-BASE-FAR");
}

}  // namespace
}  // namespace plumb::offline

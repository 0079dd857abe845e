// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <complex>

#include "one_joint.hpp"
#include "simulate/beam.hpp"

namespace plumb::offline {
namespace {

using Eigen::Vector3d;

const Vector3d kAlong = Vector3d::UnitX();
const Vector3d kNone = Vector3d::Zero();

TEST(Beam, ConstantSectionBendsAsThePrismaticCantileverOfTextbooks) {
  const double L = 1.7, EI = 4.2e4, P = 310.0, M = 55.0, m = 21.0, g = 9.81;
  const sim::TaperedBeam beam{.length = L, .EI = EI, .taper = 0.0, .mass = m};
  const sim::TaperedBeam weightless{.length = L, .EI = EI, .taper = 0.0};
  const auto load = sim::bend(weightless, kAlong, {0, -P, 0}, kNone, kNone);
  EXPECT_NEAR(load.displacement.y(), -P * L * L * L / (3 * EI), 1e-13);
  EXPECT_NEAR(load.rotation.z(), -P * L * L / (2 * EI), 1e-13);
  const auto couple = sim::bend(weightless, kAlong, kNone, {0, 0, M}, kNone);
  EXPECT_NEAR(couple.displacement.y(), M * L * L / (2 * EI), 1e-14);
  EXPECT_NEAR(couple.rotation.z(), M * L / EI, 1e-14);
  const auto weight = sim::bend(beam, kAlong, kNone, kNone, {0, 0, -g});
  EXPECT_NEAR(weight.displacement.z(), -m * g * L * L * L / (8 * EI), 1e-14);
  EXPECT_NEAR(weight.rotation.y(), m * g * L * L / (6 * EI), 1e-14);
}

TEST(Beam, TorsionOfConstantSectionIsMomentTimesLengthOverGJ) {
  const sim::TaperedBeam beam{.length = 0.8, .EI = 1e4, .GJ_over_EI = 0.5, .taper = 0.0};
  const auto end = sim::bend(beam, kAlong, kNone, {30.0, 0, 0}, kNone);
  EXPECT_NEAR(end.rotation.x(), 30.0 * 0.8 / 5e3, 1e-15);
  EXPECT_LT(end.displacement.norm(), 1e-18);
}

TEST(Beam, ConeUnderEndLoadSagsByTheDiameterRatioMore) {
  // PL^3/3EI D/d [Young, Roark's formulas, cone with end load].
  for (const double taper : {0.1, 0.4, 0.6}) {
    const sim::TaperedBeam beam{.length = 1.2, .EI = 2e4, .taper = taper};
    const double straight = 100.0 * std::pow(1.2, 3) / (3 * 2e4);
    const auto end = sim::bend(beam, kAlong, {0, 100.0, 0}, kNone, kNone);
    EXPECT_NEAR(end.displacement.y() / straight, 1.0 / (1.0 - taper), 1e-6) << taper;
  }
}

TEST(Beam, AxialForceDoesNotBend) {
  const auto end = sim::bend({}, kAlong, {500.0, 0, 0}, kNone, kNone);
  EXPECT_EQ(end.displacement.norm(), 0.0);
  EXPECT_EQ(end.rotation.norm(), 0.0);
}

TEST(GearHarmonics, FourierAnalysisFindsTheStatedAmplitudesAndNoOthers) {
  Cell cell = one_joint();
  cell.gravity = {0.0, 0.0, -9.81};  // along the axis: no load
  const int n = 64;
  std::vector<double> q;
  for (int k = 0; k < n; ++k) q.push_back(2 * kPi * k / n - kPi);
  const auto simulation = simulate(cell, noise_free(q, "gear_harmonics:J1=200urad"));
  const auto error = joint_error(simulation);
  const double expected[] = {0.0, 200e-6, 120e-6, 16e-6, 0.0, 0.0};
  const auto truth = first_effect(simulation)[0]["harmonics"];
  for (int h = 0; h < 6; ++h) {
    std::complex<double> sum = 0.0;
    for (int k = 0; k < n; ++k) sum += error[k] * std::polar(1.0, -h * q[k]);
    EXPECT_NEAR(std::abs(sum) * 2 / n, expected[h], 1e-12) << "harmonic " << h;
    if (h < 1 || h > 3) continue;
    EXPECT_NEAR(truth[h - 1]["amplitude_urad"], expected[h] * 1e6, 1e-9);
    // sin(h q + p) = Re(exp(i (h q + p - pi / 2))).
    const double phase = std::arg(sum) + kPi / 2 - double(truth[h - 1]["phase_rad"]);
    EXPECT_NEAR(std::remainder(phase, 2 * kPi), 0.0, 1e-6);
  }
}

TEST(GearHarmonics, AmplitudeGrowsWithTheGravityTorqueOfTheJoint) {
  Cell cell = one_joint();
  cell.payload.mass_kg = 10.0;
  const std::vector<double> q{0.0, 0.4, 2.0, -3.0};
  const auto loaded = simulate(cell, noise_free(q, "gear_harmonics"));
  cell.payload.mass_kg = 0.0;
  const auto idle = simulate(cell, noise_free(q, "gear_harmonics"));
  const auto a = joint_error(loaded), b = joint_error(idle);
  for (std::size_t row = 0; row < q.size(); ++row) {
    EXPECT_NEAR(a[row] / b[row], 1.0 - 0.15 * std::cos(q[row]), 1e-4);
  }
}

TEST(JointCompliance, FollowsTheSofteningSpringUnderTheWeightOfTheLink) {
  Cell cell = one_joint();
  cell.mechanics[0].link_mass_kg = 12.0;
  cell.mechanics[0].link_com_m = {0.5, 0.0, 0.0};
  const std::vector<double> q{0.0, 1.0, 1.5, -2.0, 3.0};
  const auto simulation = simulate(cell, noise_free(q, "joint_compliance:J1=150urad"));
  const auto truth = first_effect(simulation)[0];
  const double largest = truth["largest_torque_Nm"];
  EXPECT_NEAR(largest, 12.0 * 9.81 * 0.5, 1e-3 * largest);
  const auto error = joint_error(simulation);
  for (std::size_t row = 0; row < q.size(); ++row) {
    const double x = -12.0 * 9.81 * 0.5 * std::cos(q[row]) / largest;
    EXPECT_NEAR(error[row], 150e-6 * (0.92 * x + 0.08 * x * std::abs(x)), 1e-12);
  }
  EXPECT_NEAR(truth["stiffness_Nm_per_rad"], largest / (150e-6 * 0.92), 1e-6 * largest / 150e-6);
}

TEST(LinkFlexure, PayloadBendsTheLinkAsAConeAndTurnsTheTool) {
  Cell cell = one_joint();
  cell.payload.mass_kg = 10.0;
  cell.measurement.target_T = {0.2, 0.0, 0.0};
  const auto simulation = simulate(cell, noise_free({0.0}, "link_flexure:J1=100urad"));
  const double EI = first_effect(simulation)[0]["root_EI_Nm2"];
  const double P = 98.1, taper = first_effect(simulation)[0]["taper"];
  // Slope of a cone: P L^2/EI int (1-x)/(1-tx)^4 dx = P L^2/EI (3 - 2t) / (6 (1-t)^2).
  const double sag = P / (3 * EI * (1 - taper));
  const double slope = P / EI * (3 - 2 * taper) / (6 * std::pow(1 - taper, 2));
  EXPECT_NEAR(simulation.true_p_M(0, 1), -sag - 0.2 * std::sin(slope), 1e-10);
  EXPECT_NEAR(slope, 100e-6, 1e-7);  // arm stretched: the largest
}

TEST(Drift, ReachesItsSizeAfterOneHour) {
  SimulationPlan plan = noise_free(std::vector<double>(121, 0.7), "drift=200um");
  const auto simulation = simulate(one_joint(), plan);
  const auto d = first_effect(simulation)["shift_um_in_first_hour"];
  const auto e = first_effect(simulation)["rotation_urad_in_first_hour"];
  const Vector3d shift(d[0], d[1], d[2]), turn(e[0], e[1], e[2]);
  EXPECT_NEAR(shift.norm(), 200.0, 1e-9);
  const Vector3d p(std::cos(0.7), std::sin(0.7), 0.0);
  EXPECT_NEAR((simulation.true_p_M.row(0).transpose() - p).norm(), 0.0, 1e-15);
  const Vector3d expected_um = shift + turn.cross(p);
  const Vector3d moved_um = 1e6 * (simulation.true_p_M.row(120).transpose() - p);
  EXPECT_NEAR((moved_um - expected_um).norm(), 0.0, 0.05);  // second order
  const Vector3d early_um = 1e6 * (simulation.true_p_M.row(40).transpose() - p);
  const double g = 0.6 * (1 - std::exp(-1.0)) / (1 - std::exp(-3.0)) + 0.4 / 3.0 +
                   0.05 * std::sin(4 * kPi / 3.0);
  EXPECT_NEAR((early_um - g * expected_um).norm(), 0.0, 0.05);
}

TEST(Reversal, StopsShortBySideAndRemembersAShortMove) {
  const double c = kPi / 180.0;
  SimulationPlan plan = noise_free({1.0, -1.0, -1.0 + c, -1.0 + c}, "reversal:J1=80urad");
  const auto simulation = simulate(one_joint(), plan);
  const auto error = joint_error(simulation);
  const double h = 80e-6;
  EXPECT_NEAR(error[0], -h, 1e-12);  // from below
  EXPECT_NEAR(error[1], h, 1e-12);   // from above
  // One q_c upwards: the flank changes to all but 1/e: -h + 2 h / e.
  EXPECT_NEAR(error[2], -h + 2 * h / std::exp(1.0), 1e-12);
  EXPECT_NEAR(error[3], error[2], 1e-15);  // at rest
}

TEST(Reversal, RecordsHowEachJointArrived) {
  const auto simulation = simulate(one_joint(), noise_free({1.0, -1.0, -1.0}, "reversal"));
  ASSERT_EQ(simulation.context.size(), 3U);
  EXPECT_EQ(simulation.context[1].header, "dir_j1");
  EXPECT_EQ(simulation.context[1].values, (std::vector<double>{1.0, -1.0, -1.0}));
  EXPECT_EQ(simulation.context[2].header, "travel_j1_deg");
  EXPECT_EQ(simulation.context[2].values, (std::vector<double>{1.0, 2.0, 2.0}));
}

}  // namespace
}  // namespace plumb::offline

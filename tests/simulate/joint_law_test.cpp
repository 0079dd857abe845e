// SPDX-License-Identifier: Apache-2.0
// Laws of single joints against closed forms and other ways to compute them.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "one_joint.hpp"
#include "simulate/arm.hpp"
#include "simulate/planar.hpp"

namespace plumb::offline {
namespace {

using Eigen::Vector3d;

constexpr double kWeight_N = 12.0 * 9.81;

Cell loaded_joint() {
  Cell cell = one_joint();
  cell.mechanics[0].link_mass_kg = 12.0;
  cell.mechanics[0].link_com_m = {0.5, 0.0, 0.0};
  return cell;
}

double torque(double q) { return -0.5 * kWeight_N * std::cos(q); }

Cell unloaded_joint() {
  Cell cell = one_joint();
  cell.gravity = {0.0, 0.0, -9.81};
  return cell;
}

// |coefficient| of sin(h q + phase) for h = 0 .. most.
std::vector<double> amplitudes(const std::string& effect, int most, double richness = 1.0) {
  const int n = 128;
  std::vector<double> q, out;
  for (int k = 0; k < n; ++k) q.push_back(2 * kPi * k / n - kPi);
  SimulationPlan plan = noise_free(q, effect);
  plan.truth.richness = richness;
  const auto error = joint_error(simulate(unloaded_joint(), plan));
  for (int h = 0; h <= most; ++h) {
    std::complex<double> sum = 0.0;
    for (int k = 0; k < n; ++k) sum += error[k] * std::polar(1.0, -h * q[k]);
    out.push_back(std::abs(sum) * 2 / n);
  }
  return out;
}

TEST(SoftSpring, IsTheIntegralOfAComplianceThatFallsWithTorque) {
  const std::vector<double> q{0.0, 0.5, 1.2, 1.5, 1.9, 3.0};
  const auto simulation =
      simulate(loaded_joint(), noise_free(q, "joint_compliance_soft:J1=150urad"));
  const auto truth = first_effect(simulation)[0];
  const double K = truth["stiffness_Nm_per_rad"], softer = truth["softer_at_rest_by"];
  const double seat = truth["seated_at_Nm"];
  const auto error = joint_error(simulation);
  for (std::size_t row = 0; row < q.size(); ++row) {
    const int n = 2000;
    double sum = 0.0;
    for (int k = 0; k < n; ++k) {  // midpoint rule
      const double t = torque(q[row]) * (k + 0.5) / n;
      sum += (1.0 + (softer - 1.0) / std::pow(std::cosh(t / seat), 2)) / K;
    }
    EXPECT_NEAR(error[row], sum * torque(q[row]) / n, 1e-10);
  }
  const double stiff = (error[1] - error[0]) * K / (torque(q[1]) - torque(q[0]));
  EXPECT_NEAR(stiff, 1.0, 0.02) << "far from rest it is a spring of stiffness K";
}

TEST(Eccentricity, HasTheHarmonicsOfItsSeriesAndOnlyTheFirstWhenSmall) {
  // atan2(e sin a, 1 + e cos a) = e sin a - e^2 sin(2 a) / 2 + e^3 sin(3 a) / 3 - ...
  const auto large = amplitudes("encoder_eccentricity:J1=10mrad", 4);
  for (int h = 1; h <= 4; ++h) EXPECT_NEAR(large[h], std::pow(0.01, h) / h, 1e-14) << h;
  const auto small = amplitudes("encoder_eccentricity:J1=100urad", 4);
  EXPECT_NEAR(small[1], 100e-6, 1e-13);
  EXPECT_LT(small[2], 1e-8);
}

TEST(GearRipple, HasItsCyclesAndTwoSidebands) {
  const auto found = amplitudes("gear_ripple:J1=100urad@cycles=20", 40);
  for (int h = 1; h <= 40; ++h) {
    const double expected = h == 20 ? 100e-6 : (h == 19 || h == 21 ? 6e-6 : 0.0);
    EXPECT_NEAR(found[h], expected, 1e-12) << h;
  }
}

TEST(Richness, OfZeroLeavesThePlainLaw) {
  const auto ripple = amplitudes("gear_ripple:J1=100urad@cycles=20", 40, 0.0);
  const auto harmonics = amplitudes("gear_harmonics:J1=100urad", 6, 0.0);
  for (int h = 1; h <= 40; ++h) EXPECT_NEAR(ripple[h], h == 20 ? 100e-6 : 0.0, 1e-12) << h;
  for (int h = 3; h <= 6; ++h) EXPECT_NEAR(harmonics[h], 0.0, 1e-12) << h;
  SimulationPlan plan = noise_free({0.0, 1.2}, "joint_compliance:J1=150urad");
  plan.truth.richness = 0.0;
  const auto error = joint_error(simulate(loaded_joint(), plan));
  EXPECT_NEAR(error[1] / error[0], std::cos(1.2), 1e-6) << "a linear spring";
}

TEST(GearRipple, DrawsCyclesThatAreHardlyEverWhole) {
  int whole = 0, slow = 0, fast = 0;
  SimulationPlan plan = noise_free({0.3}, "gear_ripple:J1=100urad");
  for (plan.seed = 1; plan.seed <= 300; ++plan.seed) {
    const double k = first_effect(simulate(unloaded_joint(), plan))[0]["cycles_per_turn"];
    EXPECT_GE(k, 0.5);
    EXPECT_LE(k, 40.0);
    EXPECT_GT(std::abs(k - 1.0), 0.2);
    EXPECT_GT(std::abs(k - 2.0), 0.2);
    whole += std::abs(k - std::round(k)) < 1e-3, slow += k<4.0, fast += k> 20.0;
  }
  EXPECT_LE(whole, 4);
  EXPECT_GT(slow, 50);
  EXPECT_GT(fast, 20);
}

TEST(Backlash, LiesOnUnequalPlateausAndIsMonotone) {
  std::vector<double> q;
  for (int k = 0; k <= 180; ++k) q.push_back(kPi * k / 180);  // from -largest to largest torque
  const auto simulation = simulate(loaded_joint(), noise_free(q, "backlash_load:J1=80urad"));
  const double more = first_effect(simulation)[0]["upper_flank_more_by"];
  const auto error = joint_error(simulation);
  EXPECT_NEAR(error.front(), -80e-6, 1e-10);
  EXPECT_NEAR(error.back(), 80e-6 * (1 + more), 1e-10);
  EXPECT_GT(more, 0.05);
  for (std::size_t k = 1; k < error.size(); ++k) EXPECT_GE(error[k] - error[k - 1], -1e-15);
}

TEST(EncoderScale, IsAStraightLineWithASlightBow) {
  const auto e = joint_error(
      simulate(unloaded_joint(), noise_free({-1.0, 0.0, 1.0, 2.0}, "encoder_scale:J1=50urad")));
  EXPECT_NEAR(std::abs(e[2] - e[0]), 2 * 50e-6, 1e-12);
  EXPECT_NEAR(e[1], 0.0, 1e-15);
  EXPECT_NEAR(std::abs(e[2] + e[0]), 2 * 0.03 * 50e-6, 1e-12);
}

TEST(SettlingLag, SaturatesWithTheStepAndStaysWhereThePoseIsReadAgain) {
  const double c = 20.0 * kPi / 180.0;
  const std::vector<double> q{c, c, 2.5, -2.5};
  const auto error = joint_error(simulate(one_joint(), noise_free(q, "settling_lag:J1=100urad")));
  EXPECT_NEAR(error[0], -100e-6 * (1 - std::exp(-1.0)), 1e-12);  // a lone joint: step / max = 1
  EXPECT_EQ(error[1], error[0]);
  EXPECT_NEAR(error[3], 100e-6, 1e-9);  // a long way down: stays above
}

TEST(JointMemory, FollowsThePoseBefore) {
  const std::vector<double> q{0.4, -1.1, 2.0, 2.0};
  const auto simulation = simulate(one_joint(), noise_free(q, "joint_memory:J1=100urad"));
  const double phase = first_effect(simulation)[0]["phase_rad"];
  const double before[] = {0.0, 0.4, -1.1, -1.1};
  for (int row = 0; row < 4; ++row) {
    EXPECT_NEAR(joint_error(simulation)[row], 100e-6 * std::sin(before[row] + phase), 1e-12);
  }
}

TEST(Reversal, RubsMoreWhereTheJointCarriesMore) {
  const auto simulation = simulate(loaded_joint(), noise_free({0.0, kPi / 2}, "reversal=80urad"));
  const auto error = joint_error(simulation);
  EXPECT_NEAR(error[1] / -80e-6, 1.0, 1e-3);
  const auto carrying =
      joint_error(simulate(loaded_joint(), noise_free({2.0, 0.0}, "reversal=80urad")));
  EXPECT_NEAR(carrying[1] / 80e-6, 1.3, 2e-3);
}

// Two links of 1 m in a vertical plane, all the weight at the tip.
Cell two_links() {
  Cell cell = planar_cell(PlanarVariant::kPrinted);
  for (auto& link : cell.mechanics) {
    link.link_mass_kg = 0.0;
    link.link_com_m = {0.0, 0.0, 0.0};
  }
  return cell;
}

// Turn of the second link against the first, minus q2, and its torques from the load.
struct Elbow {
  double dq1, dq2, tau1, tau2;
};
Elbow elbow(const Simulation& simulation, double q1, double q2) {
  const Vector3d p = simulation.true_p_M.row(0).transpose() - Vector3d(0.0, kPlanarOriginY_m, 0.0);
  // Law of cosines gives the angles of a two-link arm back.
  const double c = (p.squaredNorm() - 2.0) / 2.0;
  const double turned2 = std::copysign(std::acos(c), q2);
  const double turned1 = std::atan2(p.y(), p.x()) - turned2 / 2.0;
  const double load = 98.1;
  return {turned1 - q1, turned2 - q2, -load * (std::cos(q1) + std::cos(q1 + q2)),
          -load * std::cos(q1 + q2)};
}

Simulation at(double q1, double q2, const std::string& effect) {
  SimulationPlan plan;
  plan.q.resize(1, 2);
  plan.q << q1, q2;
  plan.noise_m = 0.0;
  plan.truth.effects = {effect};
  return simulate(two_links(), plan);
}

TEST(CrossCompliance, TurnsOneJointByTheTorqueOfAnother) {
  for (const double q2 : {0.7, 1.5, 2.2}) {
    const auto simulation = at(0.3, q2, "cross_compliance:J2=100urad@from=1");
    const auto truth = first_effect(simulation)[0];
    const auto [dq1, dq2, tau1, tau2] = elbow(simulation, 0.3, q2);
    const double y = tau1 / double(truth["largest_torque_Nm"]), sign = truth["sign"];
    EXPECT_NEAR(dq1, 0.0, 1e-13);
    EXPECT_NEAR(dq2, sign * 100e-6 * (0.94 * y + 0.06 * y * std::abs(y)), 1e-12);
  }
}

TEST(PayloadCompliance, KnowsOnlyThePayload) {
  Cell heavier = two_links();
  const auto light = at(0.3, 0.9, "payload_compliance:J2=100urad");
  const double x =
      elbow(light, 0.3, 0.9).tau2 / double(first_effect(light)[0]["largest_torque_Nm"]);
  EXPECT_NEAR(elbow(light, 0.3, 0.9).dq2, 100e-6 * (0.92 * x + 0.08 * x * x * x), 1e-12);
  heavier.mechanics[1].link_mass_kg = 50.0;
  heavier.mechanics[1].link_com_m = {-0.5, 0.0, 0.0};
  SimulationPlan plan;
  plan.q.resize(1, 2);
  plan.q << 0.3, 0.9;
  plan.noise_m = 0.0;
  plan.truth.effects = {"payload_compliance:J2=100urad"};
  EXPECT_EQ(simulate(heavier, plan).true_p_M, light.true_p_M);
}

TEST(GravityCompensator, IsASpringWithoutTorqueAtItsDeadCentre) {
  std::vector<double> q;
  for (int k = 0; k < 720; ++k) q.push_back(2 * kPi * k / 720 - kPi);
  const auto simulation =
      simulate(unloaded_joint(), noise_free(q, "gravity_compensator:J1=90urad"));
  const auto truth = first_effect(simulation)[0];
  const double p = truth["pivot_over_crank"], free = truth["free_length_over_crank"];
  const double zero = truth["zero_rad"];
  const auto error = joint_error(simulation);
  // The torque is the slope of the energy (L - L0)^2 / 2, up to sign and scale.
  const auto energy = [&](double a) {
    const double length = std::hypot(p + std::cos(a - zero), std::sin(a - zero));
    return 0.5 * std::pow(length - free, 2);
  };
  double largest = 0.0, worst = 0.0, most_slope = 0.0;
  for (const double a : q)
    most_slope = std::max(most_slope, std::abs(energy(a + 1e-5) - energy(a - 1e-5)));
  for (std::size_t k = 0; k < q.size(); ++k) {
    const double slope = -(energy(q[k] + 1e-5) - energy(q[k] - 1e-5)) / most_slope;
    worst = std::max(worst, std::abs(error[k] / 90e-6 - slope));
    largest = std::max(largest, std::abs(error[k]));
  }
  EXPECT_NEAR(largest, 90e-6, 1e-9);
  EXPECT_LT(worst, 1e-4);
}

// Where the reflector is if every joint stands at q + dq.
Vector3d reflector(const Simulation& s, Eigen::VectorXd q, int joint, double dq) {
  q(joint) += dq;
  const sim::Arm arm(s.true_chain);
  return sim::to_isometry(s.X_MB) * (arm.frames(q).tool * Vector3d(s.X_TG.p.data()));
}

TEST(JointProduct, TurnsTheFifthJointByTheFourthAndSixthTogether) {
  Demo demo = make_demo("unknown");
  const auto simulation = simulate(demo.cell, demo.plan);
  const auto truth = first_effect(simulation)[0];
  const double size = 1e-6 * double(truth["size_urad"]);
  const double a = truth["phase_a_rad"], b = truth["phase_b_rad"];
  for (int row = 0; row < simulation.measured.size(); ++row) {
    const Eigen::VectorXd q = simulation.measured.q.row(row).transpose();
    const double dq = size * (std::sin(q(3) + a) * std::sin(q(5) + b) +
                              0.1 * std::sin(2 * q(3) + a) * std::sin(2 * q(5) + b));
    EXPECT_LT((reflector(simulation, q, 4, dq) - simulation.true_p_M.row(row).transpose()).norm(),
              1e-12);
  }
}

TEST(OtherJoint, TurnsAJointByTheHarmonicOfAnother) {
  Demo demo = make_demo("unknown");
  demo.plan.truth.effects = {"other_joint:J2=90urad@from=1,cycles=2"};
  const auto simulation = simulate(demo.cell, demo.plan);
  const double phase = first_effect(simulation)[0]["phase_rad"];
  const Eigen::VectorXd q = simulation.measured.q.row(7).transpose();
  const double dq = 90e-6 * std::sin(2 * q(0) + phase);
  EXPECT_LT((reflector(simulation, q, 1, dq) - simulation.true_p_M.row(7).transpose()).norm(),
            1e-12);
}

TEST(DressPack, IsTornBetweenWindingAndRubbing) {
  // One joint from -180 to 180 deg: x = q / pi.
  const auto up =
      joint_error(simulate(one_joint(), noise_free({-3.0, 1.0}, "dress_pack:J1=100urad")));
  const auto down =
      joint_error(simulate(one_joint(), noise_free({3.0, 1.0}, "dress_pack:J1=100urad")));
  const double x = 1.0 / kPi;
  EXPECT_NEAR(0.5 * (up[1] + down[1]), -100e-6 * (0.35 * x + 0.65 * x * x * x), 1e-12);
  EXPECT_NEAR(0.5 * (up[1] - down[1]), -100e-6 * 0.3 * (1 + x), 1e-10);
}

}  // namespace
}  // namespace plumb::offline

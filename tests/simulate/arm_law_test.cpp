// SPDX-License-Identifier: Apache-2.0
// Laws of base, tool, axes and tracker against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "one_joint.hpp"
#include "simulate/arm.hpp"
#include "simulate/climate.hpp"

namespace plumb::offline {
namespace {

using Eigen::Vector3d;

Vector3d vector_of(const nlohmann::json& list) {
  return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()};
}
Vector3d point(const Simulation& s, int row) { return s.true_p_M.row(row).transpose(); }
Vector3d tip(double q) { return {std::cos(q), std::sin(q), 0.0}; }
std::vector<double> still(int rows, double q) { return std::vector<double>(rows, q); }

TEST(Step, MovesTheReflectorExactlyFromOneRowToTheNext) {
  const std::vector<double> q{0.1, 0.9, -1.2, 2.0, 0.5, -0.4, 1.7, -2.2, 0.3, 1.1};
  const auto simulation = simulate(one_joint(), noise_free(q, "step_reflector=2mm@at=0.55"));
  const auto truth = first_effect(simulation);
  const Vector3d shift = 1e-3 * vector_of(truth["shift_mm"]);
  EXPECT_NEAR(shift.norm(), 2e-3, 1e-15);
  EXPECT_EQ(truth["row_after"], 6);
  EXPECT_EQ(truth["pose_before"], "P006");
  EXPECT_EQ(truth["pose_after"], "P007");
  for (int row = 0; row < 10; ++row) {
    const Eigen::AngleAxisd turn(q[row], Vector3d::UnitZ());
    const Vector3d expected = tip(q[row]) + (row < 6 ? Vector3d::Zero() : Vector3d(turn * shift));
    EXPECT_LT((point(simulation, row) - expected).norm(), 1e-15) << row;
  }
}

TEST(Step, NeverFallsBetweenTwoReadingsOfAPose) {
  int inside = 0;
  for (int percent = 1; percent < 96; ++percent) {
    SimulationPlan plan =
        noise_free({0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2},
                   "step_encoder:J1=200urad@at=0." + std::string(percent < 10 ? "0" : "") +
                       std::to_string(percent));
    plan.repeats = 8;
    const auto simulation = simulate(one_joint(), plan);
    const int row = first_effect(simulation)[0]["row_after"];
    EXPECT_NE(simulation.measured.q(row, 0), simulation.measured.q(row - 1, 0)) << percent;
    const auto error = joint_error(simulation);
    for (int k = 0; k < simulation.measured.size(); ++k) {
      EXPECT_NEAR(error[k], k < row ? 0.0 : 200e-6, 1e-14);
    }
    inside += row == 8;
  }
  EXPECT_GT(inside, 20) << "the first pose is read eight times";
}

TEST(Step, MovesTheBaseAsARigidBody) {
  const auto simulation =
      simulate(one_joint(), noise_free({0.3, 0.3, 1.4, 1.4, 0.3, 1.4}, "step_base=1mm@at=0.5"));
  const auto truth = first_effect(simulation);
  const Vector3d d = 1e-3 * vector_of(truth["shift_mm"]);
  const Vector3d e = 1e-6 * vector_of(truth["rotation_urad"]);
  const int row = truth["row_after"];
  const Vector3d expected = d + e.cross(tip(1.4));
  EXPECT_LT((point(simulation, 5) - tip(1.4) - expected).norm(), 1e-6);
  EXPECT_EQ((point(simulation, row - 1) - tip(simulation.measured.q(row - 1, 0))).norm(), 0.0);
}

TEST(Climate, FollowsItsDifferentialEquation) {
  const double session = 4 * 3600.0;
  const int n = 6;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const sim::Climate climate(n, session, 1.0, sim::Random(seed, "climate"));
    EXPECT_LT((climate.zones(0.0).array() - climate.air(0.0)).abs().maxCoeff(), 1e-12);
    Eigen::VectorXd T = climate.zones(0.0);
    const auto slope = [&](double t, const Eigen::VectorXd& now) {  // before the pause
      return Eigen::VectorXd(((climate.rises().array() + climate.air(t)) - now.array()) /
                             climate.lags().array());
    };
    const double h = 2.0;
    double t = 0.0;
    for (; t < 0.39 * session; t += h) {  // Runge and Kutta
      const auto a = slope(t, T), b = slope(t + h / 2, T + h / 2 * a);
      const auto c = slope(t + h / 2, T + h / 2 * b), d = slope(t + h, T + h * c);
      T += h / 6 * (a + 2 * b + 2 * c + d);
    }
    EXPECT_LT((climate.zones(t) - T).cwiseAbs().maxCoeff(), 1e-3) << "seed " << seed;
  }
}

TEST(Climate, SettlesAtItsRiseOverTheAir) {
  const double day = 30 * 24 * 3600.0;
  const sim::Climate climate(3, day, 1.0, sim::Random(4, "climate"));
  const double t = 0.3 * day;
  double low = 1e9, high = -1e9;
  for (double s = t - 5 * climate.period_s(); s <= t; s += 60.0) {
    low = std::min(low, climate.air(s)), high = std::max(high, climate.air(s));
  }
  for (int zone = 0; zone <= 3; ++zone) {
    const double over = climate.zones(t)(zone) - climate.rises()(zone);
    EXPECT_GT(over, low - 0.6);  // the table is coarse over a month
    EXPECT_LT(over, high + 0.6);
  }
}

TEST(ThermalGrowth, IsLengthTimesExpansionTimesTemperature) {
  SimulationPlan plan = noise_free(still(200, 0.7), "thermal_growth=300um");
  plan.seconds_per_pose = 60.0;
  const auto simulation = simulate(one_joint(), plan);
  const auto truth = first_effect(simulation);
  const sim::Climate climate(1, 200 * 60.0, 1.0, sim::Random(plan.seed, "climate"));
  const double alpha = truth["alpha_per_K"][0];
  for (int row = 0; row < 200; row += 7) {
    const auto T = climate.zones(row * 60.0);
    const Vector3d tilt(truth["tilt_urad_per_K"][0], truth["tilt_urad_per_K"][1], 0.0);
    const Vector3d turn = 1e-6 * (T(0) - climate.air(row * 60.0)) * tilt;
    const Vector3d expected = tip(0.7) * (1 + alpha * T(1)) + turn.cross(tip(0.7));
    EXPECT_LT((point(simulation, row) - expected).norm(), 1e-7) << row;  // second order
  }
  plan.climate = SimulationPlan::Climate::kConstant;
  EXPECT_EQ(point(simulate(one_joint(), plan), 150), tip(0.7));
}

TEST(ToolSag, IsLinearInGravityAsTheToolSeesIt) {
  Cell cell = one_joint();
  cell.payload.mass_kg = 5.0;
  const std::vector<double> q{0.0, 0.8, -1.9, 3.0};
  const auto simulation = simulate(cell, noise_free(q, "tool_sag=50um"));
  const auto truth = first_effect(simulation);
  const Vector3d a = vector_of(truth["stiff_axis_T"]);
  const double stiff = truth["stiff_axis_share"];
  for (int row = 0; row < 4; ++row) {
    const Vector3d g_T = Eigen::AngleAxisd(-q[row], Vector3d::UnitZ()) * -Vector3d::UnitY();
    const Vector3d sag_T = 50e-6 * (g_T - (1 - stiff) * a.dot(g_T) * a);
    const Vector3d expected = tip(q[row]) + Eigen::AngleAxisd(q[row], Vector3d::UnitZ()) * sag_T;
    EXPECT_LT((point(simulation, row) - expected).norm(), 1e-8) << row;
  }
}

TEST(BaseCompliance, TurnsTheArmAboutItsBaseByTheMoment) {
  Cell cell = one_joint();
  cell.payload.mass_kg = 10.0;
  const auto simulation = simulate(cell, noise_free({0.0, 1.0}, "base_compliance=100urad"));
  const auto error = joint_error(simulation);
  // The moment is about z, where the stiffness is 1 / 0.3 of the softest.
  EXPECT_NEAR(error[0], -100e-6 * 0.3, 1e-9);
  const double m = std::cos(1.0);
  EXPECT_NEAR(error[1], -100e-6 * 0.3 * m * (0.9 + 0.1 * m), 1e-9);
}

TEST(AxisWobble, IsAMotionOfTheAxisBeforeTheJointTurns) {
  const Cell cell = one_joint();
  const std::vector<double> q{0.0, 0.7, -2.1, 3.0};
  const auto simulation = simulate(cell, noise_free(q, "axis_wobble:J1=40urad"));
  const auto truth = first_effect(simulation)[0];
  for (int row = 0; row < 4; ++row) {
    double part[5];
    for (int k = 0; k < 5; ++k) {
      part[k] = 0.0;
      for (int h = 0; h < 2; ++h) {
        const double share = truth["shares"][h][k], phase = truth["phases_rad"][h][k];
        part[k] += 40e-6 * share * std::cos((h + 1) * q[row] + phase);
      }
    }
    format::Chain chain = cell.nominal;
    chain.joints[0].pre = {{0.2 * part[2], 0.2 * part[3], 0.06 * part[4]}, {part[0], part[1], 0.0}};
    const Eigen::VectorXd joints = Eigen::VectorXd::Constant(1, q[row]);
    const Vector3d expected = sim::Arm(chain).frames(joints).tool.translation();
    EXPECT_LT((point(simulation, row) - expected).norm(), 1e-15) << row;
    EXPECT_GT((point(simulation, row) - tip(q[row])).norm(), 1e-7);
  }
}

TEST(WristCoupling, DrivesTheFifthAndSixthJoint) {
  Demo demo = make_demo("clean");
  demo.plan.truth.effects = {"wrist_coupling=80urad"};
  const auto s = simulate(demo.cell, demo.plan);
  const auto truth = first_effect(s);
  const double k45 = truth["k45_urad_per_rad"], k46 = truth["k46_urad_per_rad"];
  const double k56 = truth["k56_urad_per_rad"];
  EXPECT_NEAR(k45, 80.0, 1e-9);
  for (int row = 0; row < 20; ++row) {
    Eigen::VectorXd q = s.measured.q.row(row).transpose();
    const double q4 = q(3), q5 = q(4);
    q(4) += 1e-6 * k45 * (q4 + 0.05 * std::sin(2 * q4));
    q(5) += 1e-6 * (k46 * q4 + k56 * (q5 + 0.05 * std::sin(2 * q5)));
    const Vector3d expected = sim::to_isometry(s.X_MB) *
                              (sim::Arm(s.true_chain).frames(q).tool * Vector3d(s.X_TG.p.data()));
    EXPECT_LT((point(s, row) - expected).norm(), 1e-12);
  }
}

TEST(Tracker, ErrsInRangeAzimuthAndElevation) {
  SimulationPlan plan = noise_free({0.0, 0.9, 2.0, -1.3, -2.8}, "tracker=50um");
  plan.truth.X_MB = format::Pose{{2.0, 3.0, 0.7}, {0.5, 0.5, 0.5, 0.5}};
  const auto with = simulate(one_joint(), plan);
  plan.truth.effects.clear();
  const auto without = simulate(one_joint(), plan);
  const auto truth = first_effect(with);
  for (int row = 0; row < 5; ++row) {
    const Vector3d a = point(without, row), b = point(with, row);
    const auto azimuth = [](const Vector3d& p) { return std::atan2(p.y(), p.x()); };
    const auto elevation = [](const Vector3d& p) { return std::asin(p.z() / p.norm()); };
    EXPECT_NEAR(1e6 * (b.norm() - a.norm()),
                double(truth["offset_um"]) + double(truth["scale_ppm"]) * a.norm(), 1e-3);
    const double da = double(truth["azimuth_urad"]) *
                      std::sin(2 * azimuth(a) + double(truth["azimuth_phase_rad"]));
    const double de = double(truth["elevation_urad"]) *
                      std::sin(2 * elevation(a) + double(truth["elevation_phase_rad"]));
    EXPECT_NEAR(1e6 * (azimuth(b) - azimuth(a)), da, 1e-3);
    EXPECT_NEAR(1e6 * (elevation(b) - elevation(a)), de, 1e-3);
  }
}

TEST(RoomSway, ComesBackAfterItsPeriodAndIsOppositeHalfWay) {
  for (const char* effect : {"room_sway=80um@period_s=1200", "tool_wander=80um@period_s=1200"}) {
    const auto s = simulate(one_joint(), noise_free(still(81, 0.4), effect));
    for (int row = 0; row < 40; ++row) {
      EXPECT_LT((point(s, row) - point(s, row + 40)).norm(), 1e-12) << effect;
      if (row >= 20) continue;
      const Vector3d sum = point(s, row) + point(s, row + 20) - 2 * tip(0.4);
      EXPECT_LT(sum.norm(), 1e-8) << effect;
    }
    double largest = 0.0;
    for (int row = 0; row < 40; ++row)
      largest = std::max(largest, (point(s, row) - tip(0.4)).norm());
    EXPECT_GT(largest, 60e-6) << effect;
    EXPECT_LT(largest, 130e-6) << effect;
  }
}

TEST(WarmEncoder, MovesItsZeroWithTheZoneOfItsDrive) {
  SimulationPlan plan = noise_free(still(100, 0.7), "warm_encoder:J1=100urad");
  plan.seconds_per_pose = 100.0;
  const auto error = joint_error(simulate(one_joint(), plan));
  const sim::Climate climate(1, 1e4, 1.0, sim::Random(plan.seed, "climate"));
  for (int row = 0; row < 100; row += 9) {
    EXPECT_NEAR(error[row], 10e-6 * climate.zones(row * 100.0)(1), 1e-12);
  }
}

}  // namespace
}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <iostream>
#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <nlohmann/json.hpp>
#include <numbers>

#include "simulate/arm.hpp"
#include "simulate/simulate.hpp"
#include "tests/cases/random_cell.hpp"

namespace plumb::offline {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

KDL::Frame frame(const format::Pose& pose) {
  return {KDL::Rotation::Quaternion(pose.q[1], pose.q[2], pose.q[3], pose.q[0]),
          KDL::Vector(pose.p[0], pose.p[1], pose.p[2])};
}

double true_value(const nlohmann::json& truth, const std::string& name) {
  for (const auto& parameter : truth["parameters"]) {
    if (parameter["name"] != name) continue;
    const double unit = parameter["unit"] == "mm" ? 1e-3 : kDegree;
    return double(parameter["value"]) * unit;
  }
  ADD_FAILURE() << name << " is not in the truth file";
  return 0.0;
}

void add_fixed(KDL::Chain& chain, const KDL::Frame& frame) {
  chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::None), frame));
}

// The true arm as Orocos KDL sees it, from the truth file and the cell's base and tool alone.
KDL::Chain kdl_chain(const Cell& cell, const nlohmann::json& truth) {
  KDL::Chain chain;
  add_fixed(chain, frame(cell.nominal.base));
  for (const auto& row : cell.nominal.joints) {
    const auto value = [&](const char* what) { return true_value(truth, row.name + what); };
    const KDL::Frame link(KDL::Frame::DH(value(".a"), value(".alpha"), 0.0, 0.0) *
                          KDL::Frame(KDL::Rotation::RotY(value(".beta"))));
    const bool modified = cell.nominal.convention == format::Convention::kModified;
    const bool slides = row.type == format::JointType::kPrismatic;
    if (modified) add_fixed(chain, link);
    chain.addSegment(
        KDL::Segment(KDL::Joint(slides ? KDL::Joint::TransZ : KDL::Joint::RotZ),
                     KDL::Frame(KDL::Rotation::RotZ(value(".theta")), {0, 0, value(".d")})));
    if (!modified) add_fixed(chain, link);
  }
  add_fixed(chain, frame(cell.nominal.tool));
  return chain;
}

// Largest distance between the simulated points and KDL's [m].
double largest_difference(const Cell& cell, const SimulationPlan& plan) {
  const auto simulation = simulate(cell, plan);
  const auto truth = nlohmann::json::parse(simulation.truth_json);
  const KDL::Chain chain = kdl_chain(cell, truth);
  KDL::ChainFkSolverPos_recursive solver(chain);
  KDL::JntArray q(cell.joints());
  double largest = 0.0;
  for (int row = 0; row < simulation.measured.size(); ++row) {
    q.data = simulation.measured.q.row(row).transpose();
    KDL::Frame X_BT;
    EXPECT_GE(solver.JntToCart(q, X_BT), 0);
    const auto& t = truth["target_mm"];
    const KDL::Vector p =
        frame(simulation.X_MB) * X_BT *
        KDL::Vector(1e-3 * double(t[0]), 1e-3 * double(t[1]), 1e-3 * double(t[2]));
    const auto m = simulation.measured.p_M.row(row);
    largest = std::max(largest, (p - KDL::Vector(m(0), m(1), m(2))).Norm());
  }
  return largest;
}

SimulationPlan geometry_only(std::uint64_t seed) {
  SimulationPlan plan;
  plan.poses = 50;
  plan.noise_m = 0.0;
  plan.seed = seed;
  plan.truth.geometry_m = 1e-3;
  plan.truth.geometry_rad = 2e-3;
  return plan;
}

TEST(SimulatedKinematics, AgreeWithOrocosKdlOnRandomArmsOfBothConventions) {
  const int arms = 100;
  const std::uint64_t seed = 4711;
  std::cout << arms << " arms a convention, 50 poses each, seed " << seed << "\n";
  using format::Convention;
  for (const auto convention : {Convention::kStandard, Convention::kModified}) {
    double largest = 0.0;
    for (int k = 0; k < arms; ++k) {
      const auto kind = k % 5 == 0 ? ArmKind::kScara : ArmKind::kRevolute;
      Cell cell = random_cell(seed + k, k % 5 == 0 ? 4 : 4 + k % 4, convention, kind);
      cell.nominal.base = {{0.1, -0.2, 0.3}, {0.5, 0.5, -0.5, 0.5}};
      cell.nominal.tool.q = {0.8, 0.0, 0.6, 0.0};
      largest = std::max(largest, largest_difference(cell, geometry_only(seed + k)));
    }
    std::cout << "largest difference " << largest << " m\n";
    EXPECT_LT(largest, 1e-12);
  }
}

TEST(SimulatedKinematics, EncoderScaleOffsetAndConstantTwistsActWhereTheChainSaysSo) {
  // Long hand: q' = 2 q + 0.1; a twist behind the joint shifts along the turned x axis.
  format::Chain chain;
  format::JointRow row;
  row.scale = 2.0;
  row.offset = 0.1;
  row.a = 1.0;
  row.post.d = {0.25, 0.0, 0.0};
  row.pre.d = {0.0, 0.0, 0.5};
  row.pre.e = {0.0, 0.0, 0.3};
  chain.joints = {row};
  const Eigen::Vector3d p =
      sim::Arm(chain).frames(Eigen::VectorXd::Constant(1, 0.2)).tool.translation();
  EXPECT_NEAR((p - Eigen::Vector3d(1.25 * std::cos(0.8), 1.25 * std::sin(0.8), 0.5)).norm(), 0.0,
              1e-15);
}

TEST(SimulatedKinematics, ExpOfATwistIsAScrewMotion) {
  // Quarter turn about z through (0, 1): the origin goes to (1, 1).
  const auto X = sim::exp({kDegree * 90, 0, 0.4}, {0, 0, kDegree * 90});
  EXPECT_NEAR((X.translation() - Eigen::Vector3d(1, 1, 0.4)).norm(), 0.0, 1e-15);
  const Eigen::Vector3d d(1, 2, 3), e(2e-5, -1e-5, 3e-5);
  EXPECT_NEAR((sim::exp(d, e).translation() - d - 0.5 * e.cross(d)).norm(), 0.0, 1e-8);
  EXPECT_EQ((sim::exp(d, Eigen::Vector3d::Zero()).translation() - d).norm(), 0.0);
}

}  // namespace
}  // namespace plumb::offline

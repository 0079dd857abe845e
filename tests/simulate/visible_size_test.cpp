// SPDX-License-Identifier: Apache-2.0
// Sizes of hidden effects against an independent projection, and over many random cases.
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

#include "simulate/arm.hpp"
#include "simulate/hidden_effect_reader.hpp"
#include "tests/cases/blind_case.hpp"
#include "tests/cases/random_cell.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::offline {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Derivatives of every measured point by the twists of the chain, by central differences through
// the simulator's own kinematics: base, behind every joint, tool.
MatrixXd geometry_columns(const BlindCase& made) {
  const auto& s = made.measured;
  const int n = made.cell.joints();
  const double h = 1e-5;
  MatrixXd J(3 * s.measured.size(), 6 * (n + 2));
  const auto nudged = [&](int column, double by) {
    format::Chain chain = s.true_chain;
    const int slot = column / 6, k = column % 6;
    format::Twist& twist = slot == 0       ? chain.base_twist
                           : slot == n + 1 ? chain.tool_twist
                                           : chain.joints[slot - 1].post;
    (k < 3 ? twist.d[k] : twist.e[k - 3]) += by;
    return sim::Arm(chain);
  };
  for (int column = 0; column < J.cols(); ++column) {
    const sim::Arm up = nudged(column, h), down = nudged(column, -h);
    for (int row = 0; row < s.measured.size(); ++row) {
      const VectorXd q = s.measured.q.row(row).transpose();
      const Vector3d p(s.X_TG.p.data());
      J.block<3, 1>(3 * row, column) = sim::to_isometry(s.X_MB).linear() *
                                       (up.frames(q).tool * p - down.frames(q).tool * p) / (2 * h);
    }
  }
  return J;
}

// Shift of every point by the hidden effects: what was measured less what the rigid arm would give.
VectorXd shift(const BlindCase& made) {
  const auto& s = made.measured;
  const sim::Arm arm(s.true_chain);
  VectorXd out(3 * s.measured.size());
  for (int row = 0; row < s.measured.size(); ++row) {
    const VectorXd q = s.measured.q.row(row).transpose();
    out.segment<3>(3 * row) =
        s.true_p_M.row(row).transpose() -
        sim::to_isometry(s.X_MB) * (arm.frames(q).tool * Vector3d(s.X_TG.p.data()));
  }
  return out;
}

// Per-axis RMS of what least squares in the geometry leaves.
double left_over(const MatrixXd& J, const VectorXd& y) {
  Eigen::ColPivHouseholderQR<MatrixXd> qr(J);
  qr.setThreshold(1e-7);
  EXPECT_EQ(qr.rank(), 27) << "six joints seen through one point";
  const VectorXd turned = qr.householderQ().adjoint() * y;
  return turned.tail(y.size() - qr.rank()).norm() / std::sqrt(static_cast<double>(y.size()));
}

std::vector<std::string> unsized_names() { return {"planar_published", "planar_printed"}; }

std::vector<std::string> arm_effects() {
  std::vector<std::string> out;
  const auto no = unsized_names();
  for (const auto& [name, line] : simulated_effects()) {
    if (std::find(no.begin(), no.end(), name) == no.end()) out.push_back(name);
  }
  return out;
}

TEST(BlindCase, EveryEffectHasTheRequestedVisibleSizeOnBothArms) {
  for (const auto arm : {BlindArm::kHeavy, BlindArm::kLight}) {
    MatrixXd J;
    for (const auto& name : arm_effects()) {
      BlindRequest request;
      request.arm = arm;
      request.poses = 80;
      request.fresh_poses = 5;
      request.seed = 11;
      request.effects = {name + "::3"};
      const auto made = make_blind_case(request);
      if (J.size() == 0) J = geometry_columns(made);  // same poses for all of them
      const double left = left_over(J, shift(made));
      EXPECT_NEAR(left / request.sigma_m, 3.0, 0.03) << name;
      const auto size = nlohmann::json::parse(made.truth_json)["effects"][0]["size"];
      EXPECT_NEAR(size["visible_sigma"], 3.0, 0.01) << name;
    }
  }
}

TEST(BlindCase, SeveralEffectsHaveEachItsOwnSize) {
  BlindRequest request;
  request.effects = {"joint_compliance:J2:5", "gear_harmonics:J1:2", "drift::1"};
  request.fresh_poses = 5;
  const auto made = make_blind_case(request);
  const auto truth = nlohmann::json::parse(made.truth_json)["effects"];
  const double wanted[] = {5.0, 2.0, 1.0};
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(truth[k]["size"]["visible_sigma"], wanted[k], 0.01);
}

TEST(BlindCase, RandomCasesAreFiniteAndAlwaysOfTheRequestedSize) {
  const long count = tests::scaled(1000);
  const std::uint64_t seed = 20260801;
  std::cout << count << " random cases, seed " << seed << "\n";
  tests::Random random(seed);
  const auto names = arm_effects();
  long refused = 0;
  for (long k = 0; k < count; ++k) {
    BlindRequest request;
    request.arm = random.below(2) == 0 ? BlindArm::kHeavy : BlindArm::kLight;
    request.seed = random.bits();
    request.poses = 30 + random.below(30);
    request.fresh_poses = 10;
    request.sigma_m = random.uniform(10e-6, 30e-6);
    request.outlier_share = random.below(4) == 0 ? 0.02 : 0.0;
    request.choice.grid_levels = random.below(4) == 0 ? 5 + random.below(4) : 0;
    request.choice.range = random.uniform(0.5, 1.0);
    if (random.below(3) == 0) request.choice.order = PoseChoice::Order::kNearest;
    if (random.below(4) == 0) request.payloads = BlindRequest::Payloads::kConstant;
    const double size = random.uniform(0.5, 10.0);
    const std::string& name = names[static_cast<std::size_t>(k) % names.size()];
    request.effects = {name + "::" + std::to_string(size)};
    try {
      const auto made = make_blind_case(request);
      EXPECT_TRUE(made.measured.measured.p_M.allFinite()) << name;
      EXPECT_TRUE(made.fresh.true_p_M.allFinite()) << name;
      EXPECT_EQ(made.truth_json.find("null"), std::string::npos) << name;  // JSON's NaN
      EXPECT_NEAR(made.measured.sizes.at(0).visible_m / request.sigma_m / size, 1.0, 0.01) << name;
    } catch (const Failure& failure) {
      ++refused;
      ADD_FAILURE() << name << ": " << failure.what();
    }
  }
  EXPECT_EQ(refused, 0);
}

TEST(Laws, StayFiniteOnRandomArmsOrSayWhyTheyCannotBe) {
  const long count = tests::scaled(1000);
  const std::uint64_t seed = 77;
  std::cout << count << " random arms, seed " << seed << "\n";
  tests::Random random(seed);
  const auto names = arm_effects();
  long made = 0;
  for (long k = 0; k < count; ++k) {
    const bool scara = random.below(4) == 0;
    const Cell cell = random_cell(
        random.bits() % 100000, scara ? 4 : 4 + random.below(4),
        random.below(2) == 0 ? format::Convention::kStandard : format::Convention::kModified,
        scara ? ArmKind::kScara : ArmKind::kRevolute);
    SimulationPlan plan;
    plan.poses = 25;
    plan.seed = random.bits();
    plan.truth.mass_share = 0.3;
    const std::string& name = names[static_cast<std::size_t>(k) % names.size()];
    plan.truth.effects = {name};
    if (random.below(2) == 0) plan.payloads = {{0.0, {}}, {8.0, {0.1, 0.0, 0.05}}};
    try {
      const auto s = simulate(cell, plan);
      ++made;
      EXPECT_TRUE(s.measured.p_M.allFinite()) << name;
      const double rms_mm = s.sizes.at(0).rms_m * 1e3;
      EXPECT_LT(rms_mm, 2.0) << name << " at its usual size";
      for (const auto& column : s.context) {
        for (const double value : column.values) ASSERT_TRUE(std::isfinite(value)) << column.header;
      }
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.exit_code(), Exit::kUsage) << name;
      EXPECT_EQ(failure.problems().at(0).code, "E-SIM-JOINT") << name;
    }
  }
  EXPECT_GT(made, count * 7 / 10);
}

}  // namespace
}  // namespace plumb::offline

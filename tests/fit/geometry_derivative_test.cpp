// SPDX-License-Identifier: Apache-2.0
#include "arm/geometry_derivative.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "cell/random.hpp"

namespace plumb::offline {
namespace {

double spread(Random& random, double size) { return size * (2.0 * random.unit() - 1.0); }

/// A random arm with every kind of number in play.
Cell random_arm(std::uint64_t seed) {
  Random random(seed);
  Cell cell;
  auto& chain = cell.nominal;
  chain.convention =
      random.below(2) == 0 ? format::Convention::kStandard : format::Convention::kModified;
  const int n = 2 + random.below(6);
  for (int i = 0; i < n; ++i) {
    format::JointRow row;
    row.name = "J" + std::to_string(i + 1);
    row.type = random.below(5) == 0 ? format::JointType::kPrismatic : format::JointType::kRevolute;
    row.alpha = random.below(3) == 0 ? spread(random, 0.01) : spread(random, 3.0);
    row.a = spread(random, 0.5);
    row.d = spread(random, 0.5);
    row.theta = spread(random, 3.0);
    row.beta = spread(random, 0.01);
    chain.joints.push_back(row);
  }
  chain.base = to_pose(rot_x(spread(random, 3.0)) * translation(0.1, -0.2, 0.3));
  chain.tool = to_pose(rot_y(spread(random, 3.0)) * translation(0.05, 0.02, 0.15));
  cell.mechanics.resize(n);
  EffectEntry geometry;
  geometry.name = "geometry";
  cell.effects.push_back(geometry);
  return cell;
}

ArmState random_state(const Cell& cell, Random& random) {
  ArmState state;
  state.arm.calibrated = cell.nominal;
  state.X_MB = to_pose(rot_z(spread(random, 3.0)) * rot_x(spread(random, 3.0)) *
                       translation(spread(random, 3.0), 1.0, -0.5));
  state.X_TG = to_pose(rot_y(spread(random, 3.0)) * translation(0.03, -0.04, 0.12));
  return state;
}

/// Largest difference between the exact columns and central differences of `moved`.
double worst_column_error(const Cell& cell, std::uint64_t seed) {
  Random random(seed);
  const auto parameters = candidate_parameters(cell, Orientation::kUsed);
  const auto count = static_cast<Eigen::Index>(parameters.size());
  const ArmState start = random_state(cell, random);
  Eigen::VectorXd change(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    // Frame and target turn by much, the arm by little.
    const bool turn = !parameters[i].of_robot() && !parameters[i].is_length();
    change(i) = spread(random, turn ? 0.5 : 0.002);
  }
  std::vector<double> q;
  for (int i = 0; i < cell.joints(); ++i) q.push_back(spread(random, 2.0));
  const auto at = [&](const Eigen::VectorXd& x) {
    GeometryDerivative::Point point;
    GeometryDerivative(start, parameters, x).evaluate(q, {}, point);
    return point;
  };
  const auto here = at(change);
  double worst = 0.0;
  constexpr double kStep = 1e-6;
  for (Eigen::Index i = 0; i < count; ++i) {
    Eigen::VectorXd up = change, down = change;
    up(i) += kStep;
    down(i) -= kStep;
    const auto a = at(up), b = at(down);
    const Vector3 shift = (a.p_M - b.p_M) / (2 * kStep);
    const Vector3 turn = rotation_vector(a.R_MG * b.R_MG.transpose()) / (2 * kStep);
    worst = std::max(worst, (here.columns.col(i).head<3>() - shift).cwiseAbs().maxCoeff());
    worst = std::max(worst, (here.columns.col(i).tail<3>() - turn).cwiseAbs().maxCoeff());
  }
  return worst;
}

TEST(GeometryDerivative, EqualsCentralDifferencesForEveryParameterOf300RandomArms) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const Cell cell = random_arm(seed);
    EXPECT_LT(worst_column_error(cell, seed), 3e-8) << "seed " << seed;
  }
}

TEST(GeometryDerivative, EqualsCentralDifferencesForCompleteLinkTwistsAtZero) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Cell cell = random_arm(seed);
    cell.fit.model = FitSettings::Model::kComplete;
    // To first order in the twist itself, so the change of 2 mm and 2 mrad shows.
    EXPECT_LT(worst_column_error(cell, seed), 5e-3) << "seed " << seed;
  }
}

format::Effect wave(std::vector<std::uint8_t> joints, double cycles, std::vector<double> sizes) {
  format::Effect out;
  out.name = "gear_ripple";
  out.version = 1;
  out.joints = std::move(joints);
  out.constants = {cycles};
  out.parameters = std::move(sizes);
  return out;
}

/// Largest difference from central differences, of columns in this order.
double worst_of(const ArmState& start, const std::vector<Parameter>& parameters,
                const std::vector<double>& q) {
  const auto count = static_cast<Eigen::Index>(parameters.size());
  const auto at = [&](Eigen::Index i, double step) {
    GeometryDerivative::Point point;
    GeometryDerivative(start, parameters, step * Eigen::VectorXd::Unit(count, i))
        .evaluate(q, {}, point);
    return point;
  };
  const auto here = at(0, 0.0);
  constexpr double kStep = 1e-6;
  double worst = 0.0;
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto a = at(i, kStep), b = at(i, -kStep);
    const Vector3 shift = (a.p_M - b.p_M) / (2 * kStep);
    const Vector3 turn = rotation_vector(a.R_MG * b.R_MG.transpose()) / (2 * kStep);
    worst = std::max(worst, (here.columns.col(i).head<3>() - shift).cwiseAbs().maxCoeff());
    worst = std::max(worst, (here.columns.col(i).tail<3>() - turn).cwiseAbs().maxCoeff());
  }
  return worst;
}

TEST(GeometryDerivative, EveryWaveHasItsColumnsWhicheverAreFittedAndInAnyOrder) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Cell cell = random_arm(seed);
    Random random(seed);
    ArmState start = random_state(cell, random);
    const auto last = static_cast<std::uint8_t>(cell.joints() - 1);
    start.arm.effects = {wave({0}, 7.0, {1e-4, -2e-4}), wave({0, last}, 3.5, {2e-4, 0, 1e-4, 3e-4}),
                         wave({last}, 20.3, {0.0, 1e-4}), wave({0}, 11.0, {3e-4, 1e-4})};
    std::vector<Parameter> parameters = effect_parameters(start.arm);
    for (std::size_t i = parameters.size(); i > 1; --i)
      std::swap(parameters[i - 1],
                parameters[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
    parameters.resize(parameters.size() - 3);  // some are not fitted
    std::vector<double> q;
    for (int i = 0; i < cell.joints(); ++i) q.push_back(spread(random, 2.0));
    EXPECT_LT(worst_of(start, parameters, q), 3e-8) << "seed " << seed;
  }
}

TEST(CandidateParameters, BetaTakesThePlaceOfDWhereNeighboursAreParallel) {
  Cell cell = random_arm(3);
  cell.nominal.convention = format::Convention::kStandard;
  for (auto& row : cell.nominal.joints) {
    row.alpha = 1.5;
    row.type = format::JointType::kRevolute;
  }
  cell.nominal.joints[1].alpha = 0.0;
  cell.nominal.joints.resize(3);
  cell.mechanics.resize(3);
  std::vector<std::string> names;
  for (const auto& p : candidate_parameters(cell, Orientation::kIgnored)) names.push_back(p.name);
  EXPECT_EQ(std::count(names.begin(), names.end(), "J2.beta"), 1);
  EXPECT_EQ(std::count(names.begin(), names.end(), "J2.d"), 0);
  EXPECT_EQ(std::count(names.begin(), names.end(), "J1.d"), 1);
}

TEST(RobotParameter, IsFoundByTheNameThatTheCandidatesCarry) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Cell cell = random_arm(seed);
    for (const auto& p : candidate_parameters(cell, Orientation::kIgnored)) {
      if (!p.of_robot()) continue;
      const auto found = robot_parameter(cell.nominal, p.name);
      ASSERT_TRUE(found.has_value()) << p.name;
      EXPECT_EQ(found->kind, p.kind);
      EXPECT_EQ(found->joint, p.joint);
    }
  }
  EXPECT_FALSE(robot_parameter(random_arm(1).nominal, "J9.d").has_value());
}

}  // namespace
}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#include "simulate/planar.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "simulate/simulate.hpp"

namespace plumb::offline {
namespace {

struct Golden {
  double phi12, phi23, dx_mm, dy_mm;
};

void expect_golden(PlanarVariant variant, const std::vector<Golden>& points) {
  for (const auto& point : points) {
    const Eigen::Vector2d mm = 1e3 * planar_deflection(variant, point.phi12, point.phi23);
    EXPECT_NEAR(mm.x(), point.dx_mm, 5.1e-7) << point.phi12 << " " << point.phi23;
    EXPECT_NEAR(mm.y(), point.dy_mm, 5.1e-7) << point.phi12 << " " << point.phi23;
  }
}

TEST(PlanarStudy, PublishedVariantMeetsItsGoldenPointsToEveryDigit) {
  expect_golden(PlanarVariant::kPublished, {{0.0, 0.0, 0.0, -1.427238},
                                            {0.5, 1.0, 0.675436, -0.294339},
                                            {-1.2, 2.0, -0.084973, 0.271213}});
}

TEST(PlanarStudy, PrintedVariantMeetsItsGoldenPointsToEveryDigit) {
  expect_golden(PlanarVariant::kPrinted, {{0.0, 0.0, 0.0, -5.217758},
                                          {0.5, 1.0, 1.857035, -0.912131},
                                          {-1.2, 2.0, 0.538351, -1.662455}});
}

TEST(PlanarStudy, GridsHaveTheNumbersOfPosesInPrint) {
  EXPECT_EQ(planar_grid(0.1).rows(), 1536);
  EXPECT_EQ(planar_grid(0.05).rows(), 5985);
  EXPECT_EQ(planar_grid(0.01).rows(), 148680);
}

// Error of the rigid model, equations (10) and (11), on the 5985 test poses: mean and max [mm].
std::pair<double, double> rigid_error_mm(const std::string& demo_name) {
  Demo demo = make_demo(demo_name);
  demo.plan.q = planar_grid(0.05);
  demo.plan.noise_m = 0.0;
  const auto simulation = simulate(demo.cell, demo.plan);
  double sum = 0.0, max = 0.0;
  for (int row = 0; row < simulation.measured.size(); ++row) {
    const double p2 = simulation.measured.q(row, 0), p3 = p2 + simulation.measured.q(row, 1);
    const double dx = simulation.measured.p_M(row, 0) - (std::cos(p2) + std::cos(p3));
    const double dy = simulation.measured.p_M(row, 1) - (2.0 + std::sin(p2) + std::sin(p3));
    sum += 1e3 * std::hypot(dx, dy);
    max = std::max(max, 1e3 * std::hypot(dx, dy));
  }
  return {sum / simulation.measured.size(), max};
}

TEST(PlanarStudy, RigidModelErrsAsPublished) {
  const auto [mean, max] = rigid_error_mm("planar-published");
  EXPECT_NEAR(mean, 0.6433, 5e-5);
  EXPECT_NEAR(max, 1.4272, 5e-5);
}

TEST(PlanarStudy, RigidModelErrsAsTheDimensionsInPrintWouldMakeIt) {
  const auto [mean, max] = rigid_error_mm("planar-printed");
  EXPECT_NEAR(mean, 2.243, 5e-4);
  EXPECT_NEAR(max, 5.216, 5e-4);
}

TEST(PlanarStudy, OnlyXAndYAreMeasured) {
  const Demo demo = make_demo("beam");
  const auto measured = simulate(demo.cell, demo.plan).measured;
  EXPECT_EQ(measured.has_axis, (std::array<bool, 3>{true, true, false}));
  EXPECT_EQ(measured.p_M.col(2).norm(), 0.0);
}

TEST(PlanarStudy, BeamsOfTheStudyAreRefusedOnAnotherArm) {
  const Demo demo = make_demo("gear");
  SimulationPlan plan = demo.plan;
  plan.truth.effects = {"planar_printed"};
  EXPECT_THROW(simulate(demo.cell, plan), Failure);
}

}  // namespace
}  // namespace plumb::offline

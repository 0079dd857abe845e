// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/forward_model.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <limits>

#include "tests/runtime/true_arm.hpp"

namespace plumb {
namespace {

constexpr std::uint64_t kSeed = 20240607;

format::Model with_trees(test::RandomArm& random, const format::Chain& nominal) {
  for (;;) {
    auto model = test::random_model(random, nominal);
    if (!model.trees[0].bounds.empty()) return model;
  }
}

TEST(ForwardModel, IsTheKdlChainPlusThePlainTreeInsideTheDomain) {
  constexpr int kCount = 20'000;
  std::printf("count %d seed %llu\n", kCount, static_cast<unsigned long long>(kSeed));
  test::RandomArm random(kSeed);
  const auto kinds = test::arm_kinds();
  double worst = 0.0;
  for (int k = 0; k < kCount; ++k) {
    const auto& nominal = kinds[static_cast<std::size_t>(k) % kinds.size()].nominal;
    const auto model = test::random_model(random, nominal);
    const auto q = random.positions(nominal);
    const auto out = ForwardModel(model).predict(q);
    const Transformd X_BT = test::TrueArm(model).pose(q);
    EXPECT_EQ(out.status, Status::kOk);
    worst = std::max({worst, (out.X_BT.p - X_BT.p).norm(), (out.X_BT.R - X_BT.R).norm()});
  }
  std::printf("worst difference %.2e\n", worst);
  EXPECT_LT(worst, 1e-13);
}

TEST(ForwardModel, FadesTheTreeOutAndSaysSoOutsideTheTrainedDomain) {
  test::RandomArm random(kSeed);
  const auto model = with_trees(random, test::ur10());
  const ForwardModel arm(model);
  std::vector<double> q(6, 0.1);
  const double span = model.domain.q_max[1] - model.domain.q_min[1];
  const auto at = [&](double share) {
    q[1] = model.domain.q_max[1] + share * model.domain.fade * span;
    return arm.predict(q);
  };
  const auto border = at(0.0), half = at(0.5), outside = at(1.001);
  EXPECT_EQ(border.status, Status::kOk);
  EXPECT_EQ(half.status, Status::kOutsideDomain);
  EXPECT_LT((half.tree_B - 0.5 * border.tree_B).norm(), 1e-12);
  EXPECT_EQ(outside.status, Status::kOutsideDomain);
  EXPECT_TRUE(outside.tree_B.isZero(0.0));
}

TEST(ForwardModel, ReportsTheTreesPartOfThePosition) {
  test::RandomArm random(kSeed);
  const auto model = with_trees(random, test::tx200());
  const ForwardModel arm(model);
  for (int k = 0; k < 1'000; ++k) {
    const auto q = random.positions(model.nominal);
    const auto out = arm.predict(q);
    EXPECT_EQ(out.tree_B, arm.tree_error(q));
    EXPECT_EQ(out.X_BT.p, Vector3(arm.chain().forward(q).p + out.tree_B));
  }
}

TEST(ForwardModel, ShowsAnEffectNoTemperatureOfAnother) {
  test::RandomArm random(kSeed);
  auto model = with_trees(random, test::ur10());
  const format::Effect growth{.name = "thermal_growth",
                              .joints = {1, 2},
                              .parameters = {1e-5, 1e-5, 0.0, 0.0},
                              .context = {{format::ContextInput::kTemperature, "arm", 20.0}},
                              .constants = {20.0}};
  model.effects = {growth};
  const std::vector<double> q(6, 0.3);
  Context warm;
  warm.temperature_degC[0] = 40.0;
  const Vector3 one = ForwardModel(model).predict(q, warm).X_BT.p;
  model.effects.push_back(growth);
  model.effects.back().context.clear();  // it has no sensor, so it stays as it was
  EXPECT_EQ(ForwardModel(model).predict(q, warm).X_BT.p, one);
}

TEST(ForwardModel, RefusesWhatIsNoJointStateAndStaysFinite) {
  test::RandomArm random(kSeed);
  const auto model = with_trees(random, test::ur10());
  const ForwardModel arm(model);
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1.0001e4, -1e308}) {
    std::vector<double> q(6, 0.1);
    q[4] = bad;
    const auto out = arm.predict(q);
    EXPECT_EQ(out.status, Status::kNotFinite);
    EXPECT_EQ(out.X_BT.R, Matrix3::Identity());
    EXPECT_TRUE(out.X_BT.p.isZero(0.0));
    EXPECT_TRUE(arm.tree_error(q).isZero(0.0));
  }
  EXPECT_EQ(arm.predict(std::vector<double>(5, 0.1)).status, Status::kNotFinite);
  EXPECT_EQ(arm.predict(std::vector<double>(6, 9.9e3)).status, Status::kOutsideDomain);
}

}  // namespace
}  // namespace plumb

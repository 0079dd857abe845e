// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/coupling.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "plumb/runtime/binding.hpp"
#include "plumb/runtime/cycle.hpp"
#include "tests/rt/one_arm.hpp"
#include "tests/runtime/random_arm.hpp"

namespace plumb {
namespace {

using Joints = std::array<double, kMaxJoints>;

/// J3 = q3 + q2, J5 = q5 + q4, J6 = q6 + q5: in an order that has to be sorted.
const std::vector<format::JointCoupling> kThree{
    {5, 4, -1.0}, {5, 3, 1.0}, {4, 3, -1.0}, {2, 1, -1.0}};

TEST(Coupling, GivesTheAnglesBehindTheValuesOfTheController) {
  Joints q{0.1, 0.2, 0.5, 0.4, 0.9, 1.1};
  Coupling(kThree).to_angles(q);
  const Joints expected{0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
  for (std::size_t i = 0; i < q.size(); ++i) EXPECT_NEAR(q[i], expected[i], 1e-15) << i;
}

TEST(Coupling, TakesValuesToAnglesAndBack) {
  const Joints values{0.3, -1.2, 2.0, 0.7, -0.4, 3.1, 0.0, 0.5, -0.5};
  Joints q = values;
  const Coupling coupling(kThree);
  coupling.to_angles(q);
  coupling.to_values(q);
  for (std::size_t i = 0; i < q.size(); ++i) EXPECT_NEAR(q[i], values[i], 1e-15) << i;
}

TEST(Coupling, OfNoJointsChangesNothing) {
  Joints q{1.0, 2.0, 3.0};
  const Joints before = q;
  Coupling().to_angles(q);
  EXPECT_EQ(q, before);
  EXPECT_TRUE(Coupling().empty());
}

TEST(Coupling, OfTwoJointsThatDependOnEachOtherIsRefused) {
  std::vector<format::JointCoupling> circle{{2, 1, 1.0}, {1, 2, 1.0}};
  EXPECT_FALSE(format::put_in_order(circle));
  auto line = kThree;
  EXPECT_TRUE(format::put_in_order(line));
}

/// An arm that is fitted away from its nominal one, with or without coupling.
std::unique_ptr<const LoadedModel> loaded(const std::vector<format::JointCoupling>& coupling) {
  format::Model model = tests::one_arm();
  model.guard.ramp_s = 0.0;
  model.calibrated.joints[1].a += 3e-4;
  model.calibrated.joints[2].alpha += 2e-4;
  model.nominal.coupling = model.calibrated.coupling = coupling;
  return LoadedModel::make(std::move(model));
}

/// What the cycle says of the pose of these angles, told in values of the controller.
CycleOutput answer(const LoadedModel& model, const Joints& angles) {
  CycleInput input;
  input.target = input.joints = Arrival::kArrived;
  input.X_BD = model.corrector().nominal().forward(std::span(angles).first(6));
  input.q_measured = angles;
  model.coupling().to_values(input.q_measured);
  ModelSlot slot(model);
  Cycle cycle(slot);
  return cycle.step(input);
}

TEST(Coupling, IsTakenOutOfTheCycleAndPutBackIntoItsAnswer) {
  const Joints angles{0.1, -1.2, 1.4, 0.3, 1.1, -0.3};
  const auto coupled = loaded(kThree), plain = loaded({});
  const CycleOutput a = answer(*coupled, angles), b = answer(*plain, angles);
  EXPECT_EQ(a.correction.status, Status::kOk);
  EXPECT_LT((a.correction.X_BC.p - b.correction.X_BC.p).norm(), 1e-9);
  EXPECT_GT((a.correction.X_BC.p - coupled->corrector().nominal().forward(angles).p).norm(), 1e-5);
  Joints values = b.correction.q;
  coupled->coupling().to_values(values);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(a.correction.q[i], values[i], 1e-9) << i;
}

TEST(Coupling, OfAnotherKindMeansAnotherController) {
  EXPECT_EQ(find_binding_fault(loaded(kThree)->model(), loaded({})->model()),
            BindingFault::kNominal);
}

}  // namespace
}  // namespace plumb

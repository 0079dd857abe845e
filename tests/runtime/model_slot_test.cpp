// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/model_slot.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "plumb/runtime/detail/effect_library.hpp"
#include "tests/rt/warm_arm.hpp"
#include "tests/runtime/slot_hammer.hpp"

namespace plumb {
namespace {

// model_slot_test [<swaps>]
#ifdef __SANITIZE_ADDRESS__
int swaps = 10'000;  // every model is made and freed with the sanitizer looking on
#else
int swaps = 100'000;
#endif

using Published = ModelSlot::Published;

std::unique_ptr<const LoadedModel> changed(void (*change)(format::Model&)) {
  format::Model model = tests::one_arm();
  change(model);
  return LoadedModel::make(std::move(model));
}

const auto kSame = [](format::Model&) {};

TEST(ModelSlot, NeverShowsATornOrFreedModelAtFullSpeed) {
  const test::Hammered out = test::hammer<ModelSlot>(swaps);
  std::printf("%d swaps, %ld cycles, %ld models seen\n", swaps, out.cycles, out.seen);
  EXPECT_EQ(out.wrong, 0);
  EXPECT_GE(out.seen, swaps - 1);  // acknowledged one by one; the last may come after the end
}

TEST(ModelSlot, KeepsTheOldModelUntilTheCycleHasTakenTheNew) {
  const auto first = changed(kSame), second = changed(kSame), third = changed(kSame);
  ModelSlot slot(*first);
  EXPECT_TRUE(slot.settled());
  EXPECT_EQ(&slot.take(), first.get());
  EXPECT_EQ(slot.publish(*second), Published::kDone);
  EXPECT_FALSE(slot.settled());
  EXPECT_EQ(slot.publish(*third), Published::kBusy);
  EXPECT_EQ(&slot.take(), second.get());
  EXPECT_TRUE(slot.settled());
  EXPECT_EQ(slot.publish(*third), Published::kDone);
  EXPECT_EQ(&slot.take(), third.get());
}

TEST(ModelSlot, KeepsAnotherRobotsModelFromTheCycle) {
  const auto first = changed(kSame);
  ModelSlot slot(*first);
  for (const auto& other :
       {changed([](format::Model& m) { m.serial = "another"; }),
        changed([](format::Model& m) { m.nominal.joints[2].a += 1e-9; }),
        changed([](format::Model& m) { m.nominal.joints[4].offset = 0.1; }),
        changed([](format::Model& m) { m.nominal.tool.p[2] = 0.1; }),
        changed([](format::Model& m) { m.nominal.base.p[0] = 0.1; }), changed([](format::Model& m) {
          m.nominal.joints.pop_back();
          m.calibrated.joints.pop_back();
          m.trees = {};
          m.domain = {};
        })}) {
    ASSERT_NE(other, nullptr);
    EXPECT_EQ(slot.publish(*other), Published::kOtherRobot);
    EXPECT_EQ(&slot.take(), first.get());
  }
}

TEST(ModelSlot, TakesAnotherCalibrationWithOtherNamesAndJointLimits) {
  const auto first = changed(kSame);
  const auto better = changed([](format::Model& m) {
    m.calibrated.joints[1].a += 1e-4;
    m.nominal.joints[1].name = "shoulder";
    m.nominal.joints[1].q_max = 1.0;
    m.guard.max_correction_m = 0.001;
  });
  ModelSlot slot(*first);
  EXPECT_EQ(slot.publish(*better), Published::kDone);
}

TEST(Binding, TakesMoreOrFewerSensorsButNotInAnotherOrder) {
  const format::Model both = tests::warm_arm({"temp_arm", "temp_base"});
  EXPECT_EQ(find_binding_fault(both, tests::warm_arm({})), BindingFault::kNone);
  EXPECT_EQ(find_binding_fault(both, tests::warm_arm({"temp_arm"})), BindingFault::kNone);
  EXPECT_EQ(find_binding_fault(tests::warm_arm({"temp_arm"}), both), BindingFault::kNone);
  EXPECT_EQ(find_binding_fault(both, tests::warm_arm({"temp_base", "temp_arm"})),
            BindingFault::kSensors);
}

TEST(LoadedModel, IsNoneWhenAnEffectIsNotKnown) {
  EXPECT_EQ(changed([](format::Model& m) { m.effects.emplace_back().name = "of next year"; }),
            nullptr);
  EXPECT_NE(changed(kSame), nullptr);
  static_assert(!std::is_copy_constructible_v<LoadedModel>);
  static_assert(!std::is_constructible_v<LoadedModel, format::Model>);
}

}  // namespace
}  // namespace plumb

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (argc > 1) plumb::swaps = std::atoi(argv[1]);
  return RUN_ALL_TESTS();
}

// SPDX-License-Identifier: Apache-2.0
// The limits of the cycle through the C interface, sound and unsound.
#include <limits>
#include <type_traits>

#include "plumb/runtime/cycle.hpp"
#include "tests/c/support.hpp"

namespace plumb::tests {
namespace {

plumb_settings defaults() {
  plumb_settings out;
  EXPECT_EQ(plumb_settings_init(&out), PLUMB_OK);
  return out;
}

/// How long after its last target a robot still says it is fresh [s].
double fresh_for_s(plumb_robot* robot) {
  plumb_input in = sound_input();
  plumb_output out = blank_output();
  EXPECT_EQ(plumb_correct(robot, &in, &out), PLUMB_OK);
  const std::int64_t last_ns = in.now_ns;
  while (out.status != PLUMB_STATUS_STALE && in.now_ns - last_ns < 2'000'000'000) {
    in.arrived = PLUMB_MEASURED;
    in.now_ns += 1'000'000;
    EXPECT_EQ(plumb_correct(robot, &in, &out), PLUMB_OK);
  }
  return 1e-9 * static_cast<double>(in.now_ns - last_ns);
}

TEST(Settings, AreThoseOfTheLibraryUntilChanged) {
  const plumb_settings s = defaults();
  const CycleSettings own;
  EXPECT_EQ(s.size, sizeof s);
  EXPECT_EQ(s.target_limit_s, own.target_limit_s);
  EXPECT_EQ(s.joints_limit_s, own.joints_limit_s);
  EXPECT_EQ(s.payload_limit_s, own.context.payload_s);
  EXPECT_EQ(s.temperature_limit_s, own.context.temperature_s);
  EXPECT_EQ(s.time_limit_s, own.context.time_s);
  EXPECT_EQ(s.dead_band_rad, own.dead_band);
}

TEST(Settings, OfHowLongATargetCountsAreObeyed) {
  const Robot usual, patient;
  plumb_settings s = defaults();
  s.target_limit_s = 0.5;
  ASSERT_EQ(plumb_configure(patient.get(), &s), PLUMB_OK);
  EXPECT_NEAR(fresh_for_s(usual.get()), 0.1, 0.0021);
  EXPECT_NEAR(fresh_for_s(patient.get()), 0.5, 0.0021);
}

TEST(Settings, OfHowLongAReadingCountsAreObeyed) {
  const Robot robot;
  plumb_settings s = defaults();
  s.temperature_limit_s = 0.05;
  ASSERT_EQ(plumb_configure(robot.get(), &s), PLUMB_OK);
  plumb_input in = sound_input();
  plumb_joints at{sizeof(plumb_joints), 0, {}};
  std::copy_n(home(), PLUMB_MAX_JOINTS, at.q);
  const auto arm = [&](double age_s) {
    in.temperature_degC[0].age_s = age_s;
    in.now_ns += kTick_ns;
    plumb_output out = blank_output();
    EXPECT_EQ(plumb_correct(robot.get(), &in, &out), PLUMB_OK);
    plumb_prediction prediction{};
    prediction.size = sizeof prediction;
    EXPECT_EQ(plumb_predict(robot.get(), &at, &prediction), PLUMB_OK);
    return prediction.X_BT.p_m[0];
  };
  const double known = arm(0.04);
  EXPECT_NE(arm(0.06), known) << "the fallback is 11 degrees colder";
  EXPECT_EQ(arm(0.04), known);
}

TEST(Settings, ThatAreNoLimitsChangeNothing) {
  const Robot robot;
  double plumb_settings::*const kNumbers[] = {
      &plumb_settings::target_limit_s,  &plumb_settings::joints_limit_s,
      &plumb_settings::payload_limit_s, &plumb_settings::temperature_limit_s,
      &plumb_settings::time_limit_s,    &plumb_settings::dead_band_rad};
  static_assert(std::size(kNumbers) * sizeof(double) + 8 == sizeof(plumb_settings));
  for (const auto number : kNumbers)
    for (const double bad : {-1.0, HUGE_VAL, -HUGE_VAL, std::nan("")}) {
      plumb_settings s = defaults();
      s.target_limit_s = 1.0;
      s.*number = bad;
      EXPECT_EQ(plumb_configure(robot.get(), &s), PLUMB_BAD_NUMBER) << bad;
    }
  EXPECT_NEAR(fresh_for_s(robot.get()), 0.1, 0.0021);
}

TEST(Settings, ComeTooLateOnceTheCycleHasBegun) {
  const Robot robot;
  plumb_settings s = defaults();
  EXPECT_EQ(plumb_configure(robot.get(), &s), PLUMB_OK);
  s.target_limit_s = 0.2;
  EXPECT_EQ(plumb_configure(robot.get(), &s), PLUMB_OK) << "the last one counts";
  plumb_input in = sound_input();
  plumb_output out = blank_output();
  ASSERT_EQ(plumb_correct(robot.get(), &in, &out), PLUMB_OK);
  EXPECT_EQ(plumb_configure(robot.get(), &s), PLUMB_RUNNING);
}

TEST(Settings, BehindBadPointersAndSizesAreNamed) {
  const Robot robot;
  plumb_settings two[2] = {defaults(), defaults()};
  auto* const odd =
      reinterpret_cast<plumb_settings*>(reinterpret_cast<std::uintptr_t>(&two[0]) + 1);
  EXPECT_EQ(plumb_settings_init(nullptr), PLUMB_NULL);
  EXPECT_EQ(plumb_settings_init(odd), PLUMB_MISALIGNED);
  EXPECT_EQ(plumb_configure(nullptr, &two[0]), PLUMB_NULL);
  EXPECT_EQ(plumb_configure(robot.get(), nullptr), PLUMB_NULL);
  EXPECT_EQ(plumb_configure(robot.get(), odd), PLUMB_MISALIGNED);
  two[0].size -= 1;
  EXPECT_EQ(plumb_configure(robot.get(), &two[0]), PLUMB_BAD_SIZE);
  alignas(64) unsigned char other[1024]{};
  EXPECT_EQ(plumb_configure(reinterpret_cast<plumb_robot*>(other), &two[1]), PLUMB_NOT_A_ROBOT);
}

}  // namespace
}  // namespace plumb::tests

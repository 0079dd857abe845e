// SPDX-License-Identifier: Apache-2.0
// What the C interface promises when it is used as meant.
#include <cstring>
#include <filesystem>
#include <fstream>

#include "plumb/format/version.hpp"
#include "plumb/runtime/cycle.hpp"
#include "tests/c/support.hpp"

namespace plumb::tests {
namespace {

plumb_output run(plumb_robot* robot, plumb_input& in, int cycles) {
  plumb_output out = blank_output();
  for (int k = 0; k < cycles; ++k) {
    in.now_ns += kTick_ns;
    EXPECT_EQ(plumb_correct(robot, &in, &out), PLUMB_OK);
  }
  return out;
}

double distance(const plumb_pose& a, const plumb_pose& b) {
  return std::hypot(a.p_m[0] - b.p_m[0], a.p_m[1] - b.p_m[1], a.p_m[2] - b.p_m[2]);
}

TEST(CInterface, SaysTheSameAsTheCycleOfTheLibrary) {
  const format::Model model = informed_arm();
  const Robot robot;
  const auto loaded = LoadedModel::make(model);
  ModelSlot slot(*loaded);
  Cycle cycle(slot);
  plumb_input in = sound_input();
  CycleInput same;
  same.target = same.joints = Arrival::kArrived;
  same.X_BD = loaded->corrector().nominal().forward(std::span(home(), 6));
  std::copy_n(home(), PLUMB_MAX_JOINTS, same.q_measured.begin());
  same.context.payload_kg = {8.0, 0.0};
  same.context.payload_com_m = {0.0, 0.0, 0.0};
  same.context.temperature_degC[0] = {31.0, 0.0};
  same.context.time_s = {100.0, 0.0};
  for (int k = 0; k < 100; ++k) {
    const plumb_output out = run(robot.get(), in, 1);
    same.now_ns = in.now_ns;
    const CycleOutput expected = cycle.step(same);
    ASSERT_EQ(out.status, static_cast<int>(expected.output.status));
    for (int i = 0; i < 3; ++i) ASSERT_EQ(out.X_BC.p_m[i], expected.output.X_BC.p(i));
    for (int i = 0; i < 6; ++i) ASSERT_EQ(out.q[i], expected.correction.q[static_cast<size_t>(i)]);
  }
}

TEST(CInterface, CorrectsOnceRampedInAndPredictsTheTargetThere) {
  const Robot robot;
  plumb_input in = sound_input();
  const plumb_output out = run(robot.get(), in, 300);
  EXPECT_EQ(out.has_output, 1);
  EXPECT_EQ(out.status, PLUMB_STATUS_CONTEXT_FALLBACK);  // no joint has moved: no direction
  EXPECT_GT(distance(out.X_BC, in.X_BD), 1e-4);
  plumb_joints at{};
  at.size = sizeof at;
  std::copy_n(out.q, PLUMB_MAX_JOINTS, at.q);
  plumb_prediction there{};
  there.size = sizeof there;
  EXPECT_EQ(plumb_predict(robot.get(), &at, &there), PLUMB_OK);
  EXPECT_LT(distance(there.X_BT, in.X_BD), 1e-6);
}

TEST(CInterface, ReadsNothingOfWhatDidNotArrive) {
  const Robot robot;
  plumb_input in = sound_input();
  const plumb_output before = run(robot.get(), in, 300);
  const std::int64_t now = in.now_ns;
  const plumb_pose X_BD = in.X_BD;
  std::memset(&in, 0xff, sizeof in);  // NaN everywhere
  in.size = sizeof in;
  in.arrived = 0;
  in.now_ns = now;
  const plumb_output after = run(robot.get(), in, 10);
  EXPECT_LT(distance(before.X_BC, after.X_BC), 1e-12);
  EXPECT_GE(after.status, 0);
  EXPECT_EQ(run(robot.get(), in, 20).status, PLUMB_STATUS_STALE);
  EXPECT_LT(distance(run(robot.get(), in, 200).X_BC, X_BD), 1e-15);
}

TEST(CInterface, RampsOutAndInAgainWhenSwitched) {
  const Robot robot;
  plumb_input in = sound_input();
  run(robot.get(), in, 100);
  EXPECT_EQ(plumb_enable(robot.get(), 0), PLUMB_OK);
  EXPECT_EQ(distance(run(robot.get(), in, 100).X_BC, in.X_BD), 0.0);
  EXPECT_EQ(plumb_enable(robot.get(), 1), PLUMB_OK);
  EXPECT_GT(distance(run(robot.get(), in, 100).X_BC, in.X_BD), 1e-4);
}

TEST(CInterface, IsBoundToOneRobot) {
  const Bytes file = file_of(informed_arm());
  plumb_robot* robot = nullptr;
  char why[100];
  EXPECT_EQ(plumb_load_bytes(file.data(), file.size(), "C-2", &robot, why, sizeof why),
            PLUMB_OTHER_ROBOT);
  EXPECT_EQ(robot, nullptr);
  EXPECT_STREQ(why, "the model was made for serial 'C-1', not 'C-2'");
  EXPECT_EQ(plumb_load_bytes(file.data(), file.size(), "C-1", &robot, why, sizeof why), PLUMB_OK);
  EXPECT_STREQ(why, "");
  EXPECT_STREQ(plumb_serial(robot), "C-1");
  EXPECT_EQ(plumb_joint_count(robot), 6);
  EXPECT_STREQ(plumb_temperature_name(robot, 0), "temp_arm");
  EXPECT_EQ(plumb_temperature_name(robot, 1), nullptr);
  EXPECT_EQ(plumb_unload(robot), PLUMB_OK);
}

TEST(CInterface, RefusesASwapToAnotherRobotAndGoesOn) {
  const Robot robot;
  plumb_input in = sound_input();
  const plumb_output before = run(robot.get(), in, 300);
  format::Model another = informed_arm();
  another.nominal.joints[2].a += 0.001;
  const Bytes file = file_of(another);
  char why[100];
  EXPECT_EQ(plumb_swap_bytes(robot.get(), file.data(), file.size(), why, sizeof why),
            PLUMB_OTHER_ROBOT);
  EXPECT_NE(std::strstr(why, "nominal chain"), nullptr);
  const plumb_output after = run(robot.get(), in, 10);
  EXPECT_EQ(distance(before.X_BC, after.X_BC), 0.0);
}

TEST(CInterface, HoldsASecondSwapBackUntilTheCycleHasTakenTheFirst) {
  const Robot robot;
  plumb_input in = sound_input();
  run(robot.get(), in, 10);
  const Bytes file = file_of(informed_arm());
  const auto swap = [&] {
    return plumb_swap_bytes(robot.get(), file.data(), file.size(), nullptr, 0);
  };
  EXPECT_EQ(plumb_collect(robot.get()), PLUMB_OK);
  EXPECT_EQ(swap(), PLUMB_OK);
  EXPECT_EQ(swap(), PLUMB_BUSY);
  EXPECT_EQ(plumb_collect(robot.get()), PLUMB_BUSY);
  run(robot.get(), in, 1);
  EXPECT_EQ(plumb_collect(robot.get()), PLUMB_OK);
  EXPECT_EQ(swap(), PLUMB_OK);
  plumb_counters counters{};
  counters.size = sizeof counters;
  run(robot.get(), in, 1);
  EXPECT_EQ(plumb_read_counters(robot.get(), &counters), PLUMB_OK);
  EXPECT_EQ(counters.swaps, 2U);
  EXPECT_EQ(counters.steps, 12U);
}

TEST(CInterface, SaysWhyAModelCannotBeLoaded) {
  plumb_robot* robot = nullptr;
  char why[200];
  EXPECT_EQ(plumb_load_file("no such file", nullptr, &robot, why, sizeof why), PLUMB_UNREADABLE);
  EXPECT_GT(std::strlen(why), 10U);
  Bytes file = file_of(informed_arm());
  file[file.size() / 2] ^= std::byte{1};
  EXPECT_EQ(plumb_load_bytes(file.data(), file.size(), nullptr, &robot, why, sizeof why),
            PLUMB_UNREADABLE);
  EXPECT_EQ(plumb_load_bytes(file.data(), 0, nullptr, &robot, why, sizeof why), PLUMB_UNREADABLE);
  format::Model newer = informed_arm();
  newer.effects.back().name = "of_next_year";
  file = file_of(newer);
  EXPECT_EQ(plumb_load_bytes(file.data(), file.size(), nullptr, &robot, why, sizeof why),
            PLUMB_UNKNOWN_EFFECT);
  EXPECT_NE(std::strstr(why, "of_next_year"), nullptr);
  EXPECT_EQ(robot, nullptr);
}

TEST(CInterface, NeverWritesBeyondTheRoomForAMessage) {
  plumb_robot* robot = nullptr;
  for (std::size_t room = 0; room < 20; ++room) {
    char why[20];
    std::memset(why, '#', sizeof why);
    EXPECT_EQ(plumb_load_file("no such file", nullptr, &robot, why, room), PLUMB_UNREADABLE);
    if (room > 0) {
      EXPECT_EQ(std::strlen(why), room - 1);
    }
    for (std::size_t i = room; i < sizeof why; ++i) EXPECT_EQ(why[i], '#');
  }
}

TEST(CInterface, ReadsBytesAtAnyAlignment) {
  const Bytes file = file_of(informed_arm());
  Bytes shifted(file.size() + 8);
  for (std::size_t by = 0; by < 8; ++by) {
    std::copy(file.begin(), file.end(), shifted.begin() + static_cast<std::ptrdiff_t>(by));
    plumb_robot* robot = nullptr;
    EXPECT_EQ(plumb_load_bytes(shifted.data() + by, file.size(), nullptr, &robot, nullptr, 0),
              PLUMB_OK);
    EXPECT_EQ(plumb_unload(robot), PLUMB_OK);
  }
}

TEST(CInterface, HasATextForEveryNumber) {
  for (int status = PLUMB_STATUS_STALE; status <= PLUMB_STATUS_PARTIAL; ++status)
    EXPECT_STRNE(plumb_status_text(status), "unknown") << status;
  for (int result = PLUMB_OK; result <= PLUMB_RUNNING; ++result)
    EXPECT_STRNE(plumb_result_text(result), "unknown") << result;
  for (const int wrong : {PLUMB_STATUS_STALE - 1, PLUMB_STATUS_PARTIAL + 1, 1000, -1000, INT32_MIN})
    EXPECT_STREQ(plumb_status_text(wrong), "unknown") << wrong;
  for (const int wrong : {-1, PLUMB_RUNNING + 1, INT32_MIN})
    EXPECT_STREQ(plumb_result_text(wrong), "unknown") << wrong;
  EXPECT_STREQ(plumb_version(), format::kVersion);
}

}  // namespace
}  // namespace plumb::tests

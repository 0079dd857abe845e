// SPDX-License-Identifier: Apache-2.0
// The C++ face of a robot: every way of loading that can fail says which it was.
#include "plumb/robot.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/c/support.hpp"

namespace plumb::tests {
namespace {

using Fault = LoadError::Fault;

Fault fault_of(const Bytes& bytes) {
  const auto loaded = plumb::Robot::load(bytes);
  EXPECT_EQ(loaded.robot, nullptr);
  if (!loaded.error) {
    ADD_FAILURE() << "neither a robot nor an error";
    return Fault::kBusy;
  }
  EXPECT_FALSE(loaded.error->text.empty());
  return loaded.error->fault;
}

CycleInput arrived(const plumb::Robot& robot) {
  CycleInput in{.target = Arrival::kArrived, .joints = Arrival::kArrived};
  std::copy_n(home(), 6, in.q_measured.begin());
  std::copy_n(home(), 6, in.q_commanded.begin());
  in.X_BD = robot.nominal_pose(in.q_commanded);
  return in;
}

TEST(Robot, CorrectsAsTheCInterfaceDoesBitByBit) {
  const Bytes file = file_of(one_arm());
  const auto loaded = plumb::Robot::load(file);
  ASSERT_NE(loaded.robot, nullptr);
  const Robot c(one_arm());
  CycleInput in = arrived(*loaded.robot);
  plumb_input c_in;
  ASSERT_EQ(plumb_input_init(&c_in), PLUMB_OK);
  c_in.arrived = PLUMB_TARGET | PLUMB_MEASURED | PLUMB_COMMANDED;
  c_in.X_BD = pose_of(in.X_BD);
  std::copy_n(home(), PLUMB_MAX_JOINTS, c_in.q_measured);
  std::copy_n(home(), PLUMB_MAX_JOINTS, c_in.q_commanded);
  double largest = 0.0;
  for (int k = 0; k < 500; ++k, in.now_ns += kTick_ns, c_in.now_ns += kTick_ns) {
    const CycleOutput out = loaded.robot->correct(in);
    plumb_output c_out = blank_output();
    ASSERT_EQ(plumb_correct(c.get(), &c_in, &c_out), PLUMB_OK);
    for (int i = 0; i < 3; ++i) ASSERT_EQ(out.output.X_BC.p(i), c_out.X_BC.p_m[i]) << "cycle " << k;
    largest = std::max(largest, (out.output.X_BC.p - in.X_BD.p).norm());
  }
  EXPECT_GT(largest, 1e-4) << "nothing was corrected";
  EXPECT_EQ(loaded.robot->counters().steps, 500U);
}

bool is_nan(const Transformd& X) { return X.R.array().isNaN().all() && X.p.array().isNaN().all(); }

TEST(Robot, ReadsNoNumberBeyondTheJointsItIsGiven) {
  const auto loaded = plumb::Robot::load(file_of(one_arm()));
  ASSERT_NE(loaded.robot, nullptr);
  plumb::Robot& robot = *loaded.robot;
  for (std::size_t n = 0; n < 6; ++n) {
    const std::vector<double> few(home(), home() + n);  // memory tools see what is read beyond
    EXPECT_TRUE(is_nan(robot.nominal_pose(few))) << n;
    EXPECT_EQ(robot.predict(few).status, Status::kNotFinite) << n;
  }
  const std::vector<double> all(home(), home() + 6);
  std::vector<double> more = all;
  more.resize(12, 1e9);
  EXPECT_TRUE(robot.nominal_pose(all).p == robot.nominal_pose(more).p);
  EXPECT_TRUE(robot.nominal_pose(all).R == robot.nominal_pose(more).R);
  EXPECT_TRUE(robot.predict(all).X_BT.p == robot.predict(more).X_BT.p);
}

TEST(Robot, SendsNothingForTheNominalPoseOfTooFewJoints) {
  const auto loaded = plumb::Robot::load(file_of(one_arm()));
  ASSERT_NE(loaded.robot, nullptr);
  CycleInput in = arrived(*loaded.robot);
  in.X_BD = loaded.robot->nominal_pose({});
  EXPECT_FALSE(loaded.robot->correct(in).output.has_output);
}

TEST(Robot, SaysWhichFaultAModelHas) {
  const Bytes sound = file_of(one_arm());
  EXPECT_EQ(fault_of(Bytes(sound.begin(), sound.begin() + 40)), Fault::kTruncated);
  Bytes damaged = sound;
  damaged[damaged.size() / 2] ^= std::byte{0x10};
  EXPECT_EQ(fault_of(damaged), Fault::kDamaged);
  EXPECT_EQ(fault_of(Bytes(500, std::byte{7})), Fault::kNotAModel);
  const auto missing = plumb::Robot::load(std::filesystem::path("no such file.plumb"));
  ASSERT_TRUE(missing.error.has_value());
  EXPECT_EQ(missing.error->fault, Fault::kCannotOpen);
  EXPECT_NE(missing.error->text.find("no such file"), std::string::npos) << missing.error->text;
  format::Model strange = one_arm();
  strange.effects.emplace_back().name = "not_yet_known";
  EXPECT_EQ(fault_of(file_of(strange)), Fault::kUnknownEffect);
}

TEST(Robot, IsBoundToItsSerial) {
  const Bytes file = file_of(informed_arm());
  EXPECT_NE(plumb::Robot::load(file, "C-1").robot, nullptr);
  const auto other = plumb::Robot::load(file, "C-2");
  ASSERT_TRUE(other.error.has_value());
  EXPECT_EQ(other.error->fault, Fault::kOtherRobot);
}

TEST(Robot, TakesABetterModelAtItsNextCycleAndKeepsOutAnotherRobots) {
  const auto loaded = plumb::Robot::load(file_of(one_arm()));
  ASSERT_NE(loaded.robot, nullptr);
  plumb::Robot& robot = *loaded.robot;
  format::Model better = one_arm();
  better.calibrated.joints[1].a += 1e-4;
  EXPECT_FALSE(robot.swap(file_of(better)).has_value());
  const auto early = robot.swap(file_of(better));
  ASSERT_TRUE(early.has_value());
  EXPECT_EQ(early->fault, Fault::kBusy);
  EXPECT_FALSE(robot.collect());
  robot.correct(arrived(robot));
  EXPECT_TRUE(robot.collect());
  EXPECT_EQ(robot.counters().swaps, 1U);
  format::Model other = one_arm();
  other.nominal.joints[1].a += 0.1;
  const auto foreign = robot.swap(file_of(other));
  ASSERT_TRUE(foreign.has_value());
  EXPECT_EQ(foreign->fault, Fault::kOtherRobot);
  EXPECT_EQ(robot.model().calibrated.joints[1].a, better.calibrated.joints[1].a);
}

TEST(Robot, IsConfiguredBeforeItsFirstCycleOnly) {
  const auto loaded = plumb::Robot::load(file_of(one_arm()));
  ASSERT_NE(loaded.robot, nullptr);
  EXPECT_TRUE(loaded.robot->configure({.target_limit_s = 0.02}));
  loaded.robot->correct(arrived(*loaded.robot));
  EXPECT_FALSE(loaded.robot->configure({}));
}

}  // namespace
}  // namespace plumb::tests

// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/cycle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "tests/rt/one_arm.hpp"
#include "tests/runtime/random_arm.hpp"

namespace plumb {
namespace {

// cycle_test [<count> <seed>]
std::uint64_t count = 100'000;
std::uint64_t seed = 20250711;

constexpr double kRounding = 1e-13;
constexpr std::int64_t kTick_ns = 4'000'000;
constexpr double kTick_s = 0.004;

using Joints = std::array<double, kMaxJoints>;
using Model = std::unique_ptr<const LoadedModel>;

/// Directions of joints 2 and 3 and one temperature matter.
format::Model arm_model() {
  format::Model model = tests::one_arm();
  model.serial = "C-1";
  model.guard.ramp_s = 0.2;
  model.effects = {{.name = "reversal",
                    .version = 1,
                    .joints = {1, 2},
                    .parameters = {1e-4, 2e-4},
                    .context = {{format::ContextInput::kDirection, "", 0.0}},
                    .constants = {0.005}},
                   {.name = "thermal_growth",
                    .version = 1,
                    .joints = {1},
                    .parameters = {1e-5, 0.0, 0.0},
                    .context = {{format::ContextInput::kTemperature, "temp_arm", 20.0}},
                    .constants = {20.0}}};
  return model;
}

/// The same arm, calibrated to `by` elsewhere [m].
Model calibrated(double by) {
  format::Model model = arm_model();
  model.calibrated.joints[1].a += by;
  return LoadedModel::make(std::move(model));
}

Joints home() { return {0.1, -1.2, 1.4, 0.3, 1.1, -0.3, NAN, NAN, NAN}; }

/// One arm under a cycle, with a clock that ticks.
class Rig {
 public:
  explicit Rig(const CycleSettings& settings = {}) : cycle_(slot_, settings) { hear_all(); }

  /// Target and measured joints arrive, everything known.
  void hear_all() {
    const auto n = std::span(q_).first(6);
    in_.target = in_.joints = Arrival::kArrived;
    in_.X_BD = first_->corrector().nominal().forward(n);
    in_.q_measured = q_;
    in_.q_commanded = Context::unknown();
    in_.context.temperature_degC[0] = {25.0, 0.0};
  }
  void hear_nothing() {
    const std::int64_t now = in_.now_ns;
    in_ = {};
    in_.now_ns = now;
  }
  void move(double by) {
    for (int i = 0; i < 6; ++i) q_[static_cast<std::size_t>(i)] += by;
  }

  const CycleOutput& step() {
    in_.now_ns += kTick_ns;
    out_ = cycle_.step(in_);
    return out_;
  }
  const CycleOutput& steps(int n) {
    for (int k = 0; k < n; ++k) step();
    return out_;
  }
  Vector3 added() const { return out_.output.X_BC.p - in_.X_BD.p; }

  CycleInput& in() { return in_; }
  const CycleOutput& out() const { return out_; }
  Cycle& cycle() { return cycle_; }
  ModelSlot& slot() { return slot_; }
  const LoadedModel& first() const { return *first_; }
  std::span<const double> q() const { return std::span(q_).first(6); }

 private:
  Model first_ = calibrated(0.0);
  ModelSlot slot_{*first_};
  Cycle cycle_;
  Joints q_ = home();
  CycleInput in_;
  CycleOutput out_;
};

TEST(Cycle, SendsWhatTheInverseSaysOnceRampedIn) {
  Rig rig;
  const CycleOutput& out = rig.steps(200);
  Context context;
  context.temperature_degC[0] = 25.0;
  const Correction alone =
      rig.first().corrector().solve(rig.in().X_BD, rig.q(), SeedKind::kMeasured, context);
  EXPECT_EQ(alone.status, Status::kContextFallback);  // no joint has moved yet
  EXPECT_EQ(out.output.status, Status::kContextFallback);
  EXPECT_GT(rig.added().norm(), 1e-4);
  EXPECT_LT((out.output.X_BC.p - alone.X_BC.p).norm(), 1e-9);
  rig.move(0.01);
  rig.hear_all();
  EXPECT_EQ(rig.steps(200).output.status, Status::kOk);
}

TEST(Cycle, BringsTheTrueArmToTheTarget) {
  Rig rig;
  rig.steps(100);
  rig.move(-0.01);
  rig.hear_all();
  rig.steps(200);
  Context context = rig.cycle().context();
  EXPECT_EQ(context.direction[1], -1.0);
  const auto q = std::span(rig.out().correction.q).first(6);
  const Prediction arm = rig.first().corrector().forward_model().predict(q, context);
  EXPECT_LT((arm.X_BT.p - rig.in().X_BD.p).norm(), 1e-6);
}

TEST(Cycle, SendsNothingBeforeTheFirstValidCycle) {
  Rig rig;
  rig.hear_nothing();
  for (int k = 0; k < 50; ++k) {
    EXPECT_FALSE(rig.step().output.has_output);
    EXPECT_EQ(rig.out().output.status, Status::kStale);
  }
  rig.in().target = Arrival::kArrived;  // a target, but no joints to seed from
  EXPECT_FALSE(rig.step().output.has_output);
  rig.hear_all();
  EXPECT_TRUE(rig.step().output.has_output);
}

TEST(Cycle, PrefersTheCommandedJointsAsSeed) {
  Rig rig;
  rig.steps(10);
  rig.in().q_commanded = home();
  rig.in().q_commanded[2] += 0.5;  // too far from the target
  EXPECT_EQ(rig.step().correction.status, Status::kFarFromSeed);
  rig.in().q_commanded[2] = std::nan("");
  EXPECT_FALSE(refused(rig.step().correction.status));
}

TEST(Cycle, FollowsTheTargetFromItsLastSolution) {
  Rig rig({.joints_limit_s = 1e9});
  rig.step();
  for (int k = 0; k < 500; ++k) {
    rig.move(0.001);
    rig.hear_all();
    rig.in().joints = Arrival::kNothingNew;
    ASSERT_FALSE(refused(rig.step().correction.status)) << k;
  }
}

TEST(Cycle, FindsTheArmAgainAfterARefusal) {
  Rig rig;
  rig.steps(10);
  rig.move(0.5);  // the target jumps, the arm has not followed
  rig.hear_all();
  rig.in().joints = Arrival::kNothingNew;
  EXPECT_EQ(rig.step().correction.status, Status::kFarFromSeed);
  rig.hear_all();  // now it has
  EXPECT_FALSE(refused(rig.step().correction.status));
}

TEST(Cycle, RampsOutWhenTargetOrJointsStopArrivingAndInAgain) {
  for (const bool target : {true, false}) {
    Rig rig;
    rig.steps(200);
    const double full = rig.added().norm();
    (target ? rig.in().target : rig.in().joints) = Arrival::kNothingNew;
    Vector3 before = rig.added();
    int stale = 0;
    for (int k = 0; k < 200; ++k) {
      stale += rig.step().output.status == Status::kStale ? 1 : 0;
      ASSERT_LE((rig.added() - before).norm(), 0.01 * kTick_s + kRounding);
      before = rig.added();
    }
    EXPECT_NEAR(stale, 200 - 25, 1);  // 0.1 s of 4 ms cycles
    EXPECT_EQ(before.norm(), 0.0);
    EXPECT_EQ(rig.cycle().counters().stale, static_cast<std::uint64_t>(stale));
    rig.hear_all();
    rig.steps(200);
    EXPECT_NEAR(rig.added().norm(), full, 1e-9);
  }
}

TEST(Cycle, HoldsTheOutputUnderATargetThatIsNoneAndGoesOnFromTheLastSound) {
  Rig rig;
  const Vector3 sent = rig.steps(200).output.X_BC.p;
  const Transformd sound = rig.in().X_BD;
  rig.in().X_BD.p(1) = std::nan("");
  EXPECT_EQ(rig.step().output.status, Status::kNotFinite);
  EXPECT_EQ(rig.out().output.X_BC.p, sent);
  rig.in().X_BD = sound;
  rig.in().target = Arrival::kNothingNew;
  EXPECT_FALSE(refused(rig.step().output.status));
  EXPECT_LT((rig.out().output.X_BC.p - sent).norm(), 1e-9);
  rig.in().target = Arrival::kArrived;
  rig.in().X_BD.R.setZero();
  EXPECT_EQ(rig.steps(500).output.status, Status::kNotFinite);
  EXPECT_LT((rig.out().output.X_BC.p - sent).norm(), 1e-9);
}

TEST(Cycle, IsNotMovedByAClockThatJumpsOrByAnOverrun) {
  for (const std::int64_t jump : {std::int64_t{10'000'000'000}, std::int64_t{-10'000'000'000},
                                  INT64_MIN / 2, INT64_MAX / 2}) {
    for (int phase = 1; phase < 100; phase += 7) {
      Rig rig;
      rig.steps(phase);
      const Vector3 before = rig.added();
      rig.in().now_ns += jump;
      ASSERT_FALSE(refused(rig.step().output.status));
      ASSERT_LE((rig.added() - before).norm(), 0.01 * 2.0 * kTick_s + kRounding);
      ASSERT_FALSE(refused(rig.step().output.status));
    }
  }
}

TEST(Cycle, RampsOutAfterAnOverrunWithoutNewInputs) {
  Rig rig;
  rig.steps(200);
  rig.in().target = Arrival::kNothingNew;
  rig.in().now_ns += 10'000'000'000;
  const Vector3 before = rig.added();
  EXPECT_EQ(rig.step().output.status, Status::kStale);
  EXPECT_LE((rig.added() - before).norm(), 0.01 * 2.0 * kTick_s + kRounding);
}

TEST(Cycle, AbsorbsASwapAtAnyPhaseOfItsRamp) {
  const Model other = calibrated(1e-3);
  for (int phase = 1; phase < 120; ++phase) {
    Rig rig;
    rig.steps(phase);
    ASSERT_EQ(rig.slot().publish(*other), ModelSlot::Published::kDone);
    Vector3 before = rig.added();
    for (int k = 0; k < 150; ++k) {
      ASSERT_FALSE(refused(rig.step().output.status));
      ASSERT_LE((rig.added() - before).norm(), 0.01 * kTick_s + kRounding) << phase << " " << k;
      before = rig.added();
    }
    ASSERT_TRUE(rig.slot().settled());
    ASSERT_EQ(&rig.cycle().model(), other.get());
    ASSERT_EQ(rig.cycle().counters().swaps, 1U);
    ASSERT_LT((rig.out().output.X_BC.p - rig.out().correction.X_BC.p).norm(), 1e-12);
  }
}

TEST(Cycle, FallsBackWhenATemperatureIsTooOld) {
  Rig rig({.context = {.temperature_s = 0.5}});
  rig.move(0.01);
  rig.hear_all();
  rig.step();
  rig.move(0.01);
  rig.hear_all();
  EXPECT_EQ(rig.steps(100).correction.status, Status::kOk);
  rig.in().context = {};
  EXPECT_EQ(rig.steps(100).correction.status, Status::kOk);
  EXPECT_EQ(rig.steps(100).correction.status, Status::kContextFallback);
}

TEST(Cycle, HoldsTheDirectionAtRest) {
  Rig rig;
  rig.step();
  rig.move(0.01);
  rig.hear_all();
  rig.step();
  for (int k = 0; k < 500; ++k) {
    rig.step();
    ASSERT_EQ(rig.cycle().context().direction[1], 1.0);
  }
}

/// Everything at once, watched from outside.
class Storm {
 public:
  std::uint64_t good = 0;  // cycles

  explicit Storm(test::RandomArm& random) : random_(random) {}

  void step() {
    inputs();
    if (random_.coin(0.02)) swap();
    const CycleOutput& out = rig_.step();
    ASSERT_TRUE(out.output.X_BC.p.allFinite() && out.output.X_BC.R.allFinite());
    ASSERT_TRUE(std::isfinite(out.correction.residual_m));
    ASSERT_TRUE(std::isfinite(out.correction.residual_rad));
    for (const double q : out.correction.q) ASSERT_TRUE(std::isfinite(q));
    if (!refused(out.output.status)) valid_ = true;
    good += refused(out.output.status) ? 0 : 1;
    ASSERT_EQ(out.output.has_output, valid_);
    if (out.output.status == Status::kNotFinite && rig_.in().target == Arrival::kArrived && !sound_)
      return;
    const Vector3 added = out.output.X_BC.p - target_.p;
    ASSERT_LE(added.norm(), 0.003 + kRounding);
    ASSERT_LE((added - before_).norm(), 0.01 * 2.0 * kTick_s + kRounding);
    before_ = added;
  }

 private:
  double wild() {
    constexpr std::array<double, 10> kValues{0.0,  1e308,    -1e308,    4.9e-324, 1e-310,
                                             -1.0, HUGE_VAL, -HUGE_VAL, NAN,      1e5};
    return kValues[static_cast<std::size_t>(random_.integer(0, 9))];
  }

  void inputs() {
    rig_.move(random_.uniform(-2e-3, 2e-3));
    rig_.hear_all();
    CycleInput& in = rig_.in();
    const auto some = [this](double chance) {
      return random_.coin(chance) ? Arrival::kArrived : Arrival::kNothingNew;
    };
    in.target = some(0.9);
    in.joints = some(0.9);
    if (random_.coin(0.3)) std::copy_n(rig_.q().begin(), 6, in.q_commanded.begin());
    if (random_.coin(0.02)) in.q_measured[static_cast<std::size_t>(random_.integer(0, 5))] = wild();
    if (random_.coin(0.02))
      in.q_commanded[static_cast<std::size_t>(random_.integer(0, 5))] = wild();
    if (random_.coin(0.05)) in.context.temperature_degC[0] = {wild(), wild()};
    if (random_.coin(0.05)) in.context.payload_kg = {wild(), wild()};
    if (random_.coin(0.01)) in.now_ns = random_.integer(-2'000'000'000, 2'000'000'000) * kTick_ns;
    if (in.now_ns > INT64_MAX / 2) in.now_ns = 0;
    sound_ = !random_.coin(0.02);
    if (!sound_) in.X_BD.p(random_.integer(0, 2)) = NAN;
    if (sound_ && in.target == Arrival::kArrived) target_ = in.X_BD;
  }

  void swap() {
    if (!rig_.slot().settled()) return;
    next_ = 1 - next_;
    ASSERT_EQ(rig_.slot().publish(*models_[next_]), ModelSlot::Published::kDone);
  }

  test::RandomArm& random_;
  Rig rig_;
  std::array<Model, 2> models_{calibrated(5e-4), calibrated(-5e-4)};
  std::size_t next_ = 0;
  Transformd target_;
  Vector3 before_ = Vector3::Zero();
  bool sound_ = true;
  bool valid_ = false;
};

TEST(Cycle, StaysFiniteBoundedAndSlowUnderEverythingAtOnce) {
  std::printf("count %llu seed %llu\n", static_cast<unsigned long long>(count),
              static_cast<unsigned long long>(seed));
  test::RandomArm random(seed);
  constexpr std::uint64_t kSteps = 500;
  std::uint64_t good = 0;
  for (std::uint64_t done = 0; done < count && !HasFatalFailure(); done += kSteps) {
    Storm storm(random);
    for (std::uint64_t k = 0; k < kSteps && !HasFatalFailure(); ++k) storm.step();
    good += storm.good;
  }
  EXPECT_GT(good, count / 2);
}

}  // namespace
}  // namespace plumb

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (argc > 1) plumb::count = std::strtoull(argv[1], nullptr, 10);
  if (argc > 2) plumb::seed = std::strtoull(argv[2], nullptr, 10);
  return RUN_ALL_TESTS();
}

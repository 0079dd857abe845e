// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/guard.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "tests/runtime/random_arm.hpp"

namespace plumb {
namespace {

// guard_test [<count> <seed>]
std::uint64_t count = 2'000'000;
std::uint64_t seed = 20240607;

constexpr double kRounding = 1e-13;

/// Everything a bus, a sensor or a bug can put into a double.
double wild(test::RandomArm& random) {
  constexpr std::array<double, 13> kValues{0.0,
                                           -0.0,
                                           1.0,
                                           -1.0,
                                           1e308,
                                           -1.7976931348623157e308,
                                           4.9e-324,
                                           1e-310,
                                           -1e-308,
                                           2.2e-16,
                                           HUGE_VAL,
                                           -HUGE_VAL,
                                           std::numeric_limits<double>::quiet_NaN()};
  return kValues[static_cast<std::size_t>(random.integer(0, 12))];
}

Transformd sound_pose(test::RandomArm& random) { return from_pose(random.pose(2.0)); }

Transformd broken_pose(test::RandomArm& random) {
  Transformd X = sound_pose(random);
  switch (random.integer(0, 3)) {
    case 0:
      X.p(random.integer(0, 2)) = random.coin() ? HUGE_VAL : std::nan("");
      break;
    case 1:
      X.R *= random.coin() ? 1.1 : -1.0;
      break;
    case 2:
      X.R.setZero();
      break;
    default:
      X.R(random.integer(0, 2), random.integer(0, 2)) += 3.0;
      X.R(0, 0) = random.coin() ? std::nan("") : 1e308;
  }
  return X;
}

/// Beside the target by a millimetre, a metre, or a world.
Correction correction_for(test::RandomArm& random, const Transformd& X_BD) {
  Correction out{.X_BC = X_BD, .status = Status::kOk};
  const double length = random.coin() ? 1e-3 : random.uniform(0.0, 2.0);
  for (int i = 0; i < 3; ++i) out.X_BC.p(i) += random.uniform(-length, length);
  const auto turn = random.twist(0.0, random.coin() ? 1e-3 : 1.5);
  out.X_BC.R = exp(turn).R * out.X_BC.R;
  if (random.coin(0.1)) out.X_BC.p(random.integer(0, 2)) = wild(random);
  if (random.coin(0.05)) out.X_BC = broken_pose(random);
  if (random.coin(0.1)) out.status = static_cast<Status>(random.integer(-7, 2));
  return out;
}

double cycle(test::RandomArm& random) {
  return random.coin(0.8) ? random.uniform(0.0, 0.012) : wild(random);
}

bool finite(const Transformd& X) { return X.p.allFinite() && X.R.allFinite(); }

format::GuardLimits limits(test::RandomArm& random) {
  format::GuardLimits out;
  out.corrects = random.coin(0.8) ? format::Corrects::kPose : format::Corrects::kPosition;
  out.max_correction_m = random.uniform(0.0, 0.01);
  out.max_rotation_rad = random.uniform(0.0, 0.3);
  out.slew_m_per_s = random.uniform(0.0, 0.5);
  out.slew_rad_per_s = random.uniform(0.0, 1.0);
  out.ramp_s = random.coin(0.1) ? 0.0 : random.uniform(0.0, 0.3);
  return out;
}

/// What was added to the target.
struct Added {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  Eigen::Vector3d r = Eigen::Vector3d::Zero();
};

Added added(const Transformd& X_BC, const Transformd& X_BD) {
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(X_BC.R * X_BD.R.transpose()));
  return {X_BC.p - X_BD.p, turn.angle() * turn.axis()};
}

/// One guard under fire, watched from outside.
class Watch {
 public:
  Watch(const format::GuardLimits& limits_in, test::RandomArm& random)
      : limits_(limits_in),
        guard_(limits_in),
        random_(random),
        largest_m_(limits_in.max_correction_m),
        largest_rad_(limits_in.max_rotation_rad) {}

  void step() {
    if (random_.coin(0.01))
      guard_.enable(random_.coin() ? Guard::Enable::kOn : Guard::Enable::kOff);
    if (random_.coin(0.01)) swap();
    const bool sound = random_.coin(0.95);
    const auto inputs = random_.coin(0.95) ? Guard::Inputs::kFresh : Guard::Inputs::kStale;
    const Transformd X_BD = sound ? sound_pose(random_) : broken_pose(random_);
    const Correction correction = correction_for(random_, X_BD);
    const double dt = cycle(random_);
    const GuardOutput out = guard_.step(X_BD, correction, dt, inputs);

    ASSERT_TRUE(finite(out.X_BC));
    counted();
    if (!sound) return held(out);
    if (!refused(out.status)) valid_ = true;
    ASSERT_EQ(out.has_output, valid_);
    if (inputs == Guard::Inputs::kStale) {
      ASSERT_EQ(out.status, Status::kStale);
    } else if (refused(correction.status)) {
      ASSERT_EQ(out.status, correction.status);
    }
    if (valid_) last_ = out.X_BC;
    bounded(added(out.X_BC, X_BD), dt > 0.0 ? std::min(dt, 2.0 * limits_.cycle_s) : 0.0);
  }

  /// However it stands, refusals bring it to the target itself and keep it there.
  void decay() {
    const double rate =
        std::min(limits_.slew_m_per_s / largest_m_, limits_.slew_rad_per_s / largest_rad_);
    const int cycles = static_cast<int>(1.0 / (rate * limits_.cycle_s)) + 2;
    if (!(rate > 0.0) || cycles > 1'000) return;
    const Transformd X_BD = sound_pose(random_);
    Correction refusal{.X_BC = sound_pose(random_), .status = Status::kNotConverged};
    GuardOutput out;
    for (int k = 0; k < cycles; ++k) out = guard_.step(X_BD, refusal, limits_.cycle_s);
    ASSERT_EQ(out.X_BC.p, X_BD.p);
    ASSERT_EQ(out.X_BC.R, X_BD.R);
    before_ = {};
    counters_ = guard_.counters();
    if (valid_) last_ = out.X_BC;
  }

 private:
  void held(const GuardOutput& out) {
    ASSERT_EQ(out.status, Status::kNotFinite);
    ASSERT_EQ(out.has_output, valid_);
    if (!valid_) return;
    ASSERT_EQ(out.X_BC.p, last_.p);
    ASSERT_EQ(out.X_BC.R, last_.R);
  }

  void swap() {
    limits_ = limits(random_);
    guard_.swap(limits_);
    largest_m_ = std::max(largest_m_, limits_.max_correction_m);
    largest_rad_ = std::max(largest_rad_, limits_.max_rotation_rad);
  }

  void counted() {
    const GuardCounters now = guard_.counters();
    ASSERT_EQ(now.steps, counters_.steps + 1);
    const auto why = [](const GuardCounters& c) {
      return c.held + c.stale + c.refused + c.limited;
    };
    ASSERT_LE(why(now), why(counters_) + 1);
    ASSERT_GE(why(now), why(counters_));
    ASSERT_GE(now.swaps, counters_.swaps);
    counters_ = now;
  }

  /// Within the limits now, or on the way there from those of a model before.
  void bounded(const Added& now, double dt) {
    ASSERT_LE(now.p.norm(), std::max(limits_.max_correction_m, before_.p.norm()) + kRounding);
    ASSERT_LE((now.p - before_.p).norm(), limits_.slew_m_per_s * dt + kRounding);
    ASSERT_LE((now.r - before_.r).norm(), limits_.slew_rad_per_s * dt + kRounding);
    const bool turns = limits_.corrects == format::Corrects::kPose;
    const double limit = turns ? limits_.max_rotation_rad : 0.0;
    ASSERT_LE(now.r.norm(), std::max(limit, before_.r.norm()) + kRounding);
    before_ = now;
  }

  format::GuardLimits limits_;
  Guard guard_;
  test::RandomArm& random_;
  Added before_;
  Transformd last_;
  bool valid_ = false;
  GuardCounters counters_;
  double largest_m_;  // of all models so far
  double largest_rad_;
};

TEST(Guard, KeepsEveryOutputFiniteSmallSlowAndHeldWhateverComesIn) {
  std::printf("count %llu seed %llu\n", static_cast<unsigned long long>(count),
              static_cast<unsigned long long>(seed));
  test::RandomArm random(seed);
  constexpr std::uint64_t kSteps = 500;
  for (std::uint64_t done = 0; done < count && !HasFatalFailure(); done += kSteps) {
    Watch watch(limits(random), random);
    for (std::uint64_t k = 0; k < kSteps && !HasFatalFailure(); ++k) watch.step();
    watch.decay();
  }
}

/// One millimetre along x, wanted for ever.
struct Steady {
  Transformd X_BD = translation(0.5, 0.2, 0.9);
  Correction correction{.X_BC = translation(0.501, 0.2, 0.9), .status = Status::kOk};
  double x(const GuardOutput& out) const { return out.X_BC.p(0) - X_BD.p(0); }
};

TEST(Guard, RampsInSmoothlyOverTheRampTimeAndThenAddsAllOfIt) {
  const Steady steady;
  Guard guard({.ramp_s = 1.0, .cycle_s = 0.004});
  double before = 0.0, largest_step = 0.0;
  for (int k = 1; k <= 250; ++k) {
    const auto out = guard.step(steady.X_BD, steady.correction, 0.004);
    EXPECT_EQ(out.status, k < 250 ? Status::kRamping : Status::kOk) << k;
    EXPECT_GT(steady.x(out), before);
    largest_step = std::max(largest_step, steady.x(out) - before);
    before = steady.x(out);
    const double x = k / 250.0;
    EXPECT_NEAR(before, 1e-3 * x * x * (3.0 - 2.0 * x), 1e-12);
  }
  EXPECT_NEAR(before, 1e-3, 1e-15);
  EXPECT_LT(largest_step, 1.6e-3 * 0.004);
}

TEST(Guard, RampsOutToExactlyNothingWhenSwitchedOffAndInAgain) {
  const Steady steady;
  Guard guard({.ramp_s = 0.1, .cycle_s = 0.004});
  GuardOutput out;
  for (int k = 0; k < 60; ++k) out = guard.step(steady.X_BD, steady.correction, 0.004);
  EXPECT_NEAR(steady.x(out), 1e-3, 1e-15);
  guard.enable(Guard::Enable::kOff);
  for (int k = 0; k < 60; ++k) out = guard.step(steady.X_BD, steady.correction, 0.004);
  EXPECT_EQ(steady.x(out), 0.0);
  EXPECT_TRUE(out.has_output);
  guard.enable(Guard::Enable::kOn);
  for (int k = 0; k < 60; ++k) out = guard.step(steady.X_BD, steady.correction, 0.004);
  EXPECT_NEAR(steady.x(out), 1e-3, 1e-15);
}

TEST(Guard, RampsOutWithoutAStepWhenNothingFreshArrivesAndInAgain) {
  const Steady steady;
  Guard guard({.ramp_s = 0.4, .cycle_s = 0.004});
  GuardOutput out;
  for (int k = 0; k < 100; ++k) out = guard.step(steady.X_BD, steady.correction, 0.004);
  double before = steady.x(out);
  EXPECT_NEAR(before, 1e-3, 1e-15);
  for (int k = 0; k < 100; ++k) {
    out = guard.step(steady.X_BD, steady.correction, 0.004, Guard::Inputs::kStale);
    EXPECT_EQ(out.status, Status::kStale);
    EXPECT_LE(std::abs(steady.x(out) - before), 1.6e-3 * 0.01);
    EXPECT_LT(steady.x(out), before);
    before = steady.x(out);
  }
  EXPECT_EQ(before, 0.0);
  for (int k = 0; k < 100; ++k) out = guard.step(steady.X_BD, steady.correction, 0.004);
  EXPECT_EQ(out.status, Status::kOk);
  EXPECT_NEAR(steady.x(out), 1e-3, 1e-15);
  EXPECT_EQ(guard.counters().stale, 100U);
  EXPECT_EQ(guard.counters().refused, 0U);
}

TEST(Guard, SaysNothingWhileStaleFromTheBeginning) {
  const Steady steady;
  Guard guard({});
  for (int k = 0; k < 10; ++k)
    EXPECT_FALSE(
        guard.step(steady.X_BD, steady.correction, 0.004, Guard::Inputs::kStale).has_output);
  EXPECT_TRUE(guard.step(steady.X_BD, steady.correction, 0.004).has_output);
}

/// Two models that disagree by 3 mm; the second slower and tighter.
struct Swap {
  format::GuardLimits old_limits{
      .max_correction_m = 0.003, .slew_m_per_s = 0.02, .ramp_s = 0.4, .cycle_s = 0.004};
  format::GuardLimits new_limits{
      .max_correction_m = 0.0015, .slew_m_per_s = 0.005, .ramp_s = 0.8, .cycle_s = 0.004};
  Transformd X_BD = translation(0.5, 0.2, 0.9);
  Correction before{.X_BC = translation(0.502, 0.2, 0.9), .status = Status::kOk};
  Correction after{.X_BC = translation(0.499, 0.2, 0.9), .status = Status::kOk};
  double x(const GuardOutput& out) const { return out.X_BC.p(0) - X_BD.p(0); }

  /// Largest step of the guard in the two seconds after a swap at this cycle of its ramp.
  template <class Exchange>
  double largest_step(int phase, Exchange exchange) const {
    Guard guard(old_limits);
    double at = 0.0, largest = 0.0;
    for (int k = 0; k < phase; ++k) at = x(guard.step(X_BD, before, 0.004));
    exchange(guard);
    for (int k = 0; k < 500; ++k) {
      const double now = x(guard.step(X_BD, after, 0.004));
      largest = std::max(largest, std::abs(now - at));
      at = now;
    }
    EXPECT_NEAR(at, -1e-3, 1e-12) << phase;
    return largest;
  }
};

TEST(Guard, AbsorbsASwapAtAnyPhaseOfARampWithoutAStepBeyondTheSlewLimit) {
  const Swap swap;
  for (int phase = 0; phase < 150; ++phase)
    EXPECT_LE(swap.largest_step(phase, [&](Guard& guard) { guard.swap(swap.new_limits); }),
              0.005 * 0.004 + 1e-15)
        << phase;
}

TEST(Guard, WouldStepIfASwapMadeItAnew) {
  const Swap swap;
  EXPECT_GT(swap.largest_step(120, [&](Guard& guard) { guard = Guard(swap.new_limits); }), 1e-3);
}

TEST(Guard, StaysFiniteOnTopOfTargetsAtTheEndOfTheNumbers) {
  test::RandomArm random(seed);
  Guard guard({.corrects = format::Corrects::kPose, .ramp_s = 0.0});
  for (int k = 0; k < 100'000; ++k) {
    Transformd X_BD = sound_pose(random);
    for (int i = 0; i < 3; ++i) X_BD.p(i) = wild(random);
    const auto out = guard.step(X_BD, correction_for(random, X_BD), cycle(random));
    ASSERT_TRUE(finite(out.X_BC));
  }
}

TEST(Guard, TakesLimitsThatAreNoNumbersAsZero) {
  const Steady steady;
  for (const double bad : {std::nan(""), HUGE_VAL, -1.0}) {
    Guard guard({.max_correction_m = bad, .slew_m_per_s = bad, .ramp_s = bad, .cycle_s = bad});
    for (int k = 0; k < 10; ++k)
      EXPECT_EQ(steady.x(guard.step(steady.X_BD, steady.correction, 0.004)), 0.0);
  }
}

TEST(Guard, SaysNothingBeforeTheFirstValidCycle) {
  const Steady steady;
  Guard guard({});
  Correction refusal{.X_BC = steady.X_BD, .status = Status::kNearSingular};
  for (int k = 0; k < 10; ++k) {
    const auto out = guard.step(steady.X_BD, refusal, 0.004);
    EXPECT_FALSE(out.has_output);
    EXPECT_EQ(out.status, Status::kNearSingular);
  }
  EXPECT_TRUE(guard.step(steady.X_BD, steady.correction, 0.004).has_output);
  EXPECT_TRUE(guard.step(steady.X_BD, refusal, 0.004).has_output);
}

TEST(Guard, CountsWhatItDid) {
  const Steady steady;
  Guard guard({.max_correction_m = 1e-4, .ramp_s = 0.0});
  Correction refusal{.X_BC = steady.X_BD, .status = Status::kNearSingular};
  Transformd broken;
  broken.p(0) = std::nan("");
  EXPECT_EQ(guard.step(steady.X_BD, steady.correction, 0.004).status, Status::kLimited);
  (void)guard.step(steady.X_BD, refusal, 0.004);
  (void)guard.step(broken, steady.correction, 0.004);
  (void)guard.step(steady.X_BD, refusal, 0.004, Guard::Inputs::kStale);
  guard.swap({});
  EXPECT_EQ(guard.counters().steps, 4U);
  EXPECT_EQ(guard.counters().stale, 1U);
  EXPECT_EQ(guard.counters().swaps, 1U);
  EXPECT_EQ(guard.counters().limited, 1U);
  EXPECT_EQ(guard.counters().refused, 1U);
  EXPECT_EQ(guard.counters().held, 1U);
}

}  // namespace
}  // namespace plumb

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (argc > 1) plumb::count = std::strtoull(argv[1], nullptr, 10);
  if (argc > 2) plumb::seed = std::strtoull(argv[2], nullptr, 10);
  return RUN_ALL_TESTS();
}

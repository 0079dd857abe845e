// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/cycle_clock.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <tuple>

#include "tests/drivers/scripted_time.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::drivers {
namespace {

using tests::Script;
using tests::ScriptedTime;

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kSecond = 1000 * kMs;

CycleClock<ScriptedTime> clock_of(Script& script, std::int64_t period_ns = kMs) {
  return CycleClock<ScriptedTime>(period_ns, {&script});
}

TEST(CycleClock, TicksOnTheGridHoweverLateEachWakeUpIs) {
  Script script;
  const auto begin = script.now_ns;
  auto clock = clock_of(script);
  for (int i = 1; i <= 1000; ++i) {
    script.sleeps = {{.late_ns = 37'000 + i}};
    const Tick tick = clock.wait();
    EXPECT_EQ(tick.time_ns, begin + i * kMs);
    EXPECT_EQ(tick.latency_ns, 37'000 + i);
    EXPECT_EQ(tick.elapsed_ns, kMs);
    EXPECT_EQ(tick.missed, 0U);
    script.now_ns += 400'000;  // the cycle
  }
  EXPECT_EQ(clock.counters().ticks, 1000U);
  EXPECT_EQ(clock.counters().missed, 0U);
  EXPECT_EQ(clock.latency().worst_ns(), 38'000);
}

TEST(CycleClock, SkipsTheTickThatFellIntoTheCycleBefore) {
  Script script;
  const auto begin = script.now_ns;
  auto clock = clock_of(script);
  EXPECT_EQ(clock.wait().missed, 0U);
  script.now_ns += 1'300'000;
  const Tick tick = clock.wait();
  EXPECT_EQ(tick.time_ns, begin + 3 * kMs);
  EXPECT_EQ(tick.missed, 1U);
  EXPECT_EQ(tick.elapsed_ns, 2 * kMs);
  EXPECT_EQ(clock.counters().overruns, 1U);
}

TEST(CycleClock, TenSecondsStoppedInTheCycleGiveOneTickAndNoBurst) {
  Script script;
  auto clock = clock_of(script);
  std::ignore = clock.wait();
  script.now_ns += 10 * kSecond;
  const Tick tick = clock.wait();
  EXPECT_EQ(tick.missed, 10'000U);
  EXPECT_EQ(tick.elapsed_ns, 10'001 * kMs);
  EXPECT_EQ(clock.wait().missed, 0U);
  EXPECT_EQ(script.slept, 3);
  EXPECT_EQ(clock.counters().ticks, 3U);
}

TEST(CycleClock, TenSecondsStoppedInTheSleepGiveOneTickAndNoBurst) {
  Script script;
  const auto begin = script.now_ns;
  auto clock = clock_of(script);
  script.sleeps = {{.late_ns = 10 * kSecond + 300'000}};
  const Tick tick = clock.wait();
  EXPECT_EQ(tick.missed, 10'001U);
  EXPECT_EQ(tick.time_ns, begin + 10'002 * kMs);
  EXPECT_EQ(tick.latency_ns, 0);
  EXPECT_EQ(clock.counters().late_wakes, 1U);
  EXPECT_EQ(clock.latency().worst_ns(), 10 * kSecond + 300'000);
  EXPECT_EQ(clock.wait().time_ns, begin + 10'003 * kMs);
}

TEST(CycleClock, SignalsDoNotShortenTheWait) {
  Script script;
  const auto begin = script.now_ns;
  auto clock = clock_of(script);
  script.sleeps = {{-900'000, EINTR}, {-500'000, EINTR}, {-1, EINTR}, {8'000, 0}};
  const Tick tick = clock.wait();
  EXPECT_EQ(tick.time_ns, begin + kMs);
  EXPECT_EQ(tick.latency_ns, 8'000);
  EXPECT_EQ(tick.error, 0);
  EXPECT_EQ(script.slept, 4);
  EXPECT_EQ(clock.latency().count(), 1U);
}

TEST(CycleClock, ASleepThatEndsTooEarlyIsSleptAgain) {
  Script script;
  auto clock = clock_of(script);
  script.sleeps = {{-200, 0}};
  EXPECT_EQ(clock.wait().latency_ns, 0);
  EXPECT_EQ(script.slept, 2);
}

TEST(CycleClock, AClockThatGoesBackBetweenTicksStartsTheGridAnew) {
  Script script;
  auto clock = clock_of(script);
  std::ignore = clock.wait();
  script.now_ns -= 10 * kSecond;
  const auto then = script.now_ns;
  const Tick tick = clock.wait();
  EXPECT_EQ(tick.time_ns, then + kMs);
  EXPECT_EQ(tick.elapsed_ns, kMs);
  EXPECT_EQ(tick.missed, 0U);
  EXPECT_EQ(clock.counters().regrids, 1U);
}

TEST(CycleClock, AClockThatGoesBackInTheSleepStartsTheGridAnew) {
  Script script;
  auto clock = clock_of(script);
  script.sleeps = {{.late_ns = -10 * kSecond}};
  const auto then = script.now_ns + kMs - 10 * kSecond;
  EXPECT_EQ(clock.wait().time_ns, then + kMs);
  EXPECT_EQ(clock.counters().regrids, 1U);
}

TEST(CycleClock, SaysWhenItCannotSleep) {
  Script script;
  auto clock = clock_of(script);
  script.sleeps = {{-500'000, EINVAL}};
  EXPECT_EQ(clock.wait().error, EINVAL);
  EXPECT_EQ(clock.wait().error, 0);
}

TEST(CycleClock, TakesNoPeriodThatCannotBeKept) {
  Script script;
  for (const std::int64_t period : {std::int64_t{0}, std::int64_t{-5}, std::int64_t{1}})
    EXPECT_EQ(clock_of(script, period).period_ns(), CycleClock<>::kShortestPeriod_ns);
}

/// One wait after anything may have happened.
void obey_the_laws(CycleClock<ScriptedTime>& clock, const Script& script, std::int64_t begin,
                   std::int64_t last) {
  const auto regrids = clock.counters().regrids;
  const Tick tick = clock.wait();
  ASSERT_EQ(regrids, clock.counters().regrids);
  ASSERT_EQ((tick.time_ns - begin) % clock.period_ns(), 0);
  ASSERT_EQ(tick.time_ns, last + tick.elapsed_ns);
  ASSERT_EQ(tick.elapsed_ns, static_cast<std::int64_t>(1 + tick.missed) * clock.period_ns());
  ASSERT_GE(tick.latency_ns, 0);
  ASSERT_LT(tick.latency_ns, clock.period_ns());
  ASSERT_EQ(tick.latency_ns, script.now_ns - tick.time_ns);
}

TEST(CycleClock, EveryTickIsOnTheGridAndEveryPointIsATickOrMissed) {
  constexpr long kCases = 100'000;
  constexpr std::uint64_t kSeed = 3;
  std::printf("%ld cases, seed %d\n", tests::scaled(kCases), static_cast<int>(kSeed));
  tests::Random random(kSeed);
  Script script;
  const auto begin = script.now_ns;
  auto clock = clock_of(script);
  std::int64_t last = begin;
  for (long i = 0; i < tests::scaled(kCases); ++i) {
    for (int n = random.below(4); n > 0; --n)
      script.sleeps.push_back({static_cast<std::int64_t>(random.uniform(-1.0, 3.0) * kMs),
                               random.below(2) == 0 ? 0 : EINTR});
    script.now_ns += static_cast<std::int64_t>(random.uniform(0.0, 2.5) * kMs);
    ASSERT_NO_FATAL_FAILURE(obey_the_laws(clock, script, begin, last)) << i;
    last = script.now_ns - (script.now_ns - begin) % kMs;
    script.sleeps.clear();
  }
  const auto points = static_cast<std::uint64_t>((last - begin) / kMs);
  EXPECT_EQ(clock.counters().ticks + clock.counters().missed, points);
}

constexpr std::int64_t kSlow = 20 * kMs;
constexpr int kStopped_ms = 1000, kEnough = 40;  // of the 50 points in that time

/// Ticks until one came after a long stop; says how many it missed. Gives up after 10 s.
[[noreturn]] void tick_until_stopped(int ready) {
  CycleClock<> clock(kSlow);
  Tick tick;
  while (tick.missed < kEnough && clock.counters().ticks < 500) {
    tick = clock.wait();
    if (clock.counters().ticks == 3) std::ignore = ::write(ready, "r", 1);
  }
  ::_exit(static_cast<int>(std::min<std::uint64_t>(250, tick.missed)));
}

TEST(CycleClock, AProcessThatWasStoppedTicksOnceAndCountsTheRest) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const pid_t child = ::fork();
  if (child == 0) tick_until_stopped(ends[1]);
  char ready = 0;
  ASSERT_EQ(::read(ends[0], &ready, 1), 1);
  ::kill(child, SIGSTOP);
  ::usleep(kStopped_ms * 1000);
  ::kill(child, SIGCONT);
  int status = 0;
  ::waitpid(child, &status, 0);
  ::close(ends[0]);
  ::close(ends[1]);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_GE(WEXITSTATUS(status), kEnough);
}

}  // namespace
}  // namespace plumb::drivers

// SPDX-License-Identifier: Apache-2.0
// What plumb bench measures with, tried on kernels whose cost, and whose faults, are known.
#include "bench/timings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "bench/allocations.hpp"
#include "bench/part_models.hpp"
#include "bench/stopwatch.hpp"
#include "tests/rt/cycle_model.hpp"

namespace plumb::offline::bench {
namespace {

/// What the compiler may not leave out.
void* volatile sink = nullptr;

template <class Call>
CycleKernel kernel(Part part, Call call) {
  return {.part = part, .label = "", .kernel = std::make_unique<KernelOf<Call>>(call)};
}

template <class Call>
Timings timed(Call call, Part part = Part::kCycle, long calls = 100) {
  std::vector<CycleKernel> kernels;
  kernels.push_back(kernel(part, call));
  return time_kernels(kernels, {.calls = calls});
}

double spin(double ns) {
  const double end = now_ns() + ns;
  while (now_ns() < end) continue;
  return 1.0;
}

TEST(Allocations, EveryWayToTheHeapIsSeen) {
  const auto taken_by = [](auto violation) {
    const auto before = allocations();
    violation();
    return allocations() - before;
  };
  const auto kept = [](void* p) {
    sink = p;
    std::free(p);
  };
  const auto made = [](double* p) {
    sink = p;
    delete p;
  };
  EXPECT_EQ(taken_by([] { sink = nullptr; }), 0U);
  EXPECT_GT(taken_by([&] { made(new double(1.0)); }), 0U);
  EXPECT_GT(taken_by([&] { kept(std::malloc(8)); }), 0U);
  EXPECT_GT(taken_by([&] { kept(std::calloc(1, 8)); }), 0U);
  EXPECT_GT(taken_by([&] { kept(std::realloc(nullptr, 8)); }), 0U);
#ifndef __SANITIZE_THREAD__  // whose library does not tell of this one
  EXPECT_GT(taken_by([&] { kept(std::aligned_alloc(64, 64)); }), 0U);
#endif
}

TEST(Timings, SeeAnAllocationThatIsPlanted) {
  const Timings clean = timed([](std::size_t, double) { return 1.0; });
  EXPECT_EQ(clean.allocations, 0U);
  const Timings planted = timed([](std::size_t, double) {
    sink = std::malloc(16);
    std::free(sink);
    return 1.0;
  });
  EXPECT_GE(planted.allocations, 100U + 100U + 1U);
}

TEST(Timings, FindHowLongAKernelTakes) {
  for (const double ns : {5e3, 50e3}) {
    const Timings found = timed([ns](std::size_t, double) { return spin(ns); }, Part::kCycle, 2000);
    for (const Way way : {Way::kWarm, Way::kChain, Way::kCold})
      EXPECT_NEAR(found.of(Part::kCycle, way).at_share(0.0), ns, 0.2 * ns);
  }
}

TEST(Timings, ReadTheClockSeldomWhereACallIsShort) {
  const Timings fast =
      timed([](std::size_t i, double) { return static_cast<double>(i); }, Part::kGuard, 100000);
  EXPECT_GT(fast.of(Part::kGuard, Way::kWarm).calls_per_reading, 64);
  EXPECT_EQ(fast.of(Part::kGuard, Way::kCold).calls_per_reading, 1);
}

/// The first calls take longer than a whole reading, as if another program had run meanwhile.
TEST(Timings, ReadTheClockSeldomAlsoWhereTheFirstCallsAreDisturbed) {
  const auto disturbed = [](std::size_t i, double) {
    return i < 5 ? spin(10e3) : static_cast<double>(i);
  };
  const Timings found = timed(disturbed, Part::kGuard, 100000);
  EXPECT_GT(found.of(Part::kGuard, Way::kWarm).calls_per_reading, 64);
}

TEST(Timings, ReadTheClockAsSeldomAsFewCallsAllow) {
  const auto fast = [](std::size_t i, double) { return static_cast<double>(i); };
  EXPECT_EQ(timed(fast, Part::kGuard, 100).of(Part::kGuard, Way::kWarm).calls_per_reading, 8);
}

TEST(Timings, OfTheCycleAsAChainAreCallByCall) {
  const Timings found = timed([](std::size_t, double) { return 1.0; }, Part::kCycle, 5000);
  EXPECT_EQ(found.of(Part::kCycle, Way::kChain).calls_per_reading, 1);
  EXPECT_EQ(found.of(Part::kCycle, Way::kChain).calls(), 5000);
}

TEST(Timings, AreAsManyAsAskedForDownToOne) {
  for (const long calls : {1L, 2L, 7L, 99L, 1000L}) {
    const Timings found = timed([](std::size_t, double) { return 1.0; }, Part::kCycle, calls);
    EXPECT_EQ(found.of(Part::kCycle, Way::kChain).calls(), calls);
    EXPECT_EQ(found.of(Part::kCycle, Way::kCold).calls(), std::max(1L, calls / 100));
  }
}

/// A cost that only the waiting shows: each call passes on what it was given.
TEST(Timings, OfAChainWaitForTheCallBefore) {
  if (PLUMB_TIMED == 0) GTEST_SKIP() << "timing is judged in release";
  const auto roots = [](std::size_t i, double link) {
    double x = static_cast<double>(i + 2) + 0.0 * link;
    for (int k = 0; k < 4; ++k) x = std::sqrt(x + 1.0);
    return x;
  };
  const Timings found = timed(roots, Part::kCorrect, 200000);
  EXPECT_GT(found.of(Part::kCorrect, Way::kChain).median(),
            1.3 * found.of(Part::kCorrect, Way::kWarm).median());
}

TEST(Timing, SharesAreByNearestRank) {
  const Timing timing{.label = {}, .ns = {1.0, 2.0, 3.0, 4.0}};
  EXPECT_EQ(timing.at_share(0.0), 1.0);
  EXPECT_EQ(timing.median(), 2.0);
  EXPECT_EQ(timing.at_share(0.75), 3.0);
  EXPECT_EQ(timing.p99(), 4.0);
  EXPECT_EQ(timing.most(), 4.0);
}

TEST(CycleKernels, GiveTheSameFreeAndChained) {
  const format::Model model = tests::cycle_model();
  const BenchInputs inputs(model, 1);
  const CycleKernels one(model, inputs), other(model, inputs);
  ASSERT_EQ(one.all().size(), 3U + 2U + 6U + 1U);
  for (std::size_t i = 0; i < one.all().size(); ++i)
    for (std::size_t k = 0; k < 20; ++k) {
      const double chained = one.all()[i].kernel->run(k, 1, Chaining::kChained);
      EXPECT_EQ(other.all()[i].kernel->run(k, 1, Chaining::kFree), chained);
      EXPECT_TRUE(std::isfinite(chained));
    }
}

TEST(CycleKernels, NameAnEffectThatStandsTwiceTwice) {
  format::Model model = tests::cycle_model();
  model.effects = {model.effects[1], model.effects[1], model.effects[1]};
  const BenchInputs inputs(model, 1);
  std::vector<std::string> labels;
  const CycleKernels kernels(model, inputs);
  for (const auto& k : kernels.all())
    if (k.part == Part::kEffect) labels.push_back(k.label);
  const std::string label = effect_label(model, 0);
  EXPECT_EQ(labels, (std::vector<std::string>{label, label + "#2", label + "#3"}));
}

TEST(BenchInputs, LieWithinLimitsAndTrainedDomain) {
  format::Model model = tests::cycle_model();
  model.domain.q_min[2] = 0.5;
  model.nominal.joints[2].q_max = 0.75;
  model.nominal.joints[3].q_min = -0.25;
  const BenchInputs inputs(model, 9), again(model, 9), others(model, 10);
  for (std::size_t i = 0; i < BenchInputs::kPoses; ++i) {
    const auto& q = inputs.pose(i).q;
    EXPECT_TRUE(q[2] >= 0.5 && q[2] <= 0.75);
    EXPECT_TRUE(q[3] >= -0.25 && q[3] <= 3.0);
    EXPECT_EQ(q, again.pose(i).q);
    EXPECT_NE(q, others.pose(i).q);
  }
}

TEST(PartModels, HaveThatPartAndNoOther) {
  const format::Model model = tests::cycle_model();
  EXPECT_TRUE(chain_alone(model).effects.empty());
  EXPECT_EQ(chain_alone(model).trees[0].leaves(), 0U);
  EXPECT_EQ(with_one_effect(model, 2).effects.size(), 1U);
  EXPECT_EQ(with_one_effect(model, 2).effects[0], model.effects[2]);
  EXPECT_EQ(with_trees_alone(model).trees, model.trees);
  EXPECT_TRUE(with_trees_alone(model).effects.empty());
}

}  // namespace
}  // namespace plumb::offline::bench

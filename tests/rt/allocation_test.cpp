// SPDX-License-Identifier: Apache-2.0
// No allocation in the cycle: the C library's heap is counted, and operator new stands on it.
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <vector>

#include "tests/heap_calls.hpp"
#include "tests/rt/gate_arms.hpp"
#include "tests/rt/whole_cycle.hpp"

namespace plumb {
namespace {

constexpr long kCycles = 10000;

using tests::heap_calls_of;

struct Planted {
  const char* name;
  std::function<void()> violation;
};

/// What the compiler may not leave out.
void* volatile sink = nullptr;
std::vector<int> kept;

void release() { std::free(sink); }

class PlantedAllocation : public testing::TestWithParam<Planted> {};

TEST_P(PlantedAllocation, IsCaught) { EXPECT_GT(heap_calls_of(GetParam().violation), 0); }

INSTANTIATE_TEST_SUITE_P(
    Allocation, PlantedAllocation,
    testing::Values(Planted{"New", [] { sink = new double(1.0), release(); }},
                    Planted{"Vector", [] { std::vector<int>(100).swap(kept); }},
                    Planted{"Malloc", [] { sink = std::malloc(8), release(); }},
                    Planted{"Calloc", [] { sink = std::calloc(1, 8), release(); }},
                    Planted{"Realloc", [] { sink = std::realloc(nullptr, 8), release(); }},
                    Planted{"Aligned", [] { sink = std::aligned_alloc(64, 64), release(); }},
                    Planted{"Free", [] { sink = nullptr, release(); }}),
    [](const auto& plant) { return std::string(plant.param.name); });

void expect_none_in_ten_thousand_cycles(const format::Model& model) {
  ASSERT_EQ(find_effect_fault(model).kind, EffectFault::Kind::kNone);
  tests::WholeCycle cycle(model);
  EXPECT_EQ(heap_calls_of([&] { cycle.run(kCycles); }), 0);
  EXPECT_GT(cycle.valid(), 0);
  EXPECT_GT(cycle.refusals(), 0);
  EXPECT_GT(cycle.counters().held, 0U);
}

TEST(Allocation, NeverHappensInTenThousandCycles) {
  expect_none_in_ten_thousand_cycles(tests::one_arm());
}

TEST(Allocation, NeverHappensInTenThousandCyclesWithBlendedTrees) {
  expect_none_in_ten_thousand_cycles(tests::blended_arm());
}

TEST(Allocation, NeverHappensInTenThousandCyclesWithSixEffectsAndThreeHundredLeaves) {
  expect_none_in_ten_thousand_cycles(tests::cycle_model());
}

TEST(Allocation, NeverHappensInTenThousandCyclesWithEveryLawAndAFormula) {
  expect_none_in_ten_thousand_cycles(tests::every_law_arm());
}

}  // namespace
}  // namespace plumb

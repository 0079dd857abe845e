// SPDX-License-Identifier: Apache-2.0
// No allocation in the cycle: every operator new of this program is counted.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <memory>
#include <new>

#include "plumb/format/formula.hpp"
#include "plumb/runtime/corrector.hpp"
#include "plumb/runtime/guard.hpp"
#include "tests/random_numbers.hpp"
#include "tests/rt/one_arm.hpp"

namespace {
std::atomic<long> allocations{0};
}

void* operator new(std::size_t size) {
  ++allocations;
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }

namespace plumb {
namespace {

template <class F>
long allocations_of(F cycle) {
  const long before = allocations;
  cycle();
  return allocations - before;
}

TEST(Allocation, IsCaughtWhenPlanted) {
  const long caught = allocations_of([] {
    const auto planted = std::make_unique<double>(1.0);
    EXPECT_EQ(*planted, 1.0);
  });
  EXPECT_EQ(caught, 1);
}

/// dq2 = k * tau2 * (1 + c*abs(tau2)) + sin(log(q1)), which has no value at half of the poses.
format::Effect formula() {
  using format::FormulaOp;
  using format::instruction;
  format::Effect out;
  out.name = "formula";
  out.parameters = {1e-7, 1e-3};
  out.formula.joint = 1;
  out.formula.literals = {1.0};
  out.formula.parameters = {{"k", "rad/(N m)", 1e-7, 0.0}, {"c", "1/(N m)", 1e-3, 0.0}};
  out.formula.code = {instruction(FormulaOp::kParameter, 0), instruction(FormulaOp::kTorque, 1),
                      instruction(FormulaOp::kMultiply),     instruction(FormulaOp::kLiteral, 0),
                      instruction(FormulaOp::kParameter, 1), instruction(FormulaOp::kTorque, 1),
                      instruction(FormulaOp::kAbs),          instruction(FormulaOp::kMultiply),
                      instruction(FormulaOp::kAdd),          instruction(FormulaOp::kMultiply),
                      instruction(FormulaOp::kPosition, 0),  instruction(FormulaOp::kLog),
                      instruction(FormulaOp::kSin),          instruction(FormulaOp::kAdd)};
  return out;
}

void run_ten_thousand_cycles(format::Model model) {
  model.effects.push_back(formula());
  ASSERT_EQ(find_effect_fault(model).kind, EffectFault::Kind::kNone);
  const Corrector corrector(model);
  Guard guard(model.guard);
  tests::Random random(1);
  long valid = 0;
  const long caught = allocations_of([&] {
    for (int i = 0; i < 10000; ++i) {
      std::array<double, 6> q{};
      for (double& x : q) x = random.uniform(-3.0, 3.0);
      const Prediction prediction = corrector.forward_model().predict(q);
      const Correction correction = corrector.solve(prediction.X_BT, q, SeedKind::kMeasured);
      const GuardOutput output = guard.step(prediction.X_BT, correction, 0.004);
      valid += output.has_output ? 1 : 0;
    }
  });
  EXPECT_EQ(caught, 0);
  EXPECT_GT(valid, 0);
}

TEST(Allocation, NeverHappensInTenThousandCycles) { run_ten_thousand_cycles(tests::one_arm()); }

TEST(Allocation, NeverHappensInTenThousandCyclesWithBlendedTrees) {
  run_ten_thousand_cycles(tests::blended_arm());
}

}  // namespace
}  // namespace plumb

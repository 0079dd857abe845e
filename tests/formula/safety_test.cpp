// SPDX-License-Identifier: Apache-2.0
// Whatever a model file holds, it is refused or it runs: no formula leaves its stack or its tables.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "plumb/format/formula.hpp"
#include "plumb/format/reader.hpp"
#include "plumb/format/writer.hpp"
#include "plumb/runtime/forward_model.hpp"
#include "tests/random_numbers.hpp"
#include "tests/rt/one_arm.hpp"

namespace plumb {
namespace {

using format::FormulaFault;
using format::FormulaOp;
using format::FormulaTarget;
using format::instruction;
using tests::Random;

int between(Random& random, int low, int high) { return low + random.below(high - low + 1); }

/// dq2 = k tau2 + 0.001 q1.
format::Effect sound() {
  format::Effect out;
  out.name = "formula";
  out.parameters = {1e-7};
  out.formula.name = "sample";
  out.formula.joint = 1;
  out.formula.expression = "dq2 = k * tau2 + 0.001 * q1";
  out.formula.code = {instruction(FormulaOp::kParameter, 0), instruction(FormulaOp::kTorque, 1),
                      instruction(FormulaOp::kMultiply),     instruction(FormulaOp::kLiteral, 0),
                      instruction(FormulaOp::kPosition, 0),  instruction(FormulaOp::kMultiply),
                      instruction(FormulaOp::kAdd)};
  out.formula.literals = {0.001};
  out.formula.parameters = {{"k", "rad/(N m)", 1e-7, 0.0}};
  return out;
}

FormulaFault fault_of(void (*change)(format::Effect&)) {
  format::Effect effect = sound();
  change(effect);
  const FormulaFault out = format::find_formula_fault(effect, 6);
  // The reader and the library say the same.
  format::Model model = tests::one_arm();
  model.effects = {effect};
  if (out != FormulaFault::kNone) {
    EXPECT_THROW(format::write_model(model), std::invalid_argument);
    EXPECT_NE(find_effect_fault(model).kind, EffectFault::Kind::kNone);
  }
  return out;
}

TEST(FormulaSafety, EveryUnsoundCodeIsRefusedBeforeItRuns) {
  using F = FormulaFault;
  EXPECT_EQ(fault_of([](auto&) {}), F::kNone);
  EXPECT_EQ(fault_of([](auto& e) { e.formula.code.clear(); }), F::kMissing);
  EXPECT_EQ(fault_of([](auto& e) { e.name = "encoder_scale"; }), F::kMissing);
  EXPECT_EQ(fault_of([](auto& e) { e.formula.code.pop_back(); }), F::kStack);
  EXPECT_EQ(fault_of([](auto& e) { e.formula.code.erase(e.formula.code.begin()); }), F::kStack);
  EXPECT_EQ(fault_of([](auto& e) { e.formula.code.back() = 0xFF; }), F::kOperation);
  EXPECT_EQ(fault_of([](auto& e) { e.formula.code[0] = instruction(FormulaOp::kParameter, 1); }),
            F::kOperand);
  EXPECT_EQ(fault_of([](auto& e) { e.formula.code[1] = instruction(FormulaOp::kTorque, 6); }),
            F::kOperand);
  EXPECT_EQ(fault_of([](auto& e) { e.formula.code[1] = instruction(FormulaOp::kTemperature); }),
            F::kOperand);
  EXPECT_EQ(fault_of([](auto& e) { e.formula.code[1] = instruction(FormulaOp::kTip, 3); }),
            F::kOperand);
  EXPECT_EQ(fault_of([](auto& e) { e.formula.code[2] = instruction(FormulaOp::kMultiply, 1); }),
            F::kOperand);
  EXPECT_EQ(fault_of([](auto& e) { e.formula.code.assign(129, e.formula.code[0]); }), F::kTooLong);
  EXPECT_EQ(fault_of([](auto& e) { e.formula.expression.assign(1025, 'x'); }), F::kTooLong);
  EXPECT_EQ(fault_of([](auto& e) {
              e.formula.code.assign(25, e.formula.code[0]);
              e.formula.code.insert(e.formula.code.end(), 24, instruction(FormulaOp::kAdd));
            }),
            F::kStack);
  EXPECT_EQ(fault_of([](auto& e) { e.formula.joint = 6; }), F::kTarget);
  EXPECT_EQ(fault_of([](auto& e) { e.formula.component = 6; }), F::kTarget);
  EXPECT_EQ(fault_of([](auto& e) { e.formula.target = FormulaTarget{6}; }), F::kTarget);
  EXPECT_EQ(fault_of([](auto& e) {
              e.formula.target = FormulaTarget::kTip;
              e.formula.component = 3;
            }),
            F::kTarget);
  EXPECT_EQ(fault_of([](auto& e) { e.formula.domain = 4; }), F::kTarget);
  EXPECT_EQ(fault_of([](auto& e) { e.formula.literals[0] = NAN; }), F::kNumbers);
  EXPECT_EQ(fault_of([](auto& e) { e.parameters.push_back(1.0); }), F::kNumbers);
  EXPECT_EQ(fault_of([](auto& e) { e.formula.parameters[0].typical = 0.0; }), F::kNumbers);
}

format::Effect random_effect(Random& random) {
  format::Effect out = sound();
  format::Formula& f = out.formula;
  f.target = static_cast<FormulaTarget>(between(random, 0, 6));
  f.joint = static_cast<std::uint8_t>(between(random, 0, 6));
  f.component = static_cast<std::uint8_t>(between(random, 0, 5));
  f.literals = {random.uniform(-1e3, 1e3), 0.0, 1e300};
  f.code.clear();
  int height = 0;
  for (int n = between(random, 1, 40); n > 0 || (height > 1 && f.code.size() < 128); --n) {
    auto op = static_cast<FormulaOp>(between(random, 0, 29));
    if (n <= 0) op = static_cast<FormulaOp>(between(random, 22, 28));
    // Mostly sound, sometimes anything.
    if (height < format::taken(op) && between(random, 0, 50) > 0) op = FormulaOp::kPosition;
    const auto most = static_cast<int>(format::choices(op, out, 6)) - 1;
    const int operand = between(random, 0, 400) == 0 ? between(random, 0, 255)
                                                     : between(random, 0, std::max(0, most));
    f.code.push_back(instruction(op, static_cast<unsigned>(operand)));
    height += 1 - format::taken(op);
  }
  return out;
}

TEST(FormulaSafety, AnyCodeIsRefusedOrMovesTheArmByFiniteNumbers) {
  const long count = tests::scaled(20000);
  constexpr std::uint64_t kSeed = 7;
  std::printf("%ld codes, seed %llu\n", count, static_cast<unsigned long long>(kSeed));
  Random random(kSeed);
  long ran = 0, told = 0;
  format::Model model = tests::one_arm();
  for (long i = 0; i < count; ++i) {
    model.effects = {random_effect(random)};
    const bool refused = format::find_formula_fault(model.effects[0], 6) != FormulaFault::kNone;
    EXPECT_EQ(refused, find_effect_fault(model).kind != EffectFault::Kind::kNone);
    if (refused) continue;
    ++ran;
    const ForwardModel arm(model);
    std::array<double, 6> q{};
    for (double& v : q) v = random.uniform(-3.0, 3.0);
    const Prediction p = arm.predict(q);
    told += p.status == Status::kContextFallback;
    EXPECT_TRUE(p.X_BT.p.allFinite() && p.X_BT.R.allFinite());
  }
  std::printf("%ld ran, %ld of them said that they have no value\n", ran, told);
  EXPECT_GT(ran, count / 4);
  EXPECT_GT(told, 0);
  EXPECT_LT(told, ran);
}

TEST(FormulaSafety, AModelFileKeepsAFormulaAndACutOneIsRefused) {
  format::Model model = tests::one_arm();
  model.effects = {sound()};
  const auto bytes = format::write_model(model);
  const auto read = format::read_model(bytes);
  ASSERT_TRUE(std::holds_alternative<format::Model>(read));
  EXPECT_EQ(std::get<format::Model>(read), model);
  for (std::size_t at = 0; at < bytes.size(); at += 7) {
    auto damaged = bytes;
    damaged[at] ^= std::byte{0x10};
    EXPECT_TRUE(std::holds_alternative<format::ReadError>(format::read_model(damaged)));
  }
}

TEST(FormulaSafety, WithoutAValueTheArmIsWhereItIsWithoutTheFormula) {
  format::Model model = tests::one_arm();
  const ForwardModel rigid(model);
  format::Model with = model;
  with.effects = {sound()};
  with.effects[0].formula.code = {instruction(FormulaOp::kPosition, 0),
                                  instruction(FormulaOp::kLog)};
  const ForwardModel arm(with);
  std::array<double, 6> q{-0.5, 0.3, 0.2, 0.1, 0.4, 0.0};
  const Prediction none = arm.predict(q);
  EXPECT_EQ(none.status, Status::kContextFallback);
  EXPECT_EQ((none.X_BT.p - rigid.predict(q).X_BT.p).norm(), 0.0);
  q[0] = 1.01;
  const Prediction some = arm.predict(q);
  EXPECT_EQ(some.status, Status::kOk);
  EXPECT_GT((some.X_BT.p - rigid.predict(q).X_BT.p).norm(), 1e-3);
}

}  // namespace
}  // namespace plumb

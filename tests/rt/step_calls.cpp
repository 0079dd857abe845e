// SPDX-License-Identifier: Apache-2.0
// Runs one whole step of the cycle for every model that a file describes, each inside `one_call`,
// for count_steps.
//   step_calls FILE
// A line describes one model by words, all of which may be left out:
//   joints=N           revolute joints, 6 if not said; six are those of a UR10
//   slides=N           as many of them are prismatic
//   general            rows that are not plain DH rows
//   pose               corrects poses, not positions
//   masses             of links and payload
//   ranges=N           ranges of context inputs
//   effect=LAW:J:N:W   the law on J joints, N times; W: waves of a series
//   formula=OP:T:L:N   formula of L instructions that repeats operation OP, moves target T; N times
//   tree=K:L:D:R:A     kind crisp, oblique, blended or both; leaves; degree; R 1 with regions; A 1
//   if
//                      the axes share their leaves; leaves hang in a comb if L is negative
// Every model is written and read again: what the reader does not accept ends the program. Printed
// are the instructions that bench foresees for this build, one number a line.
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <memory>
#include <sstream>
#include <variant>

#include "bench/step_instructions.hpp"
#include "plumb/format/context_ranges.hpp"
#include "plumb/format/formula.hpp"
#include "plumb/format/reader.hpp"
#include "plumb/format/writer.hpp"
#include "plumb/runtime/cycle.hpp"
#include "tests/random_numbers.hpp"
#include "tests/rt/every_effect.hpp"
#include "tests/rt/one_arm.hpp"
#include "tests/runtime/random_tree.hpp"

namespace {

using namespace plumb;
using Words = std::vector<std::string>;

[[noreturn]] void fail(const std::string& why) {
  std::cerr << "step_calls: " << why << "\n";
  std::exit(2);
}

Words split(const std::string& text) {
  Words out;
  std::istringstream in(text);
  for (std::string word; std::getline(in, word, ':');) out.push_back(word);
  return out;
}

format::Chain chain_of(int joints, int slides, bool general, double error) {
  format::Chain out = tests::one_arm().nominal;
  for (int i = 6; i < joints; ++i)
    out.joints.push_back(out.joints[static_cast<std::size_t>(i - 5)]);
  out.joints.resize(static_cast<std::size_t>(joints));
  for (int i = 0; i < joints; ++i) {
    auto& row = out.joints[static_cast<std::size_t>(i)];
    row.name = "J" + std::to_string(i + 1);
    row.q_min = -3.0, row.q_max = 3.0;
    row.alpha += error, row.a += error;
    if (i < slides) row.type = format::JointType::kPrismatic;
    if (!general) continue;
    row.beta = row.offset = 1e-3;
    row.scale = 1.0001;
    row.pre = {{1e-4, 2e-4, 3e-4}, {1e-4, 2e-4, 3e-4}};
    row.post = row.pre;
  }
  return out;
}

void add_effects(const Words& words, format::Model& model) {
  if (words.size() != 4) fail("effect=LAW:J:N:W");
  const int law = find_effect_law(words[0]);
  if (law < 0) fail("no law " + words[0]);
  format::Effect one = tests::typical_effect(model, law, std::stoi(words[1]));
  if (words[0] == "joint_table") {  // typical_effect has one of them
    const auto each = one.parameters;
    for (int j = 1; j < std::stoi(words[1]); ++j) {
      one.joints.push_back(static_cast<std::uint8_t>(j));
      one.parameters.insert(one.parameters.end(), each.begin(), each.end());
    }
  }
  if (words[0] == "joint_series") {
    one.constants[0] = std::stod(words[3]);
    one.parameters.assign(2 * one.joints.size() * std::stoul(words[3]), 1e-7);
  }
  for (int k = 0; k < std::stoi(words[2]); ++k) {
    model.effects.push_back(one);
    for (auto& need : model.effects.back().context)
      if (need.input == format::ContextInput::kTemperature) need.name = "t" + std::to_string(k % 8);
  }
}

/// Parameter, then OP with what it takes, over and over; ends as it began if OP has no place more.
void add_formulas(const Words& words, format::Model& model) {
  using format::FormulaOp;
  if (words.size() != 4) fail("formula=OP:T:L:N");
  const auto op = static_cast<FormulaOp>(std::stoi(words[0]));
  const auto last = static_cast<unsigned>(model.nominal.joints.size() - 1);
  format::Effect one;
  one.name = "formula";
  one.formula.target = static_cast<format::FormulaTarget>(std::stoi(words[1]));
  one.formula.joint = static_cast<std::uint8_t>(last);
  one.formula.component = one.formula.target == format::FormulaTarget::kTip ? 2 : 5;
  one.formula.literals = {0.5};
  one.formula.parameters = {{"p", "1", 1.0, 0.5}};
  one.parameters = {0.5};
  one.formula.name = "f";
  auto& code = one.formula.code;
  const auto length = static_cast<std::size_t>(std::stoi(words[2]));
  const auto literal = format::instruction(FormulaOp::kLiteral, 0);
  const int taken = format::taken(op);
  const bool of_joint = op == FormulaOp::kPosition || op == FormulaOp::kTorque ||
                        op == FormulaOp::kDirection || op == FormulaOp::kTravel;
  if (taken > 0) code.push_back(literal);
  while (code.size() +
             static_cast<std::size_t>(std::max(taken, taken == 0 && !code.empty() ? 2 : 1)) <=
         length) {
    for (int k = 1; k < taken; ++k) code.push_back(literal);
    const bool first = code.empty();
    code.push_back(format::instruction(op, of_joint ? last : 0));
    if (taken == 0 && !first) code.push_back(format::instruction(FormulaOp::kMin));
  }
  if (op == FormulaOp::kTemperature)
    one.context.push_back({format::ContextInput::kTemperature, "t0", 20.0});
  for (int k = 0; k < std::stoi(words[3]); ++k) model.effects.push_back(one);
}

/// A tree whose nodes stand in a row, a leaf at each.
void comb(format::Tree& tree) {
  const int nodes = static_cast<int>(tree.nodes.size());
  for (int i = 0; i < nodes; ++i) {
    auto& node = tree.nodes[static_cast<std::size_t>(i)];
    node.high = static_cast<std::int16_t>(~i);
    node.low = static_cast<std::int16_t>(i + 1 < nodes ? i + 1 : ~nodes);
  }
  tree.depth = static_cast<std::uint16_t>(nodes);
}

void add_trees(const Words& words, format::Model& model) {
  if (words.size() != 5) fail("tree=K:L:D:R:A");
  const bool blended = words[0] == "blended" || words[0] == "both";
  const int leaves = std::stoi(words[1]);
  const test::TreeKind kind{.inputs = static_cast<int>(model.nominal.joints.size()),
                            .leaves = std::abs(leaves),
                            .degree = std::stoi(words[2]),
                            .oblique = words[0] == "oblique" || words[0] == "both",
                            .region = words[3] == "1",
                            .narrowest = blended ? 1.9 : 0.0,
                            .widest = blended ? 2.0 : 0.0};
  tests::Random random(1);
  for (format::Tree& tree : model.trees) {
    if (words[4] == "1") random = tests::Random(1);
    tree = test::random_tree(random, kind);
    if (leaves < 0) comb(tree);
  }
}

void add_ranges(int count, format::Model& model) {
  for (int k = 0; k < count; ++k) {
    const bool load = k < static_cast<int>(format::kLoadNames.size());
    model.domain.context.push_back(
        {.input = load ? format::ContextInput::kPayload : format::ContextInput::kTemperature,
         .name = load ? std::string(format::kLoadNames[static_cast<std::size_t>(k)])
                      : "t" + std::to_string(k - static_cast<int>(format::kLoadNames.size())),
         .low = -1e3,
         .high = 1e3});
  }
}

format::Model model_of(const std::string& line) {
  int joints = 6, slides = 0, ranges = 0;
  bool general = false;
  format::Model out;
  std::vector<std::pair<std::string, Words>> parts;
  std::istringstream in(line);
  for (std::string word; in >> word;) {
    const auto at = word.find('=');
    const std::string key = word.substr(0, at);
    const std::string value = at == std::string::npos ? "" : word.substr(at + 1);
    if (key == "joints")
      joints = std::stoi(value);
    else if (key == "slides")
      slides = std::stoi(value);
    else if (key == "ranges")
      ranges = std::stoi(value);
    else if (key == "general")
      general = true;
    else if (key == "pose")
      out.guard.corrects = format::Corrects::kPose;
    else
      parts.emplace_back(key, split(value));
  }
  out.nominal = chain_of(joints, slides, general, 0.0);
  out.calibrated = chain_of(joints, slides, general, 3e-4);
  out.domain.q_min.assign(static_cast<std::size_t>(joints), -3.0);
  out.domain.q_max.assign(static_cast<std::size_t>(joints), 3.0);
  for (const auto& [key, words] : parts) {
    if (key == "masses")
      tests::add_masses(out);
    else if (key == "effect")
      add_effects(words, out);
    else if (key == "formula")
      add_formulas(words, out);
    else if (key == "tree")
      add_trees(words, out);
    else
      fail("what is " + key + "?");
  }
  add_ranges(ranges, out);
  return out;
}

/// As the reader gives it back.
format::Model accepted(const format::Model& model, const std::string& line) {
  const auto bytes = format::write_model(model);
  auto found = format::read_model(bytes);
  if (const auto* error = std::get_if<format::ReadError>(&found)) fail(error->detail + ": " + line);
  auto& out = std::get<format::Model>(found);
  if (find_effect_fault(out).kind != EffectFault::Kind::kNone) fail("effects: " + line);
  return std::move(out);
}

CycleInput arriving(const Corrector& corrector, tests::Random& random, std::int64_t now_ns) {
  CycleInput out;
  const auto joints = static_cast<std::size_t>(corrector.nominal().joints());
  for (std::size_t j = 0; j < joints; ++j) out.q_commanded[j] = random.uniform(-2.5, 2.5);
  out.now_ns = now_ns;
  out.target = out.joints = Arrival::kArrived;
  out.X_BD = corrector.nominal().forward(std::span(out.q_commanded).first(joints));
  out.context.payload_kg = {3.0, 0.0};
  out.context.payload_com_m = {0.01, 0.02, 0.1};
  for (auto& reading : out.context.temperature_degC) reading = {30.0, 0.0};
  out.context.time_s = {100.0, 0.0};
  return out;
}

}  // namespace

/// Callgrind knows it by name. Called through a volatile pointer, so never inlined or cloned.
extern "C" double one_call(Cycle& cycle, const CycleInput& in) {
  return cycle.step(in).output.X_BC.p(0);
}

namespace {

double (*volatile counted_call)(Cycle&, const CycleInput&) = one_call;

void run(const std::string& line) {
  format::Model model = accepted(model_of(line), line);
#ifdef __AVX2__
  std::printf("%.0f\n", offline::bench::step_instructions(model));
#else
  std::printf("%.0f\n", offline::bench::baseline_instructions(model));
#endif
  const Corrector corrector(model);
  const auto loaded = LoadedModel::make(model);
  ModelSlot slot(*loaded);
  Cycle cycle(slot);
  tests::Random random(7);
  const auto period_ns = static_cast<std::int64_t>(1e9 * model.guard.cycle_s);
  volatile double sink = cycle.step(arriving(corrector, random, 0)).output.X_BC.p(0);
  sink = counted_call(cycle, arriving(corrector, random, period_ns));
  static_cast<void>(sink);
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) fail("usage: step_calls FILE");
  std::ifstream in(words[1]);
  for (std::string line; std::getline(in, line);) run(line);
  return in.eof() ? 0 : 2;
}

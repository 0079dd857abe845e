// SPDX-License-Identifier: Apache-2.0
// Runs a part of the cycle at random inputs, each time inside `one_call`, for count_cycle.
//   cycle_calls KIND COUNT SEED
// On the arm of the budget, six effects and 3 x 100 leaves: chain, predict, guard, cycle (predict
// and guard), correct, step (Cycle::step, everything arriving). uneven: the cycle with trees of
// uneven depth. nominal, effects, trees: predict on an arm with no more than that. planted_branch,
// planted_loop: the cycle with a cost that depends on the input.
#include <algorithm>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <string_view>
#include <utility>

#include "plumb/runtime/cycle.hpp"
#include "tests/rt/gate_arms.hpp"

namespace {

using namespace plumb;

struct Input {
  std::array<double, 6> q{};
  Transformd X_BD;  // where the controller believes to be
  Context context;
  CycleInput all;  // of this, as it arrives
};

/// Everything a call may use, built before the first one.
struct Bench {
  explicit Bench(format::Model given)
      : model(std::move(given)),
        corrector(model),
        guard(model.guard),
        loaded(LoadedModel::make(model)),
        slot(*loaded),
        whole(slot) {}
  format::Model model;
  Corrector corrector;
  Guard guard;
  std::unique_ptr<const LoadedModel> loaded;
  ModelSlot slot;
  Cycle whole;
};

using Call = double (*)(Bench&, const Input&);

double chain(Bench& b, const Input& in) {
  return b.corrector.forward_model().chain().forward(in.q).p(0);
}

double predict(Bench& b, const Input& in) {
  return b.corrector.forward_model().predict(in.q, in.context).X_BT.p(0);
}

double guard(Bench& b, const Input& in) {
  Correction correction{.X_BC = in.X_BD, .status = Status::kOk};
  correction.X_BC.p(0) += 1e-4;
  return b.guard.step(in.X_BD, correction, b.model.guard.cycle_s).X_BC.p(0);
}

double cycle(Bench& b, const Input& in) {
  const Prediction arm = b.corrector.forward_model().predict(in.q, in.context);
  const Correction correction{.X_BC = arm.X_BT, .status = arm.status};
  return b.guard.step(in.X_BD, correction, b.model.guard.cycle_s).X_BC.p(0);
}

double correct(Bench& b, const Input& in) {
  return b.corrector.solve(in.X_BD, in.q, SeedKind::kCommanded, in.context).X_BC.p(0);
}

double step(Bench& b, const Input& in) { return b.whole.step(in.all).output.X_BC.p(0); }

double planted_branch(Bench& b, const Input& in) {
  const double x = cycle(b, in);
  return in.q[0] > 0.0 ? x + cycle(b, in) : x;
}

double planted_loop(Bench& b, const Input& in) {
  volatile double x = cycle(b, in);
  for (double y = in.q[1]; y > -3.0; y -= 0.1) x = x + y;
  return x;
}

}  // namespace

/// Callgrind knows it by name. Called through a volatile pointer, so never inlined or cloned.
extern "C" double one_call(Call call, Bench& bench, const Input& in) { return call(bench, in); }

namespace {

double (*volatile counted_call)(Call, Bench&, const Input&) = one_call;

format::Model without_trees(format::Model model) {
  model.trees = {};
  return model;
}

format::Model without_effects(format::Model model) {
  model.effects.clear();
  return model;
}

struct Kind {
  Call call;
  std::function<format::Model()> arm = tests::cycle_model;
};

const std::map<std::string_view, Kind>& kinds() {
  static const std::map<std::string_view, Kind> out{
      {"chain", {chain}},
      {"predict", {predict}},
      {"guard", {guard}},
      {"cycle", {cycle}},
      {"correct", {correct}},
      {"step", {step}},
      {"uneven", {cycle, tests::uneven_arm}},
      {"nominal", {predict, [] { return without_trees(without_effects(tests::cycle_model())); }}},
      {"effects", {predict, [] { return without_trees(tests::cycle_model()); }}},
      {"trees", {predict, [] { return without_effects(tests::cycle_model()); }}},
      {"planted_branch", {planted_branch}},
      {"planted_loop", {planted_loop}}};
  return out;
}

/// All of it new in cycle i.
CycleInput arriving(const Input& in, int i, double cycle_s) {
  CycleInput out;
  out.now_ns = static_cast<std::int64_t>(i * cycle_s * 1e9);
  out.target = out.joints = Arrival::kArrived;
  out.X_BD = in.X_BD;
  std::copy(in.q.begin(), in.q.end(), out.q_commanded.begin());
  out.context.payload_kg = {in.context.payload_kg, 0.0};
  out.context.payload_com_m = in.context.payload_com_m;
  for (std::size_t k = 0; k < in.context.temperature_degC.size(); ++k)
    out.context.temperature_degC[k] = {in.context.temperature_degC[k], 0.0};
  out.context.time_s = {in.context.time_s, 0.0};
  return out;
}

/// Cycle i: within the trained box, everything known of the context.
Input random_input(const Bench& bench, int i, tests::Random& random) {
  Input out;
  for (double& x : out.q) x = random.uniform(-3.0, 3.0);
  for (double& x : out.context.direction) x = random.below(2) == 0 ? -1.0 : 1.0;
  for (double& x : out.context.travel) x = random.uniform(0.0, 1.0);
  for (double& x : out.context.temperature_degC) x = random.uniform(15.0, 45.0);
  out.context.payload_kg = random.uniform(0.0, 10.0);
  out.context.payload_com_m = {0.01, 0.02, 0.1};
  out.context.time_s = random.uniform(0.0, 3600.0);
  out.X_BD = bench.corrector.nominal().forward(out.q);
  out.all = arriving(out, i, bench.model.guard.cycle_s);
  return out;
}

int run(const Kind& kind, int count, std::uint64_t seed) {
  Bench bench(kind.arm());
  tests::Random random(seed);
  volatile double sink = 0.0;
  // Not counted: the first step of all, which takes the joints up instead of following them.
  sink = kind.call(bench, random_input(bench, 0, random));
  for (int i = 1; i <= count; ++i) {
    const Input in = random_input(bench, i, random);
    sink = counted_call(kind.call, bench, in);
  }
  static_cast<void>(sink);
  return 0;
}

}  // namespace

int main(int count, char** words) {
  const auto kind = count == 4 ? kinds().find(words[1]) : kinds().end();
  if (kind == kinds().end()) {
    std::cerr << "usage: cycle_calls KIND COUNT SEED\n";
    return 2;
  }
  return run(kind->second, std::atoi(words[2]), std::strtoull(words[3], nullptr, 10));
}

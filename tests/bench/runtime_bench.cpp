// SPDX-License-Identifier: Apache-2.0
// The cycle and its parts beside KDL, in one run: quote ratios, not nanoseconds.
// scripts/bench-runtime prints them with their budgets. Each part three ways: warm (back to back),
// chain (each input waits for the output before), cold (one call after the caches were swept).
#include <benchmark/benchmark.h>

#include <deque>
#include <iostream>
#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <stdexcept>

#include "bench/cache_sweep.hpp"
#include "bench/cycle_kernels.hpp"
#include "bench/part_models.hpp"
#include "bench/stopwatch.hpp"
#include "plumb/format/reader.hpp"
#include "plumb/format/writer.hpp"
#include "tests/rt/cycle_model.hpp"

namespace plumb::offline::bench {
namespace {

constexpr int kJoints = 6;
constexpr std::uint64_t kSeed = 1;
constexpr std::size_t kBatch = 64;  // calls between two looks at the clock
constexpr double kSameness_m = 1e-12;
constexpr int kColdCalls = 200;  // in one repetition

const format::Model& model() {
  static const format::Model out = tests::cycle_model();
  return out;
}

const BenchInputs& inputs() {
  static const BenchInputs out(model(), kSeed);
  return out;
}

std::span<const double> joints(std::size_t i) {
  return std::span<const double>(inputs().pose(i).q).first(kJoints);
}

void forward_kinematics(benchmark::State& state) {
  const Chain chain(model().calibrated);
  for (std::size_t i = 0; auto _ : state) benchmark::DoNotOptimize(chain.forward(joints(i++)));
}
BENCHMARK(forward_kinematics);

KDL::Chain kdl_chain() {
  KDL::Chain out;
  for (const auto& row : model().calibrated.joints)
    out.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::RotZ),
                                KDL::Frame::DH(row.a, row.alpha, row.d, row.theta)));
  return out;
}

std::vector<KDL::JntArray> kdl_joints() {
  std::vector<KDL::JntArray> out;
  for (std::size_t i = 0; i < BenchInputs::kPoses; ++i) {
    KDL::JntArray q(kJoints);
    for (int k = 0; k < kJoints; ++k) q(k) = joints(i)[k];
    out.push_back(q);
  }
  return out;
}

/// A ratio is worth quoting only where both say the same.
void must_agree(const KDL::Frame& frame, const Transformd& X_BT) {
  const Vector3 p(frame.p.x(), frame.p.y(), frame.p.z());
  if (!((p - X_BT.p).norm() <= kSameness_m)) throw std::logic_error("KDL is elsewhere");
}

void forward_kinematics_kdl(benchmark::State& state) {
  const KDL::Chain chain = kdl_chain();  // the solver refers to it
  KDL::ChainFkSolverPos_recursive solver(chain);
  const auto q = kdl_joints();
  KDL::Frame frame;
  solver.JntToCart(q[0], frame);
  must_agree(frame, Chain(model().calibrated).forward(joints(0)));
  for (std::size_t i = 0; auto _ : state) {
    solver.JntToCart(q[i++ % q.size()], frame);
    benchmark::DoNotOptimize(frame);
  }
}
BENCHMARK(forward_kinematics_kdl);

/// From the bytes of a file to what the cycle runs.
void load_and_verify(benchmark::State& state) {
  const auto bytes = format::write_model(model());
  for (auto _ : state) {
    const auto read = format::read_model(std::span(bytes));
    const auto& sound = std::get<format::Model>(read);
    if (find_effect_fault(sound).kind != EffectFault::Kind::kNone)
      throw std::logic_error("the model of the benchmark cannot be run");
    benchmark::DoNotOptimize(Corrector(sound));
  }
  state.counters["bytes"] = static_cast<double>(bytes.size());
}
BENCHMARK(load_and_verify);

/// The whole forward model, then the guard: what the budget of the cycle is stated for.
std::unique_ptr<Kernel> predict_and_guard() {
  static const Corrector corrector(model());
  static Guard guard(model().guard);
  const auto call = [](std::size_t i, double link) {
    BenchPose pose = inputs().pose(i);
    pose.q[0] += 0.0 * link;
    const Prediction arm = corrector.forward_model().predict(
        std::span<const double>(pose.q).first(kJoints), inputs().context(i));
    const Correction correction{.X_BC = arm.X_BT, .status = arm.status};
    return guard.step(pose.X_BD, correction, model().guard.cycle_s).X_BC.p(0);
  };
  return std::make_unique<KernelOf<decltype(call)>>(call);
}

void run_coupled(benchmark::State& state, Kernel& kernel, Chaining chaining) {
  std::size_t i = 0;
  while (state.KeepRunningBatch(kBatch)) {
    benchmark::DoNotOptimize(kernel.run(i, kBatch, chaining));
    i += kBatch;
  }
}

void run_cold(benchmark::State& state, Kernel& kernel) {
  static CacheSweep caches;
  static const double clock_ns = clock_cost_ns();
  for (std::size_t i = 0; auto _ : state) {
    caches.sweep();
    const double begin = now_ns();
    benchmark::DoNotOptimize(kernel.run(i++, 1, Chaining::kFree));
    state.SetIterationTime(1e-9 * std::max(0.0, now_ns() - begin - clock_ns));
  }
}

void register_kernel(const std::string& name, Kernel& kernel) {
  for (const auto& [way, chaining] :
       {std::pair{"/warm", Chaining::kFree}, std::pair{"/chain", Chaining::kChained}})
    benchmark::RegisterBenchmark(
        (name + way).c_str(),
        [&kernel, how = chaining](benchmark::State& state) { run_coupled(state, kernel, how); });
  benchmark::RegisterBenchmark((name + "/cold").c_str(),
                               [&kernel](benchmark::State& state) { run_cold(state, kernel); })
      ->UseManualTime()
      ->Iterations(kColdCalls);
}

std::string title(const CycleKernel& kernel) {
  const std::string name = name_of(kernel.part);
  if (kernel.part == Part::kTrees) return name + ":100";
  return kernel.part == Part::kEffect ? name + ":" + kernel.label : name;
}

/// Everything that lives as long as the benchmarks.
class Registry {
 public:
  Registry() {
    for (const CycleKernel& kernel : whole_.all()) register_kernel(title(kernel), *kernel.kernel);
    register_only("correct_kinematics", Part::kCorrect, chain_alone(model()));
    for (const int leaves : {16, 1000})
      register_only("trees:" + std::to_string(leaves), Part::kPredict, with_leaves(leaves));
    register_kernel("predict_guard", *predict_guard_);
  }

 private:
  static format::Model with_leaves(int leaves) {
    format::Model out = chain_alone(model());
    for (auto& tree : out.trees) tree = tests::balanced_tree(leaves, kJoints);
    return out;
  }

  void register_only(const std::string& name, Part part, const format::Model& arm) {
    others_.emplace_back(arm, inputs());
    for (const CycleKernel& kernel : others_.back().all())
      if (kernel.part == part) register_kernel(name, *kernel.kernel);
  }

  CycleKernels whole_{model(), inputs()};
  std::deque<CycleKernels> others_;
  std::unique_ptr<Kernel> predict_guard_ = predict_and_guard();
};

int run(int argc, char** argv) {
  const Registry registry;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

}  // namespace
}  // namespace plumb::offline::bench

int main(int argc, char** argv) {
  try {
    return plumb::offline::bench::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << '\n';
    return 1;
  }
}

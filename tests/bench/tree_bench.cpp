// SPDX-License-Identifier: Apache-2.0
// Tree training and evaluation; scripts/bench-trees puts them beside their peers. Quote ratios.
//   bench_trees --data DIR     writes the training and test data as CSV for the peers
//   bench_trees [options of Google Benchmark]
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <stdexcept>

#include "plumb/runtime/detail/tree.hpp"
#include "plumb/runtime/forward_model.hpp"
#include "tests/bench/naive_tree.hpp"
#include "tests/bench/sample_trees.hpp"

namespace plumb::offline::bench {
namespace {

constexpr int kInputs = 1 << 16;  // more than a branch predictor learns by heart
constexpr int kFineSamples = 31;  // a leaf of the published trees on the fine grid
constexpr int kGlobalLeaves = 3300;
constexpr double kSameness = 1e-12;  // of two summation orders, share of the largest value

const Study& residual() {
  static const Study out = calibrated_arm();
  return out;
}

const Study& fine_positions() {
  static const Study out = positions(kFineStep);
  return out;
}

void report_errors(benchmark::State& state, const format::Tree& x, const format::Tree& y,
                   const Data& test) {
  const TreeView view_x(x, 2), view_y(y, 2);
  double sum = 0.0, worst = 0.0;
  for (Eigen::Index i = 0; i < test.u.rows(); ++i) {
    const SampleRow u(test.u, i);
    const double e = std::hypot(test.y(i, 0) - view_x.evaluate(u.span()),
                                test.y(i, 1) - view_y.evaluate(u.span()));
    sum += e;
    worst = std::max(worst, e);
  }
  state.counters["e_avg_m"] = sum / static_cast<double>(test.u.rows());
  state.counters["e_max_m"] = worst;
  state.counters["leaves"] = static_cast<double>(x.leaves());
}

void grow_crisp(benchmark::State& state) {
  const Data& train = residual().train;
  const GrowthSettings settings{.max_leaves = kStudyLeaves, .min_samples = 10};
  const auto grown = [&](int axis) { return grow(train.u, train.y.col(axis), settings); };
  for (auto _ : state) benchmark::DoNotOptimize(grown(0));
  report_errors(state, grown(0).cut(kStudyLeaves), grown(1).cut(kStudyLeaves), residual().test);
}
BENCHMARK(grow_crisp)->Unit(benchmark::kMillisecond);

void grow_blended(benchmark::State& state) {
  const Data& train = residual().train;
  for (auto _ : state) benchmark::DoNotOptimize(blended_trees(train));
  const auto trees = blended_trees(train);
  report_errors(state, trees[0], trees[1], residual().test);
}
BENCHMARK(grow_blended)->Unit(benchmark::kMillisecond)->UseRealTime();  // on all processors

void grow_fine(benchmark::State& state) {
  const Data& train = fine_positions().train;
  const GrowthSettings settings{.max_leaves = format::kMaxTreeLeaves, .min_samples = kFineSamples};
  const auto grown = [&](int axis) {
    const GrownTree tree = grow(train.u, train.y.col(axis), settings);
    return tree.cut(tree.leaves());
  };
  for (auto _ : state) benchmark::DoNotOptimize(grown(0));
  report_errors(state, grown(0), grown(1), fine_positions().test);
}
BENCHMARK(grow_fine)->Unit(benchmark::kMillisecond);

/// Argument: points a radian. The tree grows with n.
void grow_n(benchmark::State& state) {
  const RowsN q = planar_grid(1.0 / static_cast<double>(state.range(0)));
  const Data train = positions(q, q);
  const GrowthSettings settings{.max_leaves = format::kMaxTreeLeaves, .min_samples = kFineSamples};
  for (auto _ : state) benchmark::DoNotOptimize(grow(train.u, train.y.col(0), settings));
  state.counters["n"] = static_cast<double>(q.rows());
}
BENCHMARK(grow_n)->Arg(10)->Arg(20)->Arg(40)->Arg(70)->Arg(100)->Unit(benchmark::kMillisecond);

/// Alone in its process: the peak of memory is the process's.
void global_solve(benchmark::State& state) {
  const Data train = positions(kFineStep).train;
  GrowthSettings settings = kBlendedGrowth;
  settings.max_leaves = kGlobalLeaves;
  const GrownTree grown = grow(train.u, train.y.col(0), settings);
  const format::Tree tree = with_ramps(grown.cut(grown.leaves()), train.u, 1.0).value();
  for (auto _ : state) {
    const BlendedFit fit(tree, train.u);
    benchmark::DoNotOptimize(fit.solve(train.y.col(0), kStudyRidge));
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["peak_bytes"] = 1024.0 * static_cast<double>(usage.ru_maxrss);
  state.counters["leaves"] = static_cast<double>(tree.leaves());
}
BENCHMARK(global_solve)->Unit(benchmark::kMillisecond)->UseRealTime();

double largest_of(const std::vector<double>& values) {
  double out = 0.0;
  for (double x : values) out = std::max(out, std::abs(x));
  return out;
}

/// A time is worth quoting only where both say the same.
void must_agree(double ours, double reference, double largest) {
  if (!(std::abs(ours - reference) <= kSameness * largest))
    throw std::logic_error("the tree and its naive reference differ");
}

struct Crisp {
  std::array<format::Tree, 3> trees = crisp_trees();
  std::array<TreeView, 3> views;
  std::vector<NaiveTree> naive;
  std::vector<std::array<double, kSixJoints>> inputs = random_inputs<kSixJoints>(kInputs, 2);

  Crisp() {
    for (int axis = 0; axis < 3; ++axis) {
      views[axis] = TreeView(trees[axis], kSixJoints);
      naive.emplace_back(trees[axis], kSixJoints);
      for (const auto& u : inputs)
        must_agree(views[axis].evaluate(u), naive[axis].crisp(u), largest_of(trees[axis].bounds));
    }
  }

  int depth() const { return std::max({trees[0].depth, trees[1].depth, trees[2].depth}); }
};

const Crisp& crisp() {
  static const Crisp out;
  return out;
}

void crisp_evaluate(benchmark::State& state) {
  const Crisp& c = crisp();
  for (int i = 0; auto _ : state) {
    const auto& u = c.inputs[++i % kInputs];
    for (const TreeView& view : c.views) benchmark::DoNotOptimize(view.evaluate(u));
  }
  state.counters["depth"] = c.depth();
}
BENCHMARK(crisp_evaluate);

void crisp_evaluate_naive(benchmark::State& state) {
  const Crisp& c = crisp();
  for (int i = 0; auto _ : state) {
    const auto& u = c.inputs[++i % kInputs];
    for (const NaiveTree& tree : c.naive) benchmark::DoNotOptimize(tree.crisp(u));
  }
}
BENCHMARK(crisp_evaluate_naive);

/// As the cycle calls it: with the checks, the normalisation and the fade of the domain.
void crisp_tree_error(benchmark::State& state) {
  const format::Model model = crisp_model();
  const ForwardModel arm(model);
  for (int i = 0; auto _ : state)
    benchmark::DoNotOptimize(arm.tree_error(crisp().inputs[++i % kInputs]));
}
BENCHMARK(crisp_tree_error);

struct Blended {
  std::vector<format::Tree> trees = blended_trees(residual().train);
  TreeView view{trees[0], 2};
  NaiveTree naive{trees[0], 2};
  std::vector<std::array<double, 2>> inputs = random_inputs<2>(kInputs, 3);
  double active = 0.0;
  int most_active = 0;

  Blended() {
    const double largest = largest_of(trees[0].coefficients);
    ActiveLeaves<double> leaves;
    for (const auto& u : inputs) {
      must_agree(view.evaluate(u), naive.blended(u), largest);
      view.active<double>(u, leaves);
      active += static_cast<double>(leaves.count) / kInputs;
      most_active = std::max(most_active, leaves.count);
    }
  }
};

const Blended& blended() {
  static const Blended out;
  return out;
}

void blended_evaluate(benchmark::State& state) {
  const Blended& b = blended();
  for (int i = 0; auto _ : state)
    benchmark::DoNotOptimize(b.view.evaluate(b.inputs[++i % kInputs]));
  state.counters["leaves"] = static_cast<double>(b.trees[0].leaves());
  state.counters["active"] = b.active;
  state.counters["most_active"] = b.most_active;
}
BENCHMARK(blended_evaluate);

void blended_evaluate_naive(benchmark::State& state) {
  const Blended& b = blended();
  for (int i = 0; auto _ : state)
    benchmark::DoNotOptimize(b.naive.blended(b.inputs[++i % kInputs]));
}
BENCHMARK(blended_evaluate_naive);

/// Argument: 0 crisp, 1 blended; x and y of the study's 93-leaf trees, a time a pose.
void study_batch(benchmark::State& state) {
  const Data &train = residual().train, &test = residual().test;
  std::vector<format::Tree> trees = blended().trees;
  if (state.range(0) == 0)
    for (int axis = 0; axis < 2; ++axis)
      trees[axis] =
          grow(train.u, train.y.col(axis), {.max_leaves = kStudyLeaves}).cut(kStudyLeaves);
  const TreeView x(trees[0], 2), y(trees[1], 2);
  Eigen::Index i = 0;
  for (auto _ : state) {
    const SampleRow u(test.u, i);
    benchmark::DoNotOptimize(x.evaluate(u.span()));
    benchmark::DoNotOptimize(y.evaluate(u.span()));
    i = i + 1 < test.u.rows() ? i + 1 : 0;
  }
}
BENCHMARK(study_batch)->Arg(0)->Arg(1);

void write(const std::filesystem::path& path, const Data& data) {
  std::ofstream out(path);
  out << "u1,u2,x,y\n" << std::setprecision(17);
  for (Eigen::Index i = 0; i < data.u.rows(); ++i)
    out << data.u(i, 0) << ',' << data.u(i, 1) << ',' << data.y(i, 0) << ',' << data.y(i, 1)
        << '\n';
  if (!out.flush()) throw std::runtime_error("cannot write " + path.string());
}

void write_all(const std::filesystem::path& folder) {
  write(folder / "residual_train.csv", residual().train);
  write(folder / "residual_test.csv", residual().test);
  write(folder / "positions_train.csv", fine_positions().train);
  write(folder / "positions_test.csv", fine_positions().test);
}

int run(int argc, char** argv) {
  if (argc == 3 && std::string_view(argv[1]) == "--data") {
    write_all(argv[2]);
    return 0;
  }
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

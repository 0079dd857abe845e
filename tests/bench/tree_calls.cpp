// SPDX-License-Identifier: Apache-2.0
// Evaluates trees at random inputs, each time inside `one_call`, for count_instructions.
//   tree_calls crisp|naive|blended COUNT SEED
// crisp: three trees of 100 leaves over six joints, as the cycle calls them; naive: the same as
// pointers; blended: one tree of 93 leaves over two joints, the last input being the worst of many.
#include <cstdlib>
#include <iostream>
#include <string_view>

#include "plumb/runtime/forward_model.hpp"
#include "tests/bench/naive_tree.hpp"
#include "tests/bench/sample_trees.hpp"

namespace plumb::offline::bench {
namespace {

constexpr int kLooked = 200000;  // inputs, for the worst of the blended tree

ForwardModel arm;
std::vector<NaiveTree> pointers;
TreeView view;

using Call = double (*)(std::span<const double>);

double crisp(std::span<const double> u) { return arm.tree_error(u).sum(); }

double naive(std::span<const double> u) {
  return pointers[0].crisp(u) + pointers[1].crisp(u) + pointers[2].crisp(u);
}

double blended(std::span<const double> u) { return view.evaluate(u); }

}  // namespace

/// Never inlined, cloned or folded: callgrind knows it by name.
extern "C" [[gnu::noipa]] double one_call(Call call, std::span<const double> u) { return call(u); }

namespace {

template <int kInputs>
void call_all(Call call, const std::vector<std::array<double, kInputs>>& inputs) {
  volatile double sink = 0.0;
  for (const auto& u : inputs) sink = one_call(call, u);
  static_cast<void>(sink);
}

void call_crisp(Call call, int count, std::uint64_t seed) {
  const format::Model model = crisp_model();
  arm = ForwardModel(model);
  for (const auto& tree : model.trees) pointers.emplace_back(tree, kSixJoints);
  call_all<kSixJoints>(call, random_inputs<kSixJoints>(count, seed));
}

/// The input of many at which most leaves have a say.
std::array<double, 2> worst_input(std::uint64_t seed) {
  ActiveLeaves<double> leaves;
  std::array<double, 2> out{};
  int most = 0;
  for (const auto& u : random_inputs<2>(kLooked, seed)) {
    view.active<double>(u, leaves);
    if (leaves.count > most) out = u;
    most = std::max(most, leaves.count);
  }
  std::cout << "at most " << most << " leaves have a say\n";
  return out;
}

void call_blended(int count, std::uint64_t seed) {
  const format::Tree tree = blended_trees(calibrated_arm().train)[0];
  view = TreeView(tree, 2);
  auto inputs = random_inputs<2>(count - 1, seed);
  inputs.push_back(worst_input(seed + 1));
  call_all<2>(blended, inputs);
}

int run(std::string_view kind, int count, std::uint64_t seed) {
  if (kind == "blended")
    call_blended(count, seed);
  else if (kind == "crisp" || kind == "naive")
    call_crisp(kind == "crisp" ? crisp : naive, count, seed);
  else
    return 2;
  return 0;
}

}  // namespace
}  // namespace plumb::offline::bench

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  return plumb::offline::bench::run(argv[1], std::atoi(argv[2]),
                                    std::strtoull(argv[3], nullptr, 10));
}

// SPDX-License-Identifier: Apache-2.0
// The cycle's kernels beside their peers, in one run: quote ratios, not nanoseconds.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <vector>

#include "plumb/runtime/corrector.hpp"
#include "plumb/runtime/guard.hpp"

namespace plumb {
namespace {

constexpr int kJoints = 6;
constexpr int kPoses = 1024;
constexpr double kAlpha[] = {M_PI_2, 0, 0, M_PI_2, -M_PI_2, 0};
constexpr double kA[] = {0, -0.612, -0.5723, 0, 0, 0};
constexpr double kD[] = {0.1273, 0, 0, 0.163941, 0.1157, 0.0922};

using Pose6 = std::array<double, kJoints>;

std::vector<Pose6> poses() {
  std::vector<Pose6> out(kPoses);
  std::uint64_t state = 1;
  for (auto& q : out)
    for (double& x : q) {
      state = state * 6364136223846793005U + 1442695040888963407U;
      x = 0.3 + 2.0 * static_cast<double>(state >> 11) * 0x1.0p-53;
    }
  return out;
}

format::Chain ur10() {
  format::Chain chain;
  for (int i = 0; i < kJoints; ++i) {
    format::JointRow row;
    row.name = "J" + std::to_string(i + 1);
    row.alpha = kAlpha[i];
    row.a = kA[i];
    row.d = kD[i];
    row.q_min = -2 * M_PI;
    row.q_max = 2 * M_PI;
    chain.joints.push_back(row);
  }
  return chain;
}

/// A balanced tree over all joints.
format::Tree tree_of(int leaves) {
  format::Tree tree;
  for (int i = 0; i + 1 < leaves; ++i) {
    const auto child = [&](int k) {
      return static_cast<std::int16_t>(k < leaves - 1 ? k : ~(k - leaves + 1));
    };
    tree.nodes.push_back({.threshold = 0.1 * (i % 7) - 0.3,
                          .input = static_cast<std::uint16_t>(i % kJoints),
                          .low = child(2 * i + 1),
                          .high = child(2 * i + 2)});
  }
  for (int depth = 0, width = 1; width < leaves; width *= 2)
    tree.depth = static_cast<std::uint16_t>(++depth);
  tree.coefficients.assign(static_cast<std::size_t>(leaves) * (kJoints + 1), 1e-5);
  for (int i = 0; i < leaves; ++i) tree.bounds.insert(tree.bounds.end(), {-1e-4, 1e-4});
  return tree;
}

format::Model model_with(int leaves) {
  format::Model model;
  model.nominal = model.calibrated = ur10();
  for (int i = 0; i < kJoints; ++i) {
    model.calibrated.joints[i].alpha += 3e-4;
    model.calibrated.joints[i].a += 3e-4;
    model.domain.q_min.push_back(0.0);
    model.domain.q_max.push_back(3.0);
  }
  if (leaves > 0) model.trees.fill(tree_of(leaves));
  return model;
}

void forward_kinematics(benchmark::State& state) {
  const Chain chain(ur10());
  const auto q = poses();
  for (int i = 0; auto _ : state) benchmark::DoNotOptimize(chain.forward<double>(q[++i % kPoses]));
}
BENCHMARK(forward_kinematics);

void forward_kinematics_kdl(benchmark::State& state) {
  KDL::Chain chain;
  for (int i = 0; i < kJoints; ++i)
    chain.addSegment(
        KDL::Segment(KDL::Joint(KDL::Joint::RotZ), KDL::Frame::DH(kA[i], kAlpha[i], kD[i], 0.0)));
  KDL::ChainFkSolverPos_recursive solver(chain);
  std::vector<KDL::JntArray> q;
  for (const auto& pose : poses()) {
    KDL::JntArray one(kJoints);
    for (int k = 0; k < kJoints; ++k) one(k) = pose[k];
    q.push_back(one);
  }
  KDL::Frame frame;
  for (int i = 0; auto _ : state) {
    solver.JntToCart(q[++i % kPoses], frame);
    benchmark::DoNotOptimize(frame);
  }
}
BENCHMARK(forward_kinematics_kdl);

void predict(benchmark::State& state) {
  const format::Model model = model_with(static_cast<int>(state.range(0)));
  const ForwardModel arm(model);
  const auto q = poses();
  for (int i = 0; auto _ : state) benchmark::DoNotOptimize(arm.predict(q[++i % kPoses]));
}
BENCHMARK(predict)->ArgName("leaves")->Arg(0)->Arg(16)->Arg(100);

void correct(benchmark::State& state) {
  const format::Model model = model_with(0);
  const Corrector corrector(model);
  const auto q = poses();
  std::vector<Transformd> targets;
  for (const auto& pose : q) targets.push_back(corrector.nominal().forward<double>(pose));
  for (int i = 0; auto _ : state) {
    i = (i + 1) % kPoses;
    benchmark::DoNotOptimize(corrector.solve(targets[i], q[i], SeedKind::kCommanded));
  }
}
BENCHMARK(correct);

void guard_step(benchmark::State& state) {
  const format::Model model = model_with(0);
  const Corrector corrector(model);
  const auto q = poses();
  const Transformd target = corrector.nominal().forward<double>(q[0]);
  const Correction correction = corrector.solve(target, q[0], SeedKind::kCommanded);
  Guard guard(model.guard);
  for (auto _ : state) benchmark::DoNotOptimize(guard.step(target, correction, 0.004));
}
BENCHMARK(guard_step);

}  // namespace
}  // namespace plumb

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "plumb/format/model.hpp"
#include "plumb/runtime/context.hpp"
#include "plumb/runtime/transform.hpp"

namespace plumb::offline::bench {

/// A pose at random: joints, and where the controller believes the tool to be with them.
struct BenchPose {
  std::array<double, format::kMaxJoints> q{};  // [rad] or [m]
  Transformd X_BD;
};

/// The inputs with which the cycle is timed: the same for the same model and seed, wherever it
/// runs.
///
/// Poses are uniform within the joint limits and, where the model was trained, within its trained
/// domain; every value of the context is known. The inputs are few enough to stay in a cache, as
/// warm timings require.
class BenchInputs {
 public:
  static constexpr std::size_t kPoses = 1024;
  static constexpr std::size_t kContexts = 16;

  BenchInputs(const format::Model& model, std::uint64_t seed);

  /// Any i; they repeat.
  const BenchPose& pose(std::size_t i) const { return poses_[i % kPoses]; }
  const Context& context(std::size_t i) const { return contexts_[i % kContexts]; }

 private:
  std::vector<BenchPose> poses_;
  std::vector<Context> contexts_;
};

}  // namespace plumb::offline::bench

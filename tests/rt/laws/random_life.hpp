// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/runtime/guard.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::tests {

/// A model for one life: any chain of 1 to 9 joints or one that people own, calibrated near its
/// nominal or far from it, trees of any kind, up to three effects, limits over all their ranges.
format::Model random_arm_model(std::uint64_t seed);

/// What one cycle is given, and what is known of it.
struct CycleInput {
  std::array<double, kMaxJoints> q{};
  std::size_t joints = 0;  // how many of them are handed over: sometimes one too few
  Transformd X_BD;
  bool sound_target = true;
  SeedKind kind = SeedKind::kCommanded;
  Context context;
  double dt_s = 0.0;
  Guard::Inputs age = Guard::Inputs::kFresh;
  bool invents = false;  // the guard is given this instead of what solve() says:
  Correction invented;   // anything a caller could make up

  std::span<const double> seed() const { return std::span(q).first(joints); }
};

/// The inputs of one life: joint positions that wander and jump, targets that can be reached, that
/// cannot, and that are none; numbers that are no numbers everywhere.
class RandomInputs {
 public:
  RandomInputs(const Corrector& corrector, const format::Model& model, std::uint64_t seed);

  void next(CycleInput& out);

  /// A target that is a pose.
  Transformd sound_target();

  Random& random() { return random_; }

 private:
  void wander();
  Transformd target(bool& sound);
  void context(Context& out);
  Correction invented(const Transformd& X_BD);

  const Corrector& corrector_;
  const format::Model& model_;
  Random random_;
  std::array<double, kMaxJoints> q_{};
};

}  // namespace plumb::tests

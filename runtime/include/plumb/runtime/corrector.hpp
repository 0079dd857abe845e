// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "plumb/format/model.hpp"
#include "plumb/runtime/forward_model.hpp"

namespace plumb {

/// Where a seed comes from. More than six joints need the commanded ones.
enum class SeedKind : std::uint8_t { kCommanded, kLastSolution, kMeasured };

struct Correction {
  Transformd X_BC;                      // what to send to the controller: N(q); the target if refused
  std::array<double, kMaxJoints> q{};   // joint positions that bring the true arm to the target
  double residual_m = 0.0;              // remaining controllable error, position
  double residual_rad = 0.0;            // and orientation
  int steps = 0;                        // always kInverseSteps
  Status status = Status::kNoModel;
};

/// Inverse correction: the command x_c with T(N^-1(x_c)) = x_d.
///
/// The controller knows only its nominal chain N. From a seed q, kInverseSteps times
/// q <- q + J_N(q)^+ (x_d - T(q)), then x_c = N(q). A cell measured in position only corrects the
/// position; the orientation then stays the controller's own.
/// Fewer than six joints: the controllable part of the target. More: nearest to the seed.
///
/// Refused (Status < 0) when an input is not finite, the smallest singular value of the scaled
/// Jacobian is under its limit, the configuration differs from the seed's, |q - seed| exceeds its
/// limit, or the residual exceeds 1 um or 1 urad. Then X_BC is the target itself.
///
/// Pure: no state, no allocation, fixed cost for a given model, any thread.
/// Refers to the model's memory: the model must outlive it.
class Corrector {
 public:
  static constexpr int kInverseSteps = 8;
  static constexpr double kMaxResidual_m = 1e-6;
  static constexpr double kMaxResidual_rad = 1e-6;

  Corrector() = default;
  explicit Corrector(const format::Model& model) noexcept;

  const ForwardModel& forward_model() const noexcept { return true_arm_; }
  const Chain& nominal() const noexcept { return nominal_; }
  const format::GuardLimits& limits() const noexcept { return limits_; }

  /// Corrects the desired tool pose X_BD. seed: shape (n,), [rad] or [m].
  Correction solve(const Transformd& X_BD, std::span<const double> seed,
                   SeedKind kind) const noexcept;

 private:
  Chain nominal_;
  ForwardModel true_arm_;
  format::GuardLimits limits_{};
};

}  // namespace plumb

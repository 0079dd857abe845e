// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "plumb/format/model.hpp"
#include "plumb/runtime/forward_model.hpp"

namespace plumb {
namespace internal {
struct JointSteps;
struct TipMotion;
}  // namespace internal

/// Where a seed comes from. More than six joints need the commanded ones.
enum class SeedKind : std::uint8_t { kCommanded, kLastSolution, kMeasured };

struct Correction {
  Transformd X_BC;  // what to send to the controller: N(q); the target if refused
  std::array<double, kMaxJoints> q{};  // joint positions that bring the true arm to the target
  double residual_m = 0.0;             // remaining controllable error: position
  double residual_rad = 0.0;           // and orientation
  int steps = 0;                       // kInverseSteps, or kOtherSteps
  Status status = Status::kNoModel;
};

/// Inverse correction: the command x_c with T(N^-1(x_c)) = x_d.
///
/// The controller knows only its nominal chain N. From a seed q, a fixed number of steps
/// q <- q + J(q)^+ (x_d - T(q)), then x_c = N(q). A cell measured in position only corrects the
/// position; the orientation in T is then the controller's own, that of N(q).
/// J is the derivative of the calibrated chain, not of N: for the same price the steps converge
/// faster, also where J_N^+ is large.
///   six joints    kInverseSteps. All but the last also take back what the tip moves to the second
///                 order, which the columns of J tell, so that they converge cubically. The first
///                 takes J_N for J: its elimination also gives the sign of det J_N at the seed.
///                 Effects and tree are worked out at the seed and at the last two steps; in
///                 between those of the seed stand for them, and in the second step so does the
///                 turn from the true orientation to the controller's own
///   other arms    kOtherSteps of Newton. Effects and tree are worked out at the first, the fifth
///                 and the last. Fewer than six joints: the controllable part of the target,
///                 position before orientation. More: the shortest steps from the seed
///
/// Refused (Status < 0), the first of these that holds:
///   kNotFinite           an input is not finite, no rotation, or a joint beyond 1e4
///   kSeedNotCommanded    more than six joints, and the seed is not the commanded one
///   kNearSingular        at the solution the smallest singular value of J_N is under its limit;
///                        lengths are divided by length_scale_m. Fewer than six joints: the
///                        smallest that is not structurally zero, of J_N and of its position rows
///   kOtherConfiguration  six joints: det J_N has another sign at the solution than at the seed.
///                        Not defined for other arms
///   kFarFromSeed         |q_i - seed_i| exceeds max_seed_distance (sliding: times length_scale_m)
///   kNotConverged        before the last step the residual exceeded 1 um or 1 urad; six joints:
///                        or the tool was a quarter turn or more from its target
/// Then X_BC is the target itself (identity if that is no pose) and q the seed.
/// Joint limits are not looked at.
///
/// Pure: no state, no allocation, fixed cost for a given model, any thread.
/// Refers to the model's memory: the model must outlive it.
class Corrector {
 public:
  static constexpr int kInverseSteps = 5;
  static constexpr int kOtherSteps = 7;
  static constexpr double kMaxResidual_m = 1e-6;
  static constexpr double kMaxResidual_rad = 1e-6;

  Corrector() = default;
  explicit Corrector(const format::Model& model) noexcept;

  const ForwardModel& forward_model() const noexcept { return true_arm_; }
  const Chain& nominal() const noexcept { return nominal_; }
  const format::GuardLimits& limits() const noexcept { return limits_; }

  /// Corrects the desired tool pose X_BD. seed: shape (n,), [rad] or [m]. context: what is known
  /// now of direction, payload, temperatures; it stays the same over the steps.
  Correction solve(const Transformd& X_BD, std::span<const double> seed, SeedKind kind,
                   const Context& context = {}) const noexcept;

 private:
  struct Arm;
  struct Derivative;
  struct Iterate;
  struct Plan;
  enum class Stage : std::uint8_t { kSeed, kRough, kHeld, kTrue };
  enum class Order : std::uint8_t { kSecond, kThird };
  using JointPositions = std::array<double, kMaxJoints>;
  std::span<const Plan> steps() const noexcept;
  int joints() const noexcept { return nominal_.joints(); }
  void find_controllable(const format::Chain& nominal) noexcept;
  Status place(std::span<const double> q, Stage stage, Arm& arm, Transformd& X_BT,
               Derivative& out) const noexcept;
  void look(std::span<const double> q, Arm& arm, Derivative& out) const noexcept;
  void differentiate(const Chain& chain, const ChainAxes& moving, const ChainAxes& turning,
                     Derivative& out) const noexcept;
  internal::TipMotion towards(const Transformd& X_BD, const Transformd& X_BT,
                              bool& turned_far) const noexcept;
  void solution(const Derivative& at, const internal::TipMotion& r, internal::JointSteps& dq,
                internal::TipMotion& left) const noexcept;
  void general_solution(const Derivative& at, const internal::TipMotion& r,
                        internal::JointSteps& dq, internal::TipMotion& left) const noexcept;
  void step(const Derivative& at, const internal::TipMotion& r, Order order,
            Iterate& out) const noexcept;
  void advance(const Iterate& at, JointPositions& q) const noexcept;
  bool far(const JointPositions& q, const JointPositions& seed) const noexcept;
  Status judge(const Iterate& at, const JointPositions& q, const JointPositions& seed,
               const Derivative& N, int seed_sign) const noexcept;

  ForwardModel true_arm_;
  Chain nominal_;
  JointPositions unit_{};    // of the steps: 1 rad, or length_scale_m where a joint slides
  double per_length_ = 1.0;  // 1 / length_scale_m
  format::GuardLimits limits_{};
  int position_rank_ = 3;  // generic rank of the nominal Jacobian's position rows
  int pose_rank_ = 6;      // and of all its rows
};

}  // namespace plumb

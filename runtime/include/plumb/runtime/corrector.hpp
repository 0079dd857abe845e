// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "plumb/format/model.hpp"
#include "plumb/runtime/detail/known_range.hpp"
#include "plumb/runtime/forward_model.hpp"

namespace plumb {
namespace internal {
struct JointSteps;
struct TipMotion;
}  // namespace internal

/// Where the joint positions of a seed come from. An arm with more than six joints needs commanded
/// ones.
enum class SeedKind : std::uint8_t { kCommanded, kLastSolution, kMeasured };

struct Correction {
  Transformd X_BC;  // pose to send to the controller, N(q); the target itself if refused
  std::array<double, kMaxJoints> q{};  // joint positions that bring the true arm to the target
  /// Errors of position and orientation before the last step, as far as the arm can remove them.
  /// The last step leaves far less, which is not computed.
  double residual_m = 0.0, residual_rad = 0.0;
  int steps = 0;  // steps taken: kInverseSteps or kOtherSteps
  Status status = Status::kNoModel;
};

/// Inverse correction: the command x_c with T(N^-1(x_c)) = x_d.
///
/// The controller knows only its nominal chain N. From a seed q, a fixed number of steps
/// q <- q + J(q)^+ (x_d - T(q)), then x_c = N(q). A cell measured in position only corrects the
/// position; the orientation in T is then the controller's own, that of N(q).
/// J is the derivative of the calibrated chain, not of N: this costs the same and converges faster,
/// also where J_N^+ is large.
///   six joints    kInverseSteps steps. All but the last also subtract the second-order motion of
///                 the tip, which follows from the columns of J, so they converge cubically
///                 (Chebyshev's method). The first step uses J_N instead of J, because its
///                 elimination also gives the sign of det J_N at the seed. Effects and tree are
///                 evaluated at the seed and at the last two steps; the steps between use the
///                 values of the seed. The second step also uses the seed's rotation between the
///                 true orientation and the controller's
///   other arms    kOtherSteps steps of Newton's method. Effects and tree are evaluated at the
///                 first, the fifth and the last. Arms with fewer than six joints meet the part of
///                 the target that they can control, position before orientation; arms with more
///                 take the shortest steps from the seed
///
/// Near a singular pose a cell that corrects the position only would ask the controller for large
/// motions of its joints, or for a position out of reach. With six joints the part of the position
/// error that costs them is found at the seed, from J_N and its second order, and left as it is:
/// the component along the direction in which the joints move most, in the share that keeps the
/// motion below half of max_seed_distance and the square equation along it solvable. The status is
/// then kPartial. The error that is left is never larger than that at the seed; everywhere else the
/// share is nothing, and the result the same to the bit.
///
/// A target is refused (Status < 0) with the first of these that applies:
///   kNotFinite           an input is not finite, the target's matrix is no rotation, or a joint
///                        position exceeds 1e4
///   kSeedNotCommanded    the arm has more than six joints, and the seed is not commanded
///   kNearSingular        at the solution the smallest singular value of J_N is below its limit,
///                        with lengths divided by length_scale_m. Arms with fewer than six joints:
///                        the smallest that is not zero at every pose, of J_N or its position rows
///   kOtherConfiguration  det J_N has another sign at the solution than at the seed. Six joints
///                        only; not defined for other arms
///   kFarFromSeed         |q_i - seed_i| exceeds max_seed_distance (prismatic joints: times
///                        length_scale_m)
///   kNotConverged        before the last step the residual exceeded 1 um or 1 urad or, with six
///                        joints, the tool was a quarter turn or more from its target
/// X_BC is then the target itself (the identity if the target is no pose), and q is the seed.
/// Joint limits are not checked.
///
/// Outside the joint and context ranges that the model was fitted with (KnownRange), whether it has
/// a tree or not, the status is kOutsideDomain. A little beyond them the correction is unchanged;
/// farther out it fades smoothly to zero, where X_BC is the target.
///
/// Pure: no state, no allocation, fixed cost for a given model; callable from any thread.
/// Refers to the model's memory: the model must outlive it.
class Corrector {
 public:
  static constexpr int kInverseSteps = 5;  // of six joints
  static constexpr int kOtherSteps = 7;
  /// Chosen: far below the noise of any tracker. One more step makes them smaller by orders.
  static constexpr double kMaxResidual_m = 1e-6, kMaxResidual_rad = 1e-6;

  Corrector() = default;
  explicit Corrector(const format::Model& model) noexcept;

  const ForwardModel& forward_model() const noexcept { return true_arm_; }
  const Chain& nominal() const noexcept { return nominal_; }
  const format::GuardLimits& limits() const noexcept { return limits_; }

  /// Corrects the desired tool pose X_BD. seed: joint positions to start from, shape (n,), [rad] or
  /// [m]. context: what is known now about direction, payload and temperatures; it is the same for
  /// all steps.
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
  Vector3 uncorrected(const Vector3& error, const Derivative& at, bool& partial) const noexcept;
  bool settled(const Iterate& last, const Vector3& missed, double most2) const noexcept;
  void advance(const Iterate& at, JointPositions& q) const noexcept;
  bool far(const JointPositions& q, const JointPositions& seed) const noexcept;
  Status judge(const Iterate& at, const JointPositions& q, const JointPositions& seed,
               const Derivative& N, int seed_sign) const noexcept;

  void fade(const Transformd& X_BD, double weight, Transformd& X_BC) const noexcept;

  ForwardModel true_arm_;
  Chain nominal_;
  KnownRange known_;
  JointPositions unit_{};    // unit of each joint's step: 1 rad; length_scale_m if prismatic
  double per_length_ = 1.0;  // 1 / length_scale_m
  format::GuardLimits limits_{};
  int position_rank_ = 3;  // generic rank of the position rows of the nominal Jacobian
  int pose_rank_ = 6;      // generic rank of all its rows
};

}  // namespace plumb

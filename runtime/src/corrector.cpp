// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/corrector.hpp"

#include <algorithm>

#include "finite.hpp"
#include "priority_step.hpp"
#include "room.hpp"
#include "square_system.hpp"

namespace plumb {
namespace {

using internal::JointVector;
using internal::Vector6;

/// No joint moves farther in one step [rad]: near a singularity a full step would leave the
/// neighbourhood in which the linearisation means anything.
constexpr double kMaxStep = 0.25;

/// Position errors beyond it [m] are cut: the target is out of reach and the answer a refusal.
constexpr double kMaxError = 1e6;

/// Singular values below it at every sampled pose are structure (a planar arm's third axis),
/// also where rounded DH angles leave an axis 1e-4 rad out of parallel.
constexpr double kStructuralZero = 1e-3;
constexpr int kSamples = 64;

Vector3 clamped(const Vector3& v, double limit) noexcept {
  Vector3 out;
  for (int i = 0; i < 3; ++i) out(i) = std::clamp(v(i), -limit, limit);
  return out;
}

/// Point k of a Weyl sequence in (0, 1), one irrational step per joint.
double weyl(int k, int joint) noexcept {
  constexpr std::array<double, kMaxJoints> kStep{
      0.41421356237309505, 0.7320508075688772, 0.2360679774997898,
      0.6457513110645906,  0.3166247903553998, 0.605551275463989,
      0.12310562561766059, 0.358898943540674,  0.795831523312719};
  const double x = 0.5 + k * kStep[joint];
  return x - static_cast<int>(x);
}

double norm(const Vector3& v) noexcept { return portable::sqrt(dot(v, v)); }

}  // namespace

/// The step at one q.
struct Corrector::Iterate {
  JointVector dq;  // the full step from here, scaled
  double left_m;   // what that step moves: the controllable residual
  double left_rad;
  Status status;  // of the forward model
};

Corrector::Corrector(const format::Model& model) noexcept
    : nominal_(model.nominal),
      true_arm_(model),
      limits_(model.guard),
      per_length_(1.0 / model.guard.length_scale_m) {
  if (joints() < 6) find_controllable(model.nominal);
}

void Corrector::find_controllable(const format::Chain& nominal) noexcept {
  position_rank_ = 0;
  pose_rank_ = 0;
  JointPositions q{};
  ChainFrames frames;
  Jacobian J;
  for (int k = 0; k < kSamples; ++k) {
    for (int i = 0; i < joints(); ++i) {
      const auto& row = nominal.joints[i];
      const bool limited = row.q_max > row.q_min;
      const double low = limited ? row.q_min : -3.0, high = limited ? row.q_max : 3.0;
      q[i] = low + weyl(k, i) * (high - low);
    }
    nominal_.frames(q, frames);
    scaled_jacobian(nominal_, frames, J);
    const auto rank = internal::rank_above(kStructuralZero, internal::gram(J, joints()));
    position_rank_ = std::max(position_rank_, rank.position);
    pose_rank_ = std::max(pose_rank_, rank.pose);
  }
}

void Corrector::scaled_jacobian(const Chain& chain, const ChainFrames& frames,
                                Jacobian& out) const noexcept {
  jacobian(chain, frames, out);
  for (int k = 0; k < joints(); ++k) {
    const double per_length = nominal_.revolute(k) ? per_length_ : 1.0;
    for (int i = 0; i < 3; ++i) out(i, k) *= per_length;
  }
}

/// What was found at one q and stands for what it would be at those near by.
struct Corrector::Held {
  Deviation deviation;
  Matrix3 to_own;  // from the true orientation to the controller's own
};

/// Where the arm is and how it moves, near q.
struct Corrector::Arm {
  internal::Room<ChainFrames> moving;   // of the calibrated chain
  internal::Room<ChainFrames> nominal;  // of the controller's, where the rotation is its own
  const ChainFrames* turning;           // the one of both whose axes turn the pose
  Transformd X_BT;
  Status status;
};

/// The pose that is corrected. Position-only cells: the orientation is the controller's own;
/// between the seed and step kHeldSteps it is turned from the true one as it was at the seed.
void Corrector::place(std::span<const double> q, Detail detail, Held& held,
                      Arm& out) const noexcept {
  const Prediction arm = true_arm_.predict(q, held.deviation, out.moving.value);
  out.status = arm.status;
  out.X_BT = arm.X_BT;
  out.turning = &out.moving.value;
  if (limits_.corrects == format::Corrects::kPose) return;
  if (detail == Detail::kRough) {
    out.X_BT.R = product(held.to_own, arm.X_BT.R);
    return;
  }
  nominal_.frames(q, out.nominal.value);
  out.X_BT.R = out.nominal.value.tip.R;
  out.turning = &out.nominal.value;
  held.to_own = times_transposed<double>(out.X_BT.R, arm.X_BT.R);
}

/// Derivative for arms of other than six joints. Position-only cells: the rotation is the nominal
/// chain's, whose structural zeros count.
void Corrector::derivative(const Arm& arm, Jacobian& J) const noexcept {
  scaled_jacobian(true_arm_.chain(), arm.moving.value, J);
  if (limits_.corrects == format::Corrects::kPose) return;
  Jacobian J_N;
  scaled_jacobian(nominal_, *arm.turning, J_N);
  J.bottomRows<3>() = J_N.bottomRows<3>();
}

void Corrector::linearise(const Transformd& X_BD, const JointPositions& q, Detail detail,
                          Held& held, Iterate& out) const noexcept {
  const std::span<const double> at = std::span(q).first(static_cast<std::size_t>(joints()));
  Arm arm;
  place(at, joints() == 6 ? detail : Detail::kExact, held, arm);
  out.status = arm.status;
  Vector6 r;
  r.head<3>() = clamped(X_BD.p - arm.X_BT.p, kMaxError) * per_length_;
  r.tail<3>() = rotation_vector(times_transposed<double>(X_BD.R, arm.X_BT.R));
  if (joints() == 6)
    step_of_six(arm, r, out);
  else
    step_of_others(arm, r, out);
}

void Corrector::step_of_six(const Arm& arm, const Vector6& r, Iterate& out) const noexcept {
  internal::SquareSystem J(true_arm_.chain(), arm.moving.value, *arm.turning, per_length_);
  J.eliminate();
  Vector6 left;
  out.dq.head<6>() = J.solve(r, left);
  measure(r - left, out);
}

void Corrector::step_of_others(const Arm& arm, const Vector6& r, Iterate& out) const noexcept {
  Jacobian J;
  derivative(arm, J);
  out.dq = joints() < 6 ? internal::priority_step(J, {position_rank_, pose_rank_}, r)
                        : internal::minimum_norm_step(J, joints(), r);
  Vector6 moved = Vector6::Zero();
  for (int k = 0; k < joints(); ++k)
    for (int i = 0; i < 6; ++i) moved(i) += J(i, k) * out.dq(k);
  measure(moved, out);
}

/// moved: what the step moves, lengths in length_scale_m.
void Corrector::measure(const Vector6& moved, Iterate& out) const noexcept {
  out.left_m = norm(moved.head<3>()) * limits_.length_scale_m;
  out.left_rad = norm(moved.tail<3>());
}

void Corrector::advance(const Iterate& at, JointPositions& q) const noexcept {
  double largest = kMaxStep;
  for (int i = 0; i < joints(); ++i) largest = std::max({largest, at.dq(i), -at.dq(i)});
  const double share = kMaxStep / largest;
  for (int i = 0; i < joints(); ++i) q[i] += share * at.dq(i) * unit(i);
}

bool Corrector::far(const JointPositions& q, const JointPositions& seed) const noexcept {
  bool out = false;
  for (int i = 0; i < joints(); ++i) {
    const double limit = limits_.max_seed_distance * unit(i);
    out = out || q[i] - seed[i] > limit || seed[i] - q[i] > limit;
  }
  return out;
}

/// The controller's own arm at q.
struct Corrector::Nominal {
  internal::Room<ChainFrames> room;
  int sign = 1;  // of det J_N; arms of other than six joints have none
};

Status Corrector::judge(const Iterate& at, const JointPositions& q, const JointPositions& seed,
                        const Nominal& N, int seed_sign) const noexcept {
  if (refused(at.status)) return at.status;
  Jacobian J_N;
  scaled_jacobian(nominal_, N.room.value, J_N);
  const auto rank = internal::rank_above(limits_.min_singular_value, internal::gram(J_N, joints()));
  if (rank.position < position_rank_ || rank.pose < pose_rank_) return Status::kNearSingular;
  if (N.sign != seed_sign) return Status::kOtherConfiguration;
  if (far(q, seed)) return Status::kFarFromSeed;
  if (!(at.left_m <= kMaxResidual_m && at.left_rad <= kMaxResidual_rad))
    return Status::kNotConverged;
  return at.status;
}

void Corrector::look(const JointPositions& q, Nominal& out) const noexcept {
  nominal_.frames(std::span(q).first(static_cast<std::size_t>(joints())), out.room.value);
  if (joints() != 6) return;
  internal::SquareSystem J(nominal_, out.room.value, out.room.value, per_length_);
  J.eliminate();
  out.sign = J.determinant_sign();
}

Correction Corrector::solve(const Transformd& X_BD, std::span<const double> seed, SeedKind kind,
                            const Context& context) const noexcept {
  Correction out;
  if (joints() == 0) return out;
  const auto n = static_cast<std::size_t>(joints());
  const bool pose = internal::is_pose(X_BD);
  const bool state = seed.size() >= n && internal::is_joint_state(seed.first(n));
  if (pose) out.X_BC = X_BD;
  if (state) std::copy_n(seed.begin(), n, out.q.begin());

  // An unusable input costs as much as a good one: its stand-in is solved and the answer dropped.
  JointPositions q = out.q;
  Nominal N;
  look(q, N);
  const int seed_sign = N.sign;
  Iterate at;
  Held held;
  for (; out.steps < kInverseSteps; ++out.steps) {
    const bool rough = out.steps > 0 && out.steps + 1 < kHeldSteps;
    if (out.steps == 0 || out.steps == kHeldSteps || out.steps + 1 == kInverseSteps)
      held.deviation = true_arm_.deviation_at(std::span(q).first(n), context);
    linearise(out.X_BC, q, rough ? Detail::kRough : Detail::kExact, held, at);
    advance(at, q);
  }
  look(q, N);
  out.residual_m = at.left_m;
  out.residual_rad = at.left_rad;
  out.status = judge(at, q, out.q, N, seed_sign);
  if (joints() > 6 && kind != SeedKind::kCommanded) out.status = Status::kSeedNotCommanded;
  if (!pose || !state) out.status = Status::kNotFinite;
  if (refused(out.status)) return out;
  out.X_BC = N.room.value.tip;
  out.q = q;
  return out;
}

}  // namespace plumb

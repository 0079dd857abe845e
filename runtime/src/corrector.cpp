// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/corrector.hpp"

#include <algorithm>

#include "finite.hpp"
#include "priority_step.hpp"

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
    : nominal_(model.nominal), true_arm_(model), limits_(model.guard) {
  if (joints() < 6) find_controllable(model.nominal);
}

void Corrector::find_controllable(const format::Chain& nominal) noexcept {
  position_rank_ = 0;
  pose_rank_ = 0;
  JointPositions q{};
  ChainFrames<double> frames;
  Jacobian J;
  for (int k = 0; k < kSamples; ++k) {
    for (int i = 0; i < joints(); ++i) {
      const auto& row = nominal.joints[i];
      const bool limited = row.q_max > row.q_min;
      const double low = limited ? row.q_min : -3.0, high = limited ? row.q_max : 3.0;
      q[i] = low + weyl(k, i) * (high - low);
    }
    nominal_.frames<double>(q, frames);
    scaled_jacobian(nominal_, frames, J);
    const auto rank = internal::rank_above(kStructuralZero, internal::gram(J, joints()));
    position_rank_ = std::max(position_rank_, rank.position);
    pose_rank_ = std::max(pose_rank_, rank.pose);
  }
}

void Corrector::scaled_jacobian(const Chain& chain, const ChainFrames<double>& frames,
                                Jacobian& out) const noexcept {
  jacobian(chain, frames, out);
  const double inverse = 1.0 / limits_.length_scale_m;
  for (int k = 0; k < joints(); ++k) {
    const double per_length = nominal_.revolute(k) ? inverse : 1.0;
    for (int i = 0; i < 3; ++i) out(i, k) *= per_length;
  }
}

/// Position-only cells: the orientation stays the controller's own, in residual and derivative.
Transformd Corrector::corrected_pose(std::span<const double> q, const Deviation& deviation,
                                     Jacobian& J, Status& status) const noexcept {
  ChainFrames<double> frames;
  const Prediction arm = true_arm_.predict(q, deviation, frames);
  status = arm.status;
  scaled_jacobian(true_arm_.chain(), frames, J);
  if (limits_.corrects == format::Corrects::kPose) return arm.X_BT;
  nominal_.frames<double>(q, frames);
  Jacobian J_N;
  scaled_jacobian(nominal_, frames, J_N);
  J.bottomRows<3>() = J_N.bottomRows<3>();
  return {.R = frames.tip.R, .p = arm.X_BT.p};
}

void Corrector::linearise(const Transformd& X_BD, const JointPositions& q,
                          const Deviation& deviation, Iterate& out) const noexcept {
  Jacobian J;
  const Transformd X_BT = corrected_pose(std::span(q).first(joints()), deviation, J, out.status);
  Vector6 r;
  r.head<3>() = clamped(X_BD.p - X_BT.p, kMaxError) / limits_.length_scale_m;
  r.tail<3>() = rotation_vector(times_transposed<double>(X_BD.R, X_BT.R));
  out.dq = joints() < 6 ? internal::priority_step(J, {position_rank_, pose_rank_}, r)
                        : internal::minimum_norm_step(J, joints(), r);
  Vector6 left = Vector6::Zero();
  for (int k = 0; k < joints(); ++k)
    for (int i = 0; i < 6; ++i) left(i) += J(i, k) * out.dq(k);
  out.left_m = norm(left.head<3>()) * limits_.length_scale_m;
  out.left_rad = norm(left.tail<3>());
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

Status Corrector::judge(const Iterate& at, const JointPositions& q, const JointPositions& seed,
                        const Jacobian& J_N, int seed_sign) const noexcept {
  if (refused(at.status)) return at.status;
  const auto rank = internal::rank_above(limits_.min_singular_value, internal::gram(J_N, joints()));
  if (rank.position < position_rank_ || rank.pose < pose_rank_) return Status::kNearSingular;
  if (joints() == 6 && internal::determinant_sign(J_N) != seed_sign)
    return Status::kOtherConfiguration;
  if (far(q, seed)) return Status::kFarFromSeed;
  if (!(at.left_m <= kMaxResidual_m && at.left_rad <= kMaxResidual_rad))
    return Status::kNotConverged;
  return at.status;
}

Transformd Corrector::nominal_pose(const JointPositions& q, Jacobian& J_N) const noexcept {
  ChainFrames<double> frames;
  nominal_.frames<double>(std::span(q).first(joints()), frames);
  scaled_jacobian(nominal_, frames, J_N);
  return frames.tip;
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
  Jacobian J_N;
  nominal_pose(q, J_N);
  const int seed_sign = internal::determinant_sign(J_N);
  Iterate at;
  Deviation deviation;
  for (; out.steps < kInverseSteps; ++out.steps) {
    if (out.steps == 0 || out.steps >= kHeldSteps)
      deviation = true_arm_.deviation_at(std::span(q).first(n), context);
    linearise(out.X_BC, q, deviation, at);
    advance(at, q);
  }
  const Transformd X_BC = nominal_pose(q, J_N);
  out.residual_m = at.left_m;
  out.residual_rad = at.left_rad;
  out.status = judge(at, q, out.q, J_N, seed_sign);
  if (joints() > 6 && kind != SeedKind::kCommanded) out.status = Status::kSeedNotCommanded;
  if (!pose || !state) out.status = Status::kNotFinite;
  if (refused(out.status)) return out;
  out.X_BC = X_BC;
  out.q = q;
  return out;
}

}  // namespace plumb

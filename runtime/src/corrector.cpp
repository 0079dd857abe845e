// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/corrector.hpp"

#include <algorithm>

#include "finite.hpp"
#include "lane_order.hpp"
#include "lanes.hpp"
#include "normal_equations.hpp"
#include "pose_lanes.hpp"
#include "priority_step.hpp"
#include "square_system.hpp"
#include "uninitialised.hpp"

namespace plumb {
namespace {

using internal::JointSteps;
using internal::TipMotion;
using internal::Vector6;

/// No joint moves farther in one step [rad]: near a singularity a full step would leave the
/// neighbourhood in which the linearisation means anything.
constexpr double kMaxStep = 0.35;

/// The second-order correction of a step is limited to this [rad], beyond which it is no longer
/// valid either. Of the pairs of limits tried, these two refuse the fewest targets near a
/// singularity.
constexpr double kMaxBack = 0.125;

/// Position errors [m] are clamped to this. The target then is out of reach and will be refused.
constexpr double kMaxError = 1e6;

/// Singular values that are smaller than this at every sampled pose follow from the structure of
/// the arm, such as the third direction of a planar arm. The bound also covers axes that rounded DH
/// angles leave 1e-4 rad out of parallel.
constexpr double kStructuralZero = 1e-3;
constexpr int kSamples = 64;  // poses; one that is regular is enough

/// Near a singular pose the correction of a position alone may move the joints by this share of
/// max_seed_distance, by the linearisation at the seed. Some room is left for what it neglects.
constexpr double kShareOfDistance = 0.5;

/// The largest ratio of a step's second-order part to the step where the two are opposed: beyond
/// 1/4 a quadratic equation has no solution, so that the target is out of reach.
constexpr double kMostOpposed = 0.2;

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

double length(const Lanes& v) noexcept {
  return portable::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/// Shortens dq until no joint moves farther than `most`, all in the same proportion.
void limit(JointSteps& dq, double most) noexcept {
  Packed farthest{};
  for (std::size_t i = 0; i < dq.size(); i += kPackedLanes) {
    const Packed x = load(&dq[i]);
    farthest = x > farthest ? x : farthest;
    farthest = -x > farthest ? -x : farthest;
  }
  double largest = most;
  for (std::size_t lane = 0; lane < kPackedLanes; ++lane)
    largest = std::max(largest, farthest[lane]);
  const double share = most / largest;
  for (double& x : dq) x *= share;
}

}  // namespace

/// Working memory of a solve: the states of both arms.
struct Corrector::Arm {
  internal::Uninitialised<ChainAxes> moving;   // of the calibrated chain
  internal::Uninitialised<ChainAxes> nominal;  // of the controller's
  internal::Uninitialised<EffectSet::Workspace> workspace;
  internal::Uninitialised<Deviation> deviation;  // the one found last
  Matrix3 to_own;  // from the true orientation to the controller's own
};

/// One step of the plan: where effects and frames come from, and the order of convergence.
struct Corrector::Plan {
  Stage stage;
  Order order;
};

inline std::span<const Corrector::Plan> Corrector::steps() const noexcept {
  using enum Stage;
  using enum Order;
  static constexpr std::array<Plan, kInverseSteps> kSix{
      {{kSeed, kThird}, {kRough, kThird}, {kHeld, kThird}, {kTrue, kThird}, {kTrue, kSecond}}};
  static constexpr std::array<Plan, kOtherSteps> kOthers{{{kSeed, kSecond},
                                                          {kHeld, kSecond},
                                                          {kHeld, kSecond},
                                                          {kHeld, kSecond},
                                                          {kTrue, kSecond},
                                                          {kHeld, kSecond},
                                                          {kTrue, kSecond}}};
  if (joints() == 6) return kSix;
  return kOthers;
}

/// The Jacobian at the present pose, and its elimination.
struct Corrector::Derivative {
  internal::ScaledJacobian J;
  internal::SquareSystem square;  // of J; arms of six joints only
};

/// A step, and the part of the error that the full step removes.
struct Corrector::Iterate {
  JointSteps dq;
  double left_m;  // what the full step moves: the controllable residual
  double left_rad;
};

Corrector::Corrector(const format::Model& model) noexcept
    : true_arm_(model),
      nominal_(model.nominal),
      known_(model),
      per_length_(1.0 / model.guard.length_scale_m),
      limits_(model.guard) {
  unit_.fill(1.0);
  for (int i = 0; i < joints(); ++i)
    if (!nominal_.revolute(i)) unit_[i] = limits_.length_scale_m;
  if (joints() < 6) find_controllable(model.nominal);
}

void Corrector::find_controllable(const format::Chain& nominal) noexcept {
  position_rank_ = 0;
  pose_rank_ = 0;
  JointPositions q{};
  ChainAxes frames;
  internal::ScaledJacobian J;
  for (int k = 0; k < kSamples; ++k) {
    for (int i = 0; i < joints(); ++i) {
      const auto& row = nominal.joints[i];
      const bool limited = row.q_max > row.q_min;
      const double low = limited ? row.q_min : -3.0, high = limited ? row.q_max : 3.0;
      q[i] = low + weyl(k, i) * (high - low);
    }
    nominal_.frames(q, frames);
    J.set(nominal_, frames, frames, per_length_);
    const auto rank = internal::rank_above(kStructuralZero, internal::gram(J));
    position_rank_ = std::max(position_rank_, rank.position);
    pose_rank_ = std::max(pose_rank_, rank.pose);
  }
}

/// The pose that is corrected. In cells that correct the position only, its orientation is that of
/// the controller's own arm; in the rough steps it is obtained from the true orientation by the
/// rotation between the two at the seed.
inline Status Corrector::place(std::span<const double> q, Stage stage, Arm& arm, Transformd& X_BT,
                               Derivative& out) const noexcept {
  const bool position_only = limits_.corrects == format::Corrects::kPosition;
  const bool rough = stage == Stage::kRough;
  const bool at_seed = stage == Stage::kSeed;
  const bool own = position_only && !rough;
  ChainAxes &moving = arm.moving.value, &nominal = arm.nominal.value;
  Deviation& deviation = arm.deviation.value;
  if (at_seed || own) nominal_.frames(q, nominal);
  if (at_seed || stage == Stage::kTrue) true_arm_.find_deviation(q, arm.workspace.value, deviation);
  const Status status = true_arm_.locate(q, deviation, moving, X_BT.p);
  if (at_seed || !own) {
    const Matrix3 R = refused(status) ? moving.tip.R : true_arm_.turned(moving.tip.R, deviation);
    if (at_seed) arm.to_own = times_transposed<double>(nominal.tip.R, R);
    X_BT.R = position_only && rough ? product(arm.to_own, R) : R;
  }
  if (own) X_BT.R = nominal.tip.R;
  if (at_seed && joints() == 6)
    differentiate(nominal_, nominal, nominal, out);
  else
    differentiate(true_arm_.chain(), moving, own ? nominal : moving, out);
  return status;
}

/// Computes the Jacobian of the controller's own, nominal arm.
inline void Corrector::look(std::span<const double> q, Arm& arm, Derivative& out) const noexcept {
  ChainAxes& nominal = arm.nominal.value;
  nominal_.frames(q, nominal);
  differentiate(nominal_, nominal, nominal, out);
}

inline void Corrector::differentiate(const Chain& chain, const ChainAxes& moving,
                                     const ChainAxes& turning, Derivative& out) const noexcept {
  out.J.set(chain, moving, turning, per_length_);
  if (joints() == 6) out.square.eliminate(out.J);
}

/// The motion that takes the tip to its target. The rotation of six joints is the rotation vector
/// up to the eighth order of its angle t, by y = 1 - cos t: t = sin t (1 + y/3 + 2 y^2/15 + 2
/// y^3/35 + ..). Other arms may never reach the orientation and therefore need the exact rotation
/// vector.
inline TipMotion Corrector::towards(const Transformd& X_BD, const Transformd& X_BT,
                                    bool& turned_far) const noexcept {
  const Vector3 d = clamped(X_BD.p - X_BT.p, kMaxError) * per_length_;
  const Lanes translation{d(0), d(1), d(2), 0.0};
  turned_far = false;
  if (joints() != 6) {
    const Vector3 e = rotation_vector(times_transposed<double>(X_BD.R, X_BT.R));
    return {translation, Lanes{e(0), e(1), e(2), 0.0}};
  }
  Lanes sine{0.0, 0.0, 0.0, 0.0}, cosine = sine;
  for (std::size_t j = 0; j < 3; ++j) {
    const Lanes t = axis(X_BT, j), wanted = axis(X_BD, j);
    sine = sine + cross_turned(t, wanted);
    cosine = cosine + t * wanted;
  }
  const double y = 1.5 - 0.5 * (cosine[0] + cosine[1] + cosine[2]);
  turned_far = y >= 1.0;
  return {translation, turned(sine) * (0.5 + y * (1.0 / 6 + y * (1.0 / 15 + y * (1.0 / 35))))};
}

/// Solves J dq = r as far as the arm can move. left: the part of r that it cannot reach.
inline void Corrector::solution(const Derivative& at, const TipMotion& r, JointSteps& dq,
                                TipMotion& left) const noexcept {
  if (joints() == 6)
    at.square.solve(r, dq, left);
  else
    general_solution(at, r, dq, left);
}

void Corrector::general_solution(const Derivative& at, const TipMotion& r, JointSteps& dq,
                                 TipMotion& left) const noexcept {
  Vector6 b;
  b << r.translation[0], r.translation[1], r.translation[2], r.rotation[0], r.rotation[1],
      r.rotation[2];
  internal::JointVector x;
  if (joints() < 6) {
    Jacobian rows;
    at.J.copy_to(rows);
    x = internal::priority_step(rows, {position_rank_, pose_rank_}, b);
  } else {
    x = internal::minimum_norm_step(at.J, b);
  }
  dq = {};
  std::copy_n(x.data(), x.size(), dq.begin());
  left = r - at.J.times(dq);
}

// Newton's step dq solves J dq = r; along it the tip also moves by c, the curvature, to the second
// order. Chebyshev's step is dq - J^+ c: a residual leaves its third power instead of its second.
inline void Corrector::step(const Derivative& at, const TipMotion& r, Order order,
                            Iterate& out) const noexcept {
  TipMotion left;
  solution(at, r, out.dq, left);
  out.left_m = length(r.translation - left.translation) * limits_.length_scale_m;
  out.left_rad = length(r.rotation - left.rotation);
  limit(out.dq, kMaxStep);
  if (order == Order::kSecond) return;
  JointSteps back;
  solution(at, at.J.curvature(out.dq), back, left);
  limit(back, kMaxBack);
  for (std::size_t i = 0; i < back.size(); ++i) out.dq[i] -= back[i];
}

/// The part [m] of the position error at the seed that is left as it is, because the controller
/// would have to move its joints too far for its correction, or could not reach it. It is a share
/// of the component along the direction in which the joints move most for the error: at an ordinary
/// pose none of it, near a singular one up to all of it. Its removal is what the nominal arm does
/// for a translation without rotation.
inline Vector3 Corrector::uncorrected(const Vector3& error, const Derivative& at,
                                      bool& partial) const noexcept {
  std::array<Lanes, 6> A;
  at.square.joints_per_translation(A);
  const Lanes e = Lanes{error(0), error(1), error(2), 0.0} * per_length_;
  Lanes along{0.0, 0.0, 0.0, 0.0};
  JointSteps dq{}, back;
  double moved2 = 0.0, opposed = 0.0;
#pragma GCC unroll 6
  for (std::size_t j = 0; j < 6; ++j) {
    const Lanes x = A[j] * e;
    dq[j] = x[0] + x[1] + x[2];
    moved2 += dq[j] * dq[j];
    along = along + A[j] * dq[j];
  }
  TipMotion left;
  solution(at, at.J.curvature(dq), back, left);
#pragma GCC unroll 6
  for (std::size_t j = 0; j < 6; ++j) opposed += back[j] * dq[j];
  // The lesser of the two shares that are allowed. A quotient that is no number allows all.
  const double most = kShareOfDistance * limits_.max_seed_distance;
  const double near2 = std::min(1.0, most * most / moved2);
  const double within = std::min(1.0, kMostOpposed * moved2 / std::max(opposed, 0.0));
  const double share = std::min(portable::sqrt(near2), within);
  const Lanes squares = along * along;
  const double along2 = std::max(squares[0] + squares[1] + squares[2], 1e-300);
  const double taken = (1.0 - share) * (moved2 / along2) * limits_.length_scale_m;
  partial = share < 1.0;
  return Vector3(along[0] * taken, along[1] * taken, along[2] * taken);
}

/// Whether a correction in part may be sent: before the last step no more than most2 [m^2] was left
/// of the error, squared, and the last step, which has no second order, bends by micrometres at
/// most. By chance the steps can end where the calibrated arm itself is singular.
inline bool Corrector::settled(const Iterate& last, const Vector3& missed,
                               double most2) const noexcept {
  double moved2 = 0.0;
  for (const double x : last.dq) moved2 += x * x;
  return moved2 * limits_.length_scale_m <= 4.0 * kMaxResidual_m &&
         dot(missed, missed) <= most2 + kMaxResidual_m * kMaxResidual_m;
}

inline void Corrector::advance(const Iterate& at, JointPositions& q) const noexcept {
  for (std::size_t i = 0; i < q.size(); ++i) q[i] += at.dq[i] * unit_[i];
}

inline bool Corrector::far(const JointPositions& q, const JointPositions& seed) const noexcept {
  int beyond = 0;
  for (std::size_t i = 0; i < q.size(); ++i) {
    const double limit = limits_.max_seed_distance * unit_[i];
    beyond += static_cast<int>(q[i] - seed[i] > limit) + static_cast<int>(seed[i] - q[i] > limit);
  }
  return beyond > 0;
}

inline Status Corrector::judge(const Iterate& at, const JointPositions& q,
                               const JointPositions& seed, const Derivative& N,
                               int seed_sign) const noexcept {
  const auto rank = internal::rank_above(limits_.min_singular_value, internal::gram(N.J));
  const bool converged = at.left_m <= kMaxResidual_m && at.left_rad <= kMaxResidual_rad;
  const bool turned = joints() == 6 && N.square.determinant_sign() != seed_sign;
  // From the lowest priority to the highest, without branches, so that all cost the same.
  Status out = converged ? Status::kOk : Status::kNotConverged;
  out = far(q, seed) ? Status::kFarFromSeed : out;
  out = turned ? Status::kOtherConfiguration : out;
  const bool singular = rank.position < position_rank_ || rank.pose < pose_rank_;
  return singular ? Status::kNearSingular : out;
}

/// Kept out of line, because it is not needed inside the trained domain.
[[gnu::noinline]] void Corrector::fade(const Transformd& X_BD, double weight,
                                       Transformd& X_BC) const noexcept {
  const Vector3 e = rotation_vector(times_transposed<double>(X_BC.R, X_BD.R));
  X_BC.p = X_BD.p + (X_BC.p - X_BD.p) * weight;
  X_BC.R = product(rotation_of(e * weight), X_BD.R);
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

  // An invalid input costs as much as a valid one: a valid one is solved in its place and
  // discarded.
  JointPositions q = out.q;
  const auto here = std::span<const double>(q).first(n);
  Arm arm;
  Transformd X_BT;
  Derivative at;
  Iterate next;
  Transformd X_BG = out.X_BC;  // where the steps lead: to the target, or near a singular pose by it
  bool turned_far = false, partial = false;
  double most2 = 0.0;  // what is left may be no more than the error at the seed [m^2]
  int seed_sign = 0;
  unsigned lost = 0;  // 1 once the arm could not be predicted at a step
  true_arm_.prepare(context, arm.workspace.value);
  for (const auto& [stage, order] : steps()) {
    const Status found = place(here, stage, arm, X_BT, at);
    lost |= static_cast<unsigned>(refused(found));
    out.status = lost != 0 ? Status::kNotFinite : found;
    if (out.steps == 0 && n == 6) {
      seed_sign = at.square.determinant_sign();
      if (limits_.corrects == format::Corrects::kPosition) {
        const Vector3 error = X_BT.p - arm.nominal.value.tip.p;
        most2 = dot(error, error);
        X_BG.p += uncorrected(error, at, partial);
      }
    }
    step(at, towards(X_BG, X_BT, turned_far), order, next);
    advance(next, q);
    ++out.steps;
  }
  look(here, arm, at);
  if (turned_far) next.left_rad = kMaxStep;
  out.residual_m = next.left_m;
  out.residual_rad = next.left_rad;
  if (partial && !settled(next, X_BT.p - out.X_BC.p, most2)) next.left_m = kMaxError;
  const Status judged = judge(next, q, out.q, at, seed_sign);
  if (!refused(out.status) && judged != Status::kOk) out.status = judged;
  if (joints() > 6 && kind != SeedKind::kCommanded) out.status = Status::kSeedNotCommanded;
  if (!pose || !state) out.status = Status::kNotFinite;
  const KnownRange::Found found = known_.look(here, context);  // also if refused: equal cost
  if (refused(out.status)) return out;
  out.X_BC = arm.nominal.value.tip;
  out.q = q;
  if (partial) out.status = Status::kPartial;
  if (found.outside) {
    out.status = Status::kOutsideDomain;
    if (found.weight < 1.0) fade(X_BD, found.weight, out.X_BC);
  }
  return out;
}

}  // namespace plumb

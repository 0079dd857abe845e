// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/forward_model.hpp"

#include <algorithm>

#include "chain.hpp"
#include "crisp_trees.hpp"
#include "finite.hpp"
#include "trained_domain.hpp"
#include "turn.hpp"
#include "uninitialised.hpp"

namespace plumb {
namespace {

Prediction refusal() noexcept {
  return {.X_BT = {}, .tree_B = Vector3::Zero(), .status = Status::kNotFinite};
}

void clear(Motion<double>& out) noexcept {
  static_assert(sizeof out % sizeof(Lanes) == 0);
  const Lanes zeros{0.0, 0.0, 0.0, 0.0};
  auto* const bytes = reinterpret_cast<std::byte*>(&out);
  for (std::size_t i = 0; i < sizeof out; i += sizeof zeros) store(zeros, bytes + i);
}

const double* numbers(const Motion<double>& motion) noexcept {
  return reinterpret_cast<const double*>(&motion);
}

/// The displacement, and below the rotation, of the tip. The fourth lanes are arbitrary.
Lanes shift_B(const Motion<double>& motion) noexcept {
  static_assert(offsetof(Motion<double>, shift_B) == 9 * sizeof(double));
  return lanes(numbers(motion) + 9);
}
Lanes turn_B(const Motion<double>& motion) noexcept {
  static_assert(offsetof(Motion<double>, turn_B) == 12 * sizeof(double));
  return last_three(lanes(numbers(motion) + 11));
}

/// Writes the prediction in whole registers, each of which overwrites the end of the one before.
Prediction prediction(const Columns& X_BT, const Deviation& deviation) noexcept {
  static_assert(offsetof(Prediction, tree_B) == sizeof(Transformd) &&
                sizeof(Prediction) == sizeof(Transformd) + sizeof(Lanes));
  Prediction out;
  X_BT.store_over(out.X_BT);
  store(lanes(deviation.tree_B.data()),
        reinterpret_cast<std::byte*>(&out) + offsetof(Prediction, tree_B));
  out.status = deviation.status;
  return out;
}

}  // namespace

ForwardModel::ForwardModel(const format::Model& model) noexcept
    : effects_(model), domain_(model.domain), chain_(model.calibrated) {
  for (int axis = 0; axis < format::kTreeAxes; ++axis) {
    trees_[axis] = TreeView(model.trees[axis], chain_.joints());
    has_tree_ = has_tree_ || !trees_[axis].empty();
  }
  for (const TreeView& tree : trees_)
    if (!tree.empty() && walked_.empty()) walked_ = tree;
  all_crisp_ =
      std::all_of(trees_.begin(), trees_.end(), [](const TreeView& tree) { return tree.hard(); });
  if (all_crisp_) crisp_trees_ = CrispTrees(trees_);
  one_walk_ = std::all_of(trees_.begin(), trees_.end(), [&](const TreeView& tree) {
    return tree.empty() || tree.same_leaves(walked_);
  });
  six_crisp_trees_ = all_crisp_ && !one_walk_ && crisp_trees_.has_fast_path();
}

inline bool ForwardModel::acceptable(std::span<const double> q) const noexcept {
  const auto n = static_cast<std::size_t>(joints());
  return q.size() >= n && internal::is_joint_state(q.first(n));
}

Prediction ForwardModel::predict(std::span<const double> q, const Context& context) const noexcept {
  internal::Uninitialised<Deviation> found;
  Deviation& deviation = found.value;
  find_deviation(q, context, deviation);
  if (refused(deviation.status)) return refusal();
  const Chain::Walk walk(chain_);
  if (walk.has_fast_path()) {
    using internal::SixJoints;
    const SixJoints bent = SixJoints(q.data()) + SixJoints(deviation.motion.dq.data());
    if (!internal::is_joint_state(bent)) return refusal();
    return finished(walk.fast_path(bent, [](std::size_t, const Columns&) {}), deviation);
  }
  JointPositions bent;
  if (!bend(q, deviation, bent)) return refusal();
  return finished(Columns(chain_.forward(bent)), deviation);
}

Prediction ForwardModel::predict(std::span<const double> q, const Context& context,
                                 ChainFrames& frames) const noexcept {
  internal::Uninitialised<Deviation> deviation;
  find_deviation(q, context, deviation.value);
  JointPositions bent;
  if (!bend(q, deviation.value, bent)) {
    frames = ChainFrames{};
    return refusal();
  }
  chain_.frames(bent, frames);
  Prediction out = finished(Columns(frames.tip), deviation.value);
  frames.tip.R = out.X_BT.R;
  frames.tip.p = out.X_BT.p - out.tree_B;
  return out;
}

Status ForwardModel::locate(std::span<const double> q, const Deviation& deviation, ChainAxes& axes,
                            Vector3& p_BT) const noexcept {
  p_BT.setZero();
  JointPositions bent;
  if (!bend(q, deviation, bent)) {
    axes = ChainAxes{};
    return Status::kNotFinite;
  }
  chain_.frames(bent, axes);
  const Vector3 p = axes.tip.p + deviation.motion.shift_B;
  if (!internal::is_finite(p)) {
    axes.tip = Transformd{};
    return Status::kNotFinite;
  }
  const Vector3 tree_B(deviation.tree_B.data());
  p_BT = p + tree_B;
  axes.tip.p = p_BT - tree_B;
  return deviation.status;
}

Matrix3 ForwardModel::turned(const Matrix3& R_BT, const Deviation& deviation) const noexcept {
  if (effects_.empty()) return R_BT;
  Matrix3 out;
  (internal::Turn(deviation.turn_B) * R_BT).store(out);
  return out;
}

[[gnu::always_inline]] inline void ForwardModel::find_deviation(std::span<const double> q,
                                                                const Context& context,
                                                                Deviation& out) const noexcept {
  internal::Uninitialised<EffectSet::Workspace> workspace;
  prepare(context, workspace.value);
  deviate(q, workspace.value, out);
}

void ForwardModel::prepare(const Context& context, EffectSet::Workspace& out) const noexcept {
  if (!effects_.empty()) effects_.prepare(context, out);
}

void ForwardModel::find_deviation(std::span<const double> q, EffectSet::Workspace& workspace,
                                  Deviation& out) const noexcept {
  deviate(q, workspace, out);
}

[[gnu::always_inline]] inline void ForwardModel::deviate(std::span<const double> q,
                                                         EffectSet::Workspace& workspace,
                                                         Deviation& out) const noexcept {
  clear(out.motion);
  out.tree_B = {};
  out.status = Status::kOk;
  if (!acceptable(q)) {
    out.status = Status::kNotFinite;
    return;
  }
  if (has_tree_) add_tree(q, out);
  if (!effects_.empty()) add_effects(q, workspace, out);
}

inline void ForwardModel::add_effects(std::span<const double> q, EffectSet::Workspace& workspace,
                                      Deviation& out) const noexcept {
  const bool used_fallback = effects_.apply(q, chain_, workspace, out.motion);
  if (used_fallback && out.status == Status::kOk) out.status = Status::kContextFallback;
  const Lanes e = turn_B(out.motion);
  if (internal::three_within(e, internal::kMaxJointPosition))
    internal::turn(e).store(out.turn_B);
  else
    out.status = Status::kNotFinite;
}

[[gnu::always_inline]] inline void ForwardModel::add_tree(std::span<const double> q,
                                                          Deviation& out) const noexcept {
  if (tree_at(q, out.tree_B) < 1.0) out.status = Status::kOutsideDomain;
}

/// Adds the joint motions of the deviation to q. False if a joint position is impossible then.
inline bool ForwardModel::bend(std::span<const double> q, const Deviation& deviation,
                               JointPositions& out) const noexcept {
  const auto n = static_cast<std::size_t>(joints());
  if (refused(deviation.status) || q.size() < n) return false;
  const auto add = [&](std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) out[i] = q[i] + deviation.motion.dq[i];
  };
  if (n == 6)
    add(6);
  else
    add(n);
  return internal::is_joint_state(std::span<const double>(out).first(n));
}

/// The prediction from the pose X_BT of the chain. Refuses a pose that is not finite, because an
/// encoder scale can bring a joint beyond the domain of sin_cos.
inline Prediction ForwardModel::finished(const Columns& X_BT,
                                         const Deviation& deviation) const noexcept {
  const Lanes p = X_BT.p() + shift_B(deviation.motion);
  if (!internal::is_finite(p)) return refusal();
  const Lanes there = p + lanes(deviation.tree_B.data());
  if (effects_.empty()) return prediction({X_BT.x(), X_BT.y(), X_BT.z(), there}, deviation);
  const internal::Turn turn(deviation.turn_B);
  return prediction({turn * X_BT.x(), turn * X_BT.y(), turn * X_BT.z(), there}, deviation);
}

Vector3 ForwardModel::tree_error(std::span<const double> q) const noexcept {
  if (!has_tree_ || !acceptable(q)) return Vector3::Zero();
  Deviation::Column out;
  tree_at(q, out);
  return Vector3(out.data());
}

/// Evaluates the trees and returns their weight, with which the result is already multiplied.
[[gnu::always_inline]] inline double ForwardModel::tree_at(std::span<const double> q,
                                                           Deviation::Column& out) const noexcept {
  if (!six_crisp_trees_) return other_tree_at(q, out);
  alignas(32) std::array<double, 6> looked_up;
  internal::SixJoints u;
  const double weight = domain_.normalise(internal::SixJoints(q.data()), u);
  u.store(looked_up.data());
  crisp_trees_.evaluate(u, looked_up.data(), out);
  store(lanes(out.data()) * weight, out.data());
  return weight;
}

/// Kept out of line so that the fast path does not save registers for it.
[[gnu::noinline]] double ForwardModel::other_tree_at(std::span<const double> q,
                                                     Deviation::Column& out) const noexcept {
  std::array<double, kMaxJoints> u;
  const std::span<double> inputs = std::span(u).first(static_cast<std::size_t>(joints()));
  const double weight = domain_.normalise(q, inputs);
  trees_at(inputs, out);
  store(lanes(out.data()) * weight, out.data());
  return weight;
}

inline void ForwardModel::trees_at(std::span<const double> at,
                                   Deviation::Column& out) const noexcept {
  if (all_crisp_ && !one_walk_) return crisp_trees_.evaluate(at, out);
  if (!one_walk_) {
    out = {trees_[0].evaluate(at), trees_[1].evaluate(at), trees_[2].evaluate(at), 0.0};
    return;
  }
  ActiveLeaves<double> leaves;
  walked_.active(at, leaves);
  out = {trees_[0].evaluate(at, leaves), trees_[1].evaluate(at, leaves),
         trees_[2].evaluate(at, leaves), 0.0};
}

}  // namespace plumb

// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/forward_model.hpp"

#include <algorithm>

#include "chain_walk.hpp"
#include "finite.hpp"
#include "hard_walks.hpp"
#include "room.hpp"
#include "trained_domain.hpp"
#include "turn.hpp"

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

/// Of the tip; what is in the fourth lane means nothing.
Lanes shift_B(const Motion<double>& motion) noexcept {
  static_assert(offsetof(Motion<double>, shift_B) == 9 * sizeof(double));
  return lanes(numbers(motion) + 9);
}
Lanes turn_B(const Motion<double>& motion) noexcept {
  static_assert(offsetof(Motion<double>, turn_B) == 12 * sizeof(double));
  return last_three(lanes(numbers(motion) + 11));
}

/// By whole registers, each written over what ends the one before.
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
  all_hard_ =
      std::all_of(trees_.begin(), trees_.end(), [](const TreeView& tree) { return tree.hard(); });
  if (all_hard_) hard_trees_ = HardTrees(trees_);
  one_walk_ = std::all_of(trees_.begin(), trees_.end(), [&](const TreeView& tree) {
    return tree.empty() || tree.same_leaves(walked_);
  });
  six_hard_trees_ = all_hard_ && !one_walk_ && hard_trees_.usual();
}

inline bool ForwardModel::acceptable(std::span<const double> q) const noexcept {
  const auto n = static_cast<std::size_t>(joints());
  return q.size() >= n && internal::is_joint_state(q.first(n));
}

Prediction ForwardModel::predict(std::span<const double> q, const Context& context) const noexcept {
  internal::Room<Deviation> found;
  Deviation& deviation = found.value;
  find_deviation(q, context, deviation);
  if (refused(deviation.status)) return refusal();
  const Chain::Walk walk(chain_);
  if (walk.is_usual()) {
    using internal::SixJoints;
    const SixJoints bent = SixJoints(q.data()) + SixJoints(deviation.motion.dq.data());
    if (!internal::is_joint_state(bent)) return refusal();
    return finished(walk.usual(bent, [](std::size_t, const Columns&) {}), deviation);
  }
  JointPositions bent;
  if (!bend(q, deviation, bent)) return refusal();
  return finished(Columns(chain_.forward(bent)), deviation);
}

Prediction ForwardModel::predict(std::span<const double> q, const Context& context,
                                 ChainFrames& frames) const noexcept {
  internal::Room<Deviation> deviation;
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
  internal::Room<EffectSet::Scene> scene;
  prepare(context, scene.value);
  deviate(q, scene.value, out);
}

void ForwardModel::prepare(const Context& context, EffectSet::Scene& out) const noexcept {
  if (!effects_.empty()) effects_.prepare(context, out);
}

void ForwardModel::find_deviation(std::span<const double> q, EffectSet::Scene& scene,
                                  Deviation& out) const noexcept {
  deviate(q, scene, out);
}

[[gnu::always_inline]] inline void ForwardModel::deviate(std::span<const double> q,
                                                         EffectSet::Scene& scene,
                                                         Deviation& out) const noexcept {
  clear(out.motion);
  out.tree_B = {};
  out.status = Status::kOk;
  if (!acceptable(q)) {
    out.status = Status::kNotFinite;
    return;
  }
  if (has_tree_) add_tree(q, out);
  if (!effects_.empty()) add_effects(q, scene, out);
}

inline void ForwardModel::add_effects(std::span<const double> q, EffectSet::Scene& scene,
                                      Deviation& out) const noexcept {
  const bool stood_in = effects_.apply(q, chain_, scene, out.motion);
  if (stood_in && out.status == Status::kOk) out.status = Status::kContextFallback;
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

/// False: a joint is, or was moved, where no joint can be.
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

/// X_BT: of the chain. An encoder scale can still bring a joint beyond what sin_cos knows.
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

/// Returns how far the trees are trusted there; they are already weighed with it.
[[gnu::always_inline]] inline double ForwardModel::tree_at(std::span<const double> q,
                                                           Deviation::Column& out) const noexcept {
  if (!six_hard_trees_) return other_tree_at(q, out);
  alignas(32) std::array<double, 6> looked_up;
  internal::SixJoints u;
  const double weight = domain_.normalise(internal::SixJoints(q.data()), u);
  u.store(looked_up.data());
  hard_trees_.evaluate(u, looked_up.data(), out);
  store(lanes(out.data()) * weight, out.data());
  return weight;
}

/// Never inlined: what it needs would be saved on the usual way too.
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
  if (all_hard_ && !one_walk_) return hard_trees_.evaluate(at, out);
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

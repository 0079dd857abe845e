// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/forward_model.hpp"

#include <algorithm>

#include "finite.hpp"
#include "room.hpp"

namespace plumb {
namespace {

Prediction refusal() noexcept {
  return {.X_BT = {}, .tree_B = Vector3::Zero(), .status = Status::kNotFinite};
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
}

inline bool ForwardModel::acceptable(std::span<const double> q) const noexcept {
  const auto n = static_cast<std::size_t>(joints());
  return q.size() >= n && internal::is_joint_state(q.first(n));
}

Prediction ForwardModel::predict(std::span<const double> q, const Context& context) const noexcept {
  internal::Room<Deviation> deviation;
  find_deviation(q, context, deviation.value);
  JointPositions bent;
  if (!bend(q, deviation.value, bent)) return refusal();
  return finished(chain_.forward(bent), deviation.value);
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
  Prediction out = finished(frames.tip, deviation.value);
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
  p_BT = p + deviation.tree_B;
  axes.tip.p = p_BT - deviation.tree_B;
  return deviation.status;
}

Matrix3 ForwardModel::turned(const Matrix3& R_BT, const Deviation& deviation) const noexcept {
  return effects_.empty() ? R_BT : product(deviation.turn_B, R_BT);
}

inline void ForwardModel::find_deviation(std::span<const double> q, const Context& context,
                                         Deviation& out) const noexcept {
  internal::Room<EffectSet::Scene> scene;
  prepare(context, scene.value);
  find_deviation(q, scene.value, out);
}

void ForwardModel::prepare(const Context& context, EffectSet::Scene& out) const noexcept {
  if (!effects_.empty()) effects_.prepare(context, out);
}

void ForwardModel::find_deviation(std::span<const double> q, EffectSet::Scene& scene,
                                  Deviation& out) const noexcept {
  out.motion = {};
  out.tree_B.setZero();
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
  const Vector3& turn_B = out.motion.turn_B;
  if (internal::is_joint_state(std::span(turn_B.data(), 3)))
    out.turn_B = rotation_of(turn_B);
  else
    out.status = Status::kNotFinite;
}

inline void ForwardModel::add_tree(std::span<const double> q, Deviation& out) const noexcept {
  double weight = 1.0;
  out.tree_B = tree_at(q, weight);
  if (weight < 1.0) out.status = Status::kOutsideDomain;
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

/// An encoder scale can still bring a joint beyond what sin_cos knows.
inline Prediction ForwardModel::finished(const Transformd& X_BT,
                                         const Deviation& deviation) const noexcept {
  const Vector3 p = X_BT.p + deviation.motion.shift_B;
  if (!internal::is_finite(p)) return refusal();
  return {.X_BT = {.R = turned(X_BT.R, deviation), .p = p + deviation.tree_B},
          .tree_B = deviation.tree_B,
          .status = deviation.status};
}

Vector3 ForwardModel::tree_error(std::span<const double> q) const noexcept {
  if (!has_tree_ || !acceptable(q)) return Vector3::Zero();
  double weight = 1.0;
  return tree_at(q, weight);
}

/// `weight`: how far the trees are trusted there; they are already weighed with it.
inline Vector3 ForwardModel::tree_at(std::span<const double> q, double& weight) const noexcept {
  std::array<double, kMaxJoints> u;
  const std::span<double> inputs = std::span(u).first(static_cast<std::size_t>(joints()));
  weight = domain_.normalise(q, inputs);
  return trees_at(inputs) * weight;
}

inline Vector3 ForwardModel::trees_at(std::span<const double> at) const noexcept {
  if (all_hard_ && !one_walk_) {
    HardTrees::Values e;
    hard_trees_.evaluate(at, e);
    return {e[0], e[1], e[2]};
  }
  if (!one_walk_) return {trees_[0].evaluate(at), trees_[1].evaluate(at), trees_[2].evaluate(at)};
  ActiveLeaves<double> leaves;
  walked_.active(at, leaves);
  return {trees_[0].evaluate(at, leaves), trees_[1].evaluate(at, leaves),
          trees_[2].evaluate(at, leaves)};
}

}  // namespace plumb

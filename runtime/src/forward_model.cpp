// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/forward_model.hpp"

#include <algorithm>

#include "finite.hpp"

namespace plumb {
namespace {

Prediction refusal() noexcept {
  return {.X_BT = {}, .tree_B = Vector3::Zero(), .status = Status::kNotFinite};
}

}  // namespace

ForwardModel::ForwardModel(const format::Model& model) noexcept
    : chain_(model.calibrated), effects_(model), domain_(model.domain) {
  for (int axis = 0; axis < format::kTreeAxes; ++axis) {
    trees_[axis] = TreeView(model.trees[axis], chain_.joints());
    has_tree_ = has_tree_ || !trees_[axis].empty();
  }
  for (const TreeView& tree : trees_)
    if (!tree.empty() && walked_.empty()) walked_ = tree;
  all_hard_ =
      std::all_of(trees_.begin(), trees_.end(), [](const TreeView& tree) { return tree.hard(); });
  one_walk_ = std::all_of(trees_.begin(), trees_.end(), [&](const TreeView& tree) {
    return tree.empty() || tree.same_leaves(walked_);
  });
}

bool ForwardModel::acceptable(std::span<const double> q) const noexcept {
  const auto n = static_cast<std::size_t>(joints());
  return q.size() >= n && internal::is_joint_state(q.first(n));
}

Prediction ForwardModel::predict(std::span<const double> q, const Context& context) const noexcept {
  const Deviation deviation = deviation_at(q, context);
  JointPositions bent;
  if (!bend(q, deviation, bent)) return refusal();
  return finished(chain_.forward<double>(bent), deviation);
}

Prediction ForwardModel::predict(std::span<const double> q, const Context& context,
                                 ChainFrames<double>& frames) const noexcept {
  return predict(q, deviation_at(q, context), frames);
}

Prediction ForwardModel::predict(std::span<const double> q, const Deviation& deviation,
                                 ChainFrames<double>& frames) const noexcept {
  JointPositions bent;
  if (!bend(q, deviation, bent)) return refusal();
  chain_.frames<double>(bent, frames);
  Prediction out = finished(frames.tip, deviation);
  frames.tip.R = out.X_BT.R;
  frames.tip.p = out.X_BT.p - out.tree_B;
  return out;
}

Deviation ForwardModel::deviation_at(std::span<const double> q,
                                     const Context& context) const noexcept {
  Deviation out;
  if (!acceptable(q)) {
    out.status = Status::kNotFinite;
    return out;
  }
  if (!effects_.empty()) add_effects(q, context, out);
  if (has_tree_ && !refused(out.status)) add_tree(q, out);
  return out;
}

void ForwardModel::add_effects(std::span<const double> q, const Context& context,
                               Deviation& out) const noexcept {
  ChainFrames<double> frames;
  chain_.frames<double>(q, frames);
  Motion<double> motion;
  if (effects_.apply(q, chain_, frames, context, motion)) out.status = Status::kContextFallback;
  const std::array<double, 3> turn{motion.turn_B(0), motion.turn_B(1), motion.turn_B(2)};
  if (!internal::is_joint_state(turn)) {
    out.status = Status::kNotFinite;
    return;
  }
  out.dq = motion.dq;
  out.shift_B = motion.shift_B;
  out.turn_B = exp({{0.0, 0.0, 0.0}, turn}).R;
}

void ForwardModel::add_tree(std::span<const double> q, Deviation& out) const noexcept {
  const double weight = domain_.weight(q);
  out.tree_B = tree_at(q) * weight;
  if (weight < 1.0) out.status = Status::kOutsideDomain;
}

/// False: a joint is, or was moved, where no joint can be.
bool ForwardModel::bend(std::span<const double> q, const Deviation& deviation,
                        JointPositions& out) const noexcept {
  const auto n = static_cast<std::size_t>(joints());
  if (refused(deviation.status) || q.size() < n) return false;
  for (std::size_t i = 0; i < n; ++i) out[i] = q[i] + deviation.dq[i];
  return internal::is_joint_state(std::span<const double>(out).first(n));
}

/// An encoder scale can still bring a joint beyond what sin_cos knows.
Prediction ForwardModel::finished(const Transformd& X_BT,
                                  const Deviation& deviation) const noexcept {
  const Vector3 p = X_BT.p + deviation.shift_B;
  if (!internal::is_finite(p)) return refusal();
  return {.X_BT = {.R = effects_.empty() ? X_BT.R : Matrix3(deviation.turn_B * X_BT.R),
                   .p = p + deviation.tree_B},
          .tree_B = deviation.tree_B,
          .status = deviation.status};
}

Vector3 ForwardModel::tree_error(std::span<const double> q) const noexcept {
  if (!has_tree_ || !acceptable(q)) return Vector3::Zero();
  return tree_at(q) * domain_.weight(q);
}

Vector3 ForwardModel::tree_at(std::span<const double> q) const noexcept {
  std::array<double, kMaxJoints> u{};
  const std::span<double> inputs = std::span(u).first(static_cast<std::size_t>(joints()));
  domain_.normalise(q, inputs);
  const std::span<const double> at = inputs;
  if (all_hard_ && !one_walk_) {
    const auto e = TreeView::evaluate_all(trees_, at);
    return {e[0], e[1], e[2]};
  }
  if (!one_walk_) return {trees_[0].evaluate(at), trees_[1].evaluate(at), trees_[2].evaluate(at)};
  ActiveLeaves<double> leaves;
  walked_.active(at, leaves);
  return {trees_[0].evaluate(at, leaves), trees_[1].evaluate(at, leaves),
          trees_[2].evaluate(at, leaves)};
}

}  // namespace plumb

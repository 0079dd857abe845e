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
  if (!acceptable(q)) return refusal();
  if (effects_.empty()) return finished(q, chain_.forward<double>(q), Status::kOk);
  ChainFrames<double> frames;
  const Status status = move(q, context, frames);
  return finished(q, frames.tip, status);
}

Prediction ForwardModel::predict(std::span<const double> q, const Context& context,
                                 ChainFrames<double>& frames) const noexcept {
  if (!acceptable(q)) return refusal();
  const Status status = move(q, context, frames);
  return finished(q, frames.tip, status);
}

/// Frames with all effects; their twists in the tip alone.
Status ForwardModel::move(std::span<const double> q, const Context& context,
                          ChainFrames<double>& frames) const noexcept {
  chain_.frames<double>(q, frames);
  if (effects_.empty()) return Status::kOk;
  Motion<double> motion;
  const bool fallback = effects_.apply(q, chain_, frames, context, motion);
  std::array<double, kMaxJoints> bent{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(joints()); ++i)
    bent[i] = q[i] + motion.dq[i];
  const std::span<const double> there = std::span(bent).first(static_cast<std::size_t>(joints()));
  if (!internal::is_joint_state(there)) {
    frames.tip.p.setConstant(kUnknown);
    return Status::kNotFinite;
  }
  chain_.frames<double>(there, frames);
  const Vector3& e = motion.turn_B;
  frames.tip.p += motion.shift_B;
  frames.tip.R = exp({{0.0, 0.0, 0.0}, {e(0), e(1), e(2)}}).R * frames.tip.R;
  return fallback ? Status::kContextFallback : Status::kOk;
}

/// Adds the tree. An encoder scale can still bring a joint beyond what sin_cos knows.
Prediction ForwardModel::finished(std::span<const double> q, const Transformd& X_BT,
                                  Status status) const noexcept {
  if (!internal::is_finite(X_BT.p)) return refusal();
  Prediction out{.X_BT = X_BT, .tree_B = Vector3::Zero(), .status = status};
  if (!has_tree_) return out;
  const double weight = domain_.weight(q);
  out.tree_B = tree_at(q) * weight;
  out.X_BT.p += out.tree_B;
  if (weight < 1.0) out.status = Status::kOutsideDomain;
  return out;
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

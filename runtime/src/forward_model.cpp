// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/forward_model.hpp"

#include "finite.hpp"

namespace plumb {

ForwardModel::ForwardModel(const format::Model& model) noexcept
    : chain_(model.calibrated), domain_(model.domain) {
  for (int axis = 0; axis < format::kTreeAxes; ++axis) {
    trees_[axis] = TreeView(model.trees[axis], chain_.joints());
    has_tree_ = has_tree_ || !trees_[axis].empty();
  }
}

Prediction ForwardModel::predict(std::span<const double> q) const noexcept {
  Prediction out{.X_BT = {}, .tree_B = Vector3::Zero(), .status = Status::kNotFinite};
  const auto n = static_cast<std::size_t>(joints());
  if (q.size() < n || !internal::is_joint_state(q.first(n))) return out;
  const auto state = q.first(n);
  const Transformd X_BT = chain_.forward<double>(state);
  if (!internal::is_finite(X_BT.p)) return out;
  out.X_BT = X_BT;
  out.status = Status::kOk;
  if (!has_tree_) return out;
  const double weight = domain_.weight(state);
  out.tree_B = tree_at(state) * weight;
  out.X_BT.p += out.tree_B;
  if (weight < 1.0) out.status = Status::kOutsideDomain;
  return out;
}

Vector3 ForwardModel::tree_error(std::span<const double> q) const noexcept {
  const auto n = static_cast<std::size_t>(joints());
  if (!has_tree_ || q.size() < n || !internal::is_joint_state(q.first(n))) return Vector3::Zero();
  return tree_at(q.first(n)) * domain_.weight(q.first(n));
}

Vector3 ForwardModel::tree_at(std::span<const double> q) const noexcept {
  std::array<double, kMaxJoints> u{};
  const std::span<double> inputs = std::span(u).first(q.size());
  domain_.normalise(q, inputs);
  return {trees_[0].evaluate(inputs), trees_[1].evaluate(inputs), trees_[2].evaluate(inputs)};
}

}  // namespace plumb

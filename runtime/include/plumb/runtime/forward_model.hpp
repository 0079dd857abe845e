// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "plumb/format/model.hpp"
#include "plumb/runtime/chain.hpp"
#include "plumb/runtime/effect_set.hpp"
#include "plumb/runtime/status.hpp"
#include "plumb/runtime/tree.hpp"

namespace plumb {

/// Where the true arm is, as far as the model knows.
struct Prediction {
  Transformd X_BT;  // tool pose in the base frame, tree included
  Vector3 tree_B;   // what the tree added to the position [m]
  Status status;    // kOk, kOutsideDomain or kContextFallback; kNotFinite leaves X_BT at identity
};

/// The true arm T(q): calibrated chain, effects, local linear model tree.
/// Refers to the model's memory: the model must outlive it.
class ForwardModel {
 public:
  ForwardModel() = default;
  explicit ForwardModel(const format::Model& model) noexcept;

  int joints() const noexcept { return chain_.joints(); }
  const Chain& chain() const noexcept { return chain_; }

  /// q: joint positions [rad] or [m], shape (n,). Cost: fixed for a given model. Any thread.
  /// Refused with kNotFinite when one is not finite or beyond 1e4. Effects move joint i to
  /// q_i + dq_i, then the tip by their twists.
  Prediction predict(std::span<const double> q, const Context& context = {}) const noexcept;

  /// The same, with the frame behind every joint of the calibrated chain: joint effects move it,
  /// the twists and the tree do not.
  Prediction predict(std::span<const double> q, const Context& context,
                     ChainFrames<double>& frames) const noexcept;

  /// What the tree says at q [m], base frame: bounded, zero well outside the trained domain.
  Vector3 tree_error(std::span<const double> q) const noexcept;

 private:
  bool acceptable(std::span<const double> q) const noexcept;
  Prediction finished(std::span<const double> q, const Transformd& X_BT,
                      Status status) const noexcept;
  Status move(std::span<const double> q, const Context& context,
              ChainFrames<double>& frames) const noexcept;
  Vector3 tree_at(std::span<const double> q) const noexcept;

  Chain chain_;
  EffectSet effects_;
  TrainedDomain domain_;
  std::array<TreeView, format::kTreeAxes> trees_;
  bool has_tree_ = false;
  bool all_hard_ = false;  // so all are walked side by side
  TreeView walked_;        // the first that is not empty
  bool one_walk_ = false;  // the others differ from it in their numbers only
};

}  // namespace plumb

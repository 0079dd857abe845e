// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "plumb/format/model.hpp"
#include "plumb/runtime/chain.hpp"
#include "plumb/runtime/effect_set.hpp"
#include "plumb/runtime/hard_trees.hpp"
#include "plumb/runtime/status.hpp"
#include "plumb/runtime/tree.hpp"

namespace plumb {

class Columns;  // a pose in registers

/// Where the true arm is, as far as the model knows.
struct Prediction {
  Transformd X_BT;  // tool pose in the base frame, tree included
  Vector3 tree_B;   // what the tree added to the position [m]
  Status status;    // kOk, kOutsideDomain or kContextFallback; kNotFinite leaves X_BT at identity
};

/// How the arm at one pose departs from its calibrated chain: effects and tree. It changes little
/// from pose to pose, so that near by it may stand for what it would be there.
struct Deviation {
  using Column = std::array<double, 4>;  // x, y, z and a number that means nothing

  Motion<double> motion;                     // of joints and tip, by the effects
  alignas(32) std::array<Column, 3> turn_B;  // the tip's part of it that turns, as a rotation;
                                             // of an arm with effects
  alignas(32) Column tree_B;                 // [m]
  Status status;
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
                     ChainFrames& frames) const noexcept;

  /// The same in three parts: the first holds while the context does; the last costs no more than
  /// the chain alone, and takes what the second said of this pose or of one near by. p_BT: where
  /// the tool is; axes: of the chain as above, its orientation not yet `turned`. Refused: all zero,
  /// the orientation the identity.
  void prepare(const Context& context, EffectSet::Scene& out) const noexcept;
  void find_deviation(std::span<const double> q, EffectSet::Scene& scene,
                      Deviation& out) const noexcept;
  Status locate(std::span<const double> q, const Deviation& deviation, ChainAxes& axes,
                Vector3& p_BT) const noexcept;

  /// What the effects make of the chain's orientation.
  Matrix3 turned(const Matrix3& R_BT, const Deviation& deviation) const noexcept;

  /// What the tree says at q [m], base frame: bounded, zero well outside the trained domain.
  Vector3 tree_error(std::span<const double> q) const noexcept;

 private:
  using JointPositions = std::array<double, kMaxJoints>;

  bool acceptable(std::span<const double> q) const noexcept;
  void find_deviation(std::span<const double> q, const Context& context,
                      Deviation& out) const noexcept;
  void deviate(std::span<const double> q, EffectSet::Scene& scene, Deviation& out) const noexcept;
  void add_effects(std::span<const double> q, EffectSet::Scene& scene,
                   Deviation& out) const noexcept;
  void add_tree(std::span<const double> q, Deviation& out) const noexcept;
  bool bend(std::span<const double> q, const Deviation& deviation,
            JointPositions& out) const noexcept;
  Prediction finished(const Columns& X_BT, const Deviation& deviation) const noexcept;
  double tree_at(std::span<const double> q, Deviation::Column& out) const noexcept;
  double other_tree_at(std::span<const double> q, Deviation::Column& out) const noexcept;
  void trees_at(std::span<const double> u, Deviation::Column& out) const noexcept;

  EffectSet effects_;
  TreeView walked_;  // the first that is not empty
  TrainedDomain domain_;
  std::array<TreeView, format::kTreeAxes> trees_;
  HardTrees hard_trees_;  // they, if `all_hard_`
  Chain chain_;
  bool has_tree_ = false;
  bool all_hard_ = false;
  bool six_hard_trees_ = false;  // all hard, HardTrees' usual ones, and no walk serves them all
  bool one_walk_ = false;        // the others differ from `walked_` in their numbers only
};

}  // namespace plumb

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "plumb/format/model.hpp"
#include "plumb/runtime/chain.hpp"
#include "plumb/runtime/detail/crisp_trees.hpp"
#include "plumb/runtime/detail/effect_set.hpp"
#include "plumb/runtime/detail/trained_domain.hpp"
#include "plumb/runtime/detail/tree.hpp"
#include "plumb/runtime/status.hpp"

namespace plumb {

class Columns;  // a pose in registers

/// The pose of the true arm as the model predicts it.
struct Prediction {
  Transformd X_BT;  // tool pose in the base frame, tree included
  Vector3 tree_B;   // part of the position that comes from the tree [m]
  Status status;    // kOk, kOutsideDomain or kContextFallback; if kNotFinite, X_BT is the identity
};

/// The deviation of the arm from its calibrated chain at one pose, by effects and tree. It changes
/// little between neighbouring poses, so the deviation of one may be used at the next.
struct Deviation {
  using Column = std::array<double, 4>;  // x, y, z and an arbitrary fourth number

  Motion<double> motion;                     // motion of joints and tip by the effects
  alignas(32) std::array<Column, 3> turn_B;  // motion.turn_B as a rotation matrix; set only if the
                                             // model has effects
  alignas(32) Column tree_B;                 // displacement by the tree [m]
  Status status;
};

/// The true arm T(q): calibrated chain, effects and local linear model tree.
/// Refers to the model's memory: the model must outlive it.
class ForwardModel {
 public:
  ForwardModel() = default;
  explicit ForwardModel(const format::Model& model) noexcept;

  int joints() const noexcept { return chain_.joints(); }
  const Chain& chain() const noexcept { return chain_; }

  /// Predicts the tool pose. q: joint positions [rad] or [m], shape (n,). Effects move joint i to
  /// q_i + dq_i, then the tip by their twists. Refused with kNotFinite if a joint position is not
  /// finite or exceeds 1e4. Cost: fixed for a given model. Any thread.
  Prediction predict(std::span<const double> q, const Context& context = {}) const noexcept;

  /// The same, and the frame after every joint. Effects on joints move these frames; twists of the
  /// tip and the tree do not.
  Prediction predict(std::span<const double> q, const Context& context,
                     ChainFrames& frames) const noexcept;

  /// predict() in three parts. prepare() is needed once for a context. find_deviation() evaluates
  /// effects and tree at q. locate() costs no more than the chain alone and uses a deviation that
  /// was found at this pose or near it. p_BT: position of the tool [m]; axes: those of the chain,
  /// whose tip still has to be rotated by turned(). After a refusal all are zero and the
  /// orientation is the identity.
  void prepare(const Context& context, EffectSet::Workspace& out) const noexcept;
  void find_deviation(std::span<const double> q, EffectSet::Workspace& workspace,
                      Deviation& out) const noexcept;
  Status locate(std::span<const double> q, const Deviation& deviation, ChainAxes& axes,
                Vector3& p_BT) const noexcept;

  /// The orientation of the tool: that of the chain, R_BT, rotated by the effects.
  Matrix3 turned(const Matrix3& R_BT, const Deviation& deviation) const noexcept;

  /// The tree's displacement of the tool at q [m], base frame; bounded, and zero far outside the
  /// trained domain.
  Vector3 tree_error(std::span<const double> q) const noexcept;

 private:
  using JointPositions = std::array<double, kMaxJoints>;

  bool acceptable(std::span<const double> q) const noexcept;
  void find_deviation(std::span<const double> q, const Context& context,
                      Deviation& out) const noexcept;
  void deviate(std::span<const double> q, EffectSet::Workspace& workspace,
               Deviation& out) const noexcept;
  void add_effects(std::span<const double> q, EffectSet::Workspace& workspace,
                   Deviation& out) const noexcept;
  void add_tree(std::span<const double> q, Deviation& out) const noexcept;
  bool bend(std::span<const double> q, const Deviation& deviation,
            JointPositions& out) const noexcept;
  Prediction finished(const Columns& X_BT, const Deviation& deviation) const noexcept;
  double tree_at(std::span<const double> q, Deviation::Column& out) const noexcept;
  double other_tree_at(std::span<const double> q, Deviation::Column& out) const noexcept;
  void trees_at(std::span<const double> u, Deviation::Column& out) const noexcept;

  EffectSet effects_;
  TreeView walked_;  // the first tree that is not empty
  TrainedDomain domain_;
  std::array<TreeView, format::kTreeAxes> trees_;
  CrispTrees crisp_trees_;  // all three trees, if `all_crisp_`
  Chain chain_;
  bool has_tree_ = false;
  bool all_crisp_ = false;        // all trees are crisp and split along the axes
  bool six_crisp_trees_ = false;  // CrispTrees::has_fast_path()
  bool one_walk_ = false;         // all trees have the same nodes, so one walk finds their leaves
};

}  // namespace plumb

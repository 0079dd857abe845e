// SPDX-License-Identifier: Apache-2.0
#include "compile/audit.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "cell/random.hpp"
#include "compile/trained_poses.hpp"
#include "plumb/format/writer.hpp"
#include "plumb/runtime/forward_model.hpp"
#include "tree/active_bound.hpp"

namespace plumb::offline {
namespace {

constexpr int kBorderPoints = 32;  // checked on each leaf border
constexpr int kHalvings = 60;      // bisection steps, down to neighbouring doubles
constexpr double kStill = 1e-3;    // [rad] or [m]; a joint with a smaller range did not move
/// A step at a leaf border, and 1 sigma of the tool, that are larger than these shares of the
/// guard's largest correction give a warning. Chosen: both are small beside the corrections that
/// are made.
constexpr double kLargeJump = 0.1, kLargeSigma = 0.3;
/// So does a model with room for fewer effects than this.
constexpr int kRoomForEffects = 8;

void look_at_corrections(const format::Model& model, Audit& out) {
  const ForwardModel true_arm(model);
  const Chain nominal(model.nominal);
  const JointRanges box = trained_box(model);
  Random random(1);
  for (int i = 0; i < kAuditPoses; ++i) {
    const auto q = somewhere_in(box, random);
    const Transformd X_BT = true_arm.predict(q).X_BT;
    const Transformd X_BN = nominal.forward(q);
    const double shift = (X_BT.p - X_BN.p).norm();
    const double turn = rotation_vector(X_BT.R * X_BN.R.transpose()).norm();
    if (shift > out.worst_correction_m) {
      out.worst_correction_m = shift;
      out.worst_q = q;
    }
    out.worst_rotation_rad = std::max(out.worst_rotation_rad, turn);
  }
}

/// Largest jump across the border of `node`, at random points of the cell that it divides.
double jump_at(const format::Tree& tree, const TreeView& view, int node, const JointRanges& cell,
               Random& random) {
  const auto& border = tree.nodes[node];
  double worst = 0.0;
  for (int i = 0; i < kBorderPoints; ++i) {
    auto u = somewhere_in(cell, random);
    u[border.input] = border.threshold;
    const double low = view.evaluate(u);
    u[border.input] = std::nextafter(border.threshold, 2.0);
    worst = std::max(worst, std::abs(view.evaluate(u) - low));
  }
  return worst;
}

/// Largest jump of an oblique tree, at borders found by bisection between random points of the box.
double jump_on_the_way(const TreeView& view, const JointRanges& box, Random& random) {
  double worst = 0.0;
  for (int i = 0; i < kAuditPoses; ++i) {
    auto from = somewhere_in(box, random), to = somewhere_in(box, random);
    if (view.leaf(from) == view.leaf(to)) continue;
    std::vector<double> middle(from.size());
    for (int halving = 0; halving < kHalvings; ++halving) {
      for (std::size_t k = 0; k < from.size(); ++k) middle[k] = 0.5 * (from[k] + to[k]);
      (view.leaf(middle) == view.leaf(from) ? from : to) = middle;
    }
    worst = std::max(worst, std::abs(view.evaluate(to) - view.evaluate(from)));
  }
  return worst;
}

double worst_jump(const format::Tree& tree, int inputs, Random& random) {
  const TreeView view(tree, inputs);
  if (view.blended()) return 0.0;
  const JointRanges box(inputs, {-1.0, 1.0});
  if (!tree.directions.empty()) return jump_on_the_way(view, box, random);
  double worst = 0.0;
  std::vector<JointRanges> cells(tree.nodes.size(), box);
  for (std::size_t node = 0; node < tree.nodes.size(); ++node) {
    const auto& n = tree.nodes[node];
    worst = std::max(worst, jump_at(tree, view, static_cast<int>(node), cells[node], random));
    if (n.low >= 0) {
      cells[n.low] = cells[node];
      cells[n.low][n.input].second = n.threshold;
    }
    if (n.high >= 0) {
      cells[n.high] = cells[node];
      cells[n.high][n.input].first = n.threshold;
    }
  }
  return worst;
}

/// Numbers, counted from 1, of the joints whose trained range is a single point.
std::vector<std::size_t> still_joints(const format::Model& model) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < model.domain.q_min.size(); ++i)
    if (model.domain.q_max[i] - model.domain.q_min[i] < kStill) out.push_back(i + 1);
  return out;
}

void judge(const format::Model& model, Audit& out) {
  if (out.worst_correction_m > model.guard.max_correction_m)
    out.remarks.push_back(
        {.severity = Severity::kWarning,
         .code = "W-AUDIT-LIMIT",
         .message = fmt::format("the largest correction, {:.3f} mm, exceeds the guard's limit of "
                                "{:.3f} mm and would be cut",
                                out.worst_correction_m * 1e3, model.guard.max_correction_m * 1e3),
         .help = fmt::format("if that is right for this arm: [deploy] max_correction_mm = {:.1f}",
                             std::ceil(out.worst_correction_m * 1.2e4) / 10.0)});
  if (out.worst_jump_m > kLargeJump * model.guard.max_correction_m)
    out.remarks.push_back(
        {.severity = Severity::kWarning,
         .code = "W-AUDIT-JUMP",
         .message = fmt::format("the tree steps by {:.3f} mm at a leaf border; the guard spreads "
                                "such a step over time, but the arm leaves its path meanwhile",
                                out.worst_jump_m * 1e3),
         .help = "blend the leaves: [effects.local_tree] form = \"blended\""});
  if (out.tool.max_m > kLargeSigma * model.guard.max_correction_m)
    out.remarks.push_back(
        {.severity = Severity::kWarning,
         .code = "W-AUDIT-SIGMA",
         .message =
             fmt::format("the poses leave the tool uncertain by {:.3f} mm (1 sigma) somewhere "
                         "in the trained range",
                         out.tool.max_m * 1e3),
         .help = "measure more poses: plumb plan --n 30"});
  if (const auto still = still_joints(model); !still.empty())
    out.remarks.push_back(
        {.severity = Severity::kWarning,
         .code = "W-AUDIT-STILL",
         .message = fmt::format("joint {} never moved in the poses that were fitted: of what the "
                                "arm does where {} elsewhere this model knows nothing",
                                fmt::join(still, ", "), still.size() == 1 ? "it is" : "they are"),
         .help = "measure poses all over the joint limits: plumb plan --n 30"});
  if (model.effects.size() + kRoomForEffects > static_cast<std::size_t>(format::kMaxEffects))
    out.remarks.push_back(
        {.severity = Severity::kWarning,
         .code = "W-AUDIT-EFFECTS",
         .message = fmt::format("the model holds {} effects of the {} that there is room for: what "
                                "the poses support beyond them is left out",
                                model.effects.size(), format::kMaxEffects),
         .help = "plumb diagnose says what is left; [effects.local_tree] may learn it"});
  if (model.provenance.held_out.poses == 0)
    out.remarks.push_back({.severity = Severity::kWarning,
                           .code = "W-AUDIT-HELD",
                           .message = "this model carries no held-out figure",
                           .help = "compile without --refit-all, or verify on fresh poses"});
}

}  // namespace

Audit audit(const format::Model& model) {
  Audit out;
  look_at_corrections(model, out);
  Random random(1);
  const int inputs = static_cast<int>(model.nominal.joints.size());
  for (const auto& tree : model.trees) {
    out.leaves += static_cast<int>(tree.leaves());
    out.active_leaves = std::max(out.active_leaves, most_active_leaves(tree, inputs));
    out.worst_jump_m = std::max(out.worst_jump_m, worst_jump(tree, inputs, random));
  }
  out.tool = tool_uncertainty(model);
  out.bytes = format::write_model(model).size();
  out.refusals = refusal_share(model);
  judge(model, out);
  return out;
}

}  // namespace plumb::offline

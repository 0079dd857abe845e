// SPDX-License-Identifier: Apache-2.0
#include "bench/step_instructions.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "plumb/format/formula.hpp"
#include "plumb/runtime/detail/tree.hpp"

namespace plumb::offline::bench {
namespace {

// All numbers are counted instructions of one step (see the header).

/// The arm alone, without effects and trees, by its number of joints from 1 to 9. Positions: the
/// model corrects positions only; poses: orientations too.
constexpr std::array<double, format::kMaxJoints> kPositions{19078, 21492, 23936, 26209, 30468,
                                                            12750, 24880, 25331, 28324};
constexpr std::array<double, format::kMaxJoints> kPoses{18319, 20505, 22721, 25270, 28335,
                                                        11760, 22291, 22586, 24817};
/// The same in the build without AVX2.
constexpr std::array<double, format::kMaxJoints> kBaselinePositions{
    23564, 27590, 33375, 37638, 43568, 22449, 42304, 45072, 49620};
constexpr std::array<double, format::kMaxJoints> kBaselinePoses{22607, 26039, 30600, 34731, 38975,
                                                                19929, 35893, 38067, 41391};
/// By this factor rows, effects and crisp trees add more in the build without AVX2; single ones by
/// 1.3 to 2.0.
constexpr double kBaselineRest = 1.6;
/// For each joint if a row of the arm is no plain DH row (is_plain); the second one more if the
/// model has effects.
constexpr double kGeneralRow = 390, kGeneralRowOfEffects = 130;
/// Frames and loads, which any effect needs: once, and for each joint.
constexpr double kEffects = 1050, kEffectsPerJoint = 240;
constexpr double kRange = 40;  // for each range of the context

constexpr int kEvaluations = 3;  // of effects and trees in a step

/// What one effect adds: once, for each of its joints, and for each of its parameters.
struct LawTerms {
  std::string_view law;
  double once, per_joint, per_number;
};
constexpr LawTerms kLaws[] = {
    {"joint_compliance", 90, 105, 0},  {"joint_compliance_soft", 125, 289, 0},
    {"gravity_free", 70, 0, 39},       {"link_flexure", 115, 833, 0},
    {"gear_harmonics", 66, 267, 0},    {"gear_ripple", 82, 239, 0},
    {"joint_table", 90, 108, 0},       {"joint_series", 149, 258, 8.25},
    {"encoder_scale", 48, 24, 0},      {"encoder_eccentricity", 80, 454, 0},
    {"reversal", 224, 97, 0},          {"backlash_load", 83, 247, 0},
    {"axis_wobble", 96, 621, 0},       {"rail_bow", 89, 289, 0},
    {"pitch_error", 99, 264, 0},       {"wrist_coupling", 87, 0, 0},
    {"drive_coupling", 57, 0, 0},      {"cross_compliance", 156, 0, 0},
    {"thermal_growth", 267, 113, 0},   {"base_compliance", 186, 0, 0},
    {"tool_sag", 183, 0, 0},           {"gravity_compensator", 94, 278, 0},
    {"payload_compliance", 84, 84, 0}, {"wrench_compliance", 84, 66, 0},
};
constexpr LawTerms kUnknownLaw{"", 400, 840, 9};

constexpr double kFormula = 180;  // for each formula, beside its target and its operations
constexpr double kFormulaTarget[] = {0, 673, 400, 349, 379, 286};  // by FormulaTarget

/// What one operation of a formula adds; the largest count where that depends on the argument.
double operation_terms(format::FormulaOp op) {
  using format::FormulaOp;
  switch (op) {
    case FormulaOp::kTorque:
      return 196;
    case FormulaOp::kSin:
    case FormulaOp::kCos:
      return 207;
    case FormulaOp::kExp:
    case FormulaOp::kLog:
    case FormulaOp::kTanh:
      return 300;
    case FormulaOp::kPower:
      return 783;
    default:
      return op >= FormulaOp::kPosition && op <= FormulaOp::kRow ? 106 : 78;
  }
}

double formula_terms(const format::Formula& formula) {
  double sum =
      kFormula + kFormulaTarget[std::min<std::size_t>(static_cast<std::size_t>(formula.target), 5)];
  for (const std::uint16_t code : formula.code) sum += operation_terms(format::operation(code));
  return sum;
}

double effect_terms(const format::Effect& effect) {
  if (!effect.formula.code.empty()) return formula_terms(effect.formula);
  const auto* found = std::find_if(std::begin(kLaws), std::end(kLaws),
                                   [&](const LawTerms& terms) { return terms.law == effect.name; });
  const LawTerms& terms = found == std::end(kLaws) ? kUnknownLaw : *found;
  return terms.once + terms.per_joint * static_cast<double>(effect.joints.size()) +
         terms.per_number * static_cast<double>(effect.parameters.size());
}

/// What one evaluation of the tree of one axis adds. `walks`: the share of the search for its leaf
/// that counts here; trees with the same leaves share one search.
double tree_terms(const format::Tree& tree, std::size_t inputs, double walks) {
  const auto n = static_cast<double>(inputs);
  const bool blended = !tree.blend_half_width.empty(), oblique = !tree.directions.empty();
  const auto active =
      blended ? static_cast<double>(std::min<std::size_t>(tree.leaves(), format::kMaxActiveLeaves))
              : 1.0;
  const auto terms = static_cast<double>(format::leaf_terms(inputs, tree.degree));
  // With six inputs the compiler unrolls the sums, with other numbers they stay loops.
  const bool loops = inputs != 6;
  const double products = loops ? (tree.degree == 2 ? 90.0 : 30.0) : 0.0;
  const double region = tree.region.empty() ? 0.0 : 9.5 * n + (loops ? 70.0 : 0.0);
  const double value = active * (10.5 * terms - 10.0 + products + region);
  const double node = oblique ? 7.0 * n : 0.0;
  const double beyond = 6.0 * std::max(0.0, static_cast<double>(tree.leaves()) - active);
  const double walk =
      blended ? active * (56.0 + node) + std::min(60.0 * std::max(0, tree.depth - 6), beyond)
              : (14.0 + 1.15 * node) * tree.depth;
  return 60.0 + value + walks * walk;
}

double trees_terms(const format::Model& model) {
  const std::size_t inputs = model.nominal.joints.size();
  const TreeView first(model.trees[0], static_cast<int>(inputs));
  const bool alike = std::all_of(model.trees.begin(), model.trees.end(), [&](const auto& tree) {
    return TreeView(tree, static_cast<int>(inputs)).same_leaves(first);
  });
  double sum = 0.0;
  for (const auto& tree : model.trees)
    if (!tree.bounds.empty()) sum += tree_terms(tree, inputs, alike ? 1.0 / 3.0 : 1.0);
  return sum;
}

bool is_plain(const format::JointRow& row) {
  return row.type == format::JointType::kRevolute && row.beta == 0.0 &&
         row.pre == format::Twist{} && row.post == format::Twist{};
}

using OfJoints = std::array<double, format::kMaxJoints>;

double of_arm(const format::Model& model, const OfJoints& positions, const OfJoints& poses) {
  const std::size_t n = std::clamp<std::size_t>(model.nominal.joints.size(), 1, format::kMaxJoints);
  return (model.guard.corrects == format::Corrects::kPose ? poses : positions)[n - 1];
}

/// What trees add to the arm.
double of_trees(const format::Model& model) { return kEvaluations * trees_terms(model); }

/// Blended trees are hardly vectorised, and take as many with AVX2 as without.
double baseline_of_trees(const format::Model& model) {
  const bool blended = std::any_of(model.trees.begin(), model.trees.end(),
                                   [](const auto& tree) { return !tree.blend_half_width.empty(); });
  return (blended ? 1.0 : kBaselineRest) * of_trees(model);
}

/// What rows, effects and ranges add to the arm.
double of_rest(const format::Model& model) {
  const auto joints = static_cast<double>(model.nominal.joints.size());
  double sum = 0.0;
  const auto& rows = model.calibrated.joints;
  const bool general = !std::all_of(rows.begin(), rows.end(), is_plain);
  if (general) sum += kGeneralRow * joints;
  if (!model.effects.empty())
    sum += kEffects + kEffectsPerJoint * joints + (general ? kGeneralRowOfEffects * joints : 0.0);
  for (const auto& effect : model.effects) sum += effect_terms(effect);
  return sum + kRange * static_cast<double>(model.domain.context.size());
}

}  // namespace

double step_instructions(const format::Model& model) {
  return of_arm(model, kPositions, kPoses) + of_rest(model) + of_trees(model);
}

double baseline_instructions(const format::Model& model) {
  return of_arm(model, kBaselinePositions, kBaselinePoses) + kBaselineRest * of_rest(model) +
         baseline_of_trees(model);
}

}  // namespace plumb::offline::bench

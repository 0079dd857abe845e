// SPDX-License-Identifier: Apache-2.0
#include "golden_models.hpp"

#include "plumb/format/formula.hpp"

namespace plumb::format {
namespace {

JointRow row(const std::string& name, double alpha, double a, double d) {
  JointRow out;
  out.name = name;
  out.alpha = alpha;
  out.a = a;
  out.d = d;
  out.q_min = -3.0;
  out.q_max = 3.0;
  return out;
}

/// Three nodes, four leaves, depth 3: leans to one side.
Tree leaning_tree(int inputs) {
  Tree out;
  out.depth = 3;
  out.nodes = {{0.25, 1, ~0, 1, 0}, {-0.5, 0, 2, ~3, 0}, {0.0, 5, ~1, ~2, 0}};
  for (int leaf = 0; leaf < 4; ++leaf) {
    for (int i = 0; i <= inputs; ++i) out.coefficients.push_back(1e-5 * (leaf - i));
    out.bounds.insert(out.bounds.end(), {-1e-4, 2e-4});
  }
  return out;
}

Provenance provenance() {
  Provenance out;
  out.tool_version = "0.1.0";
  out.created = "2026-01-02T03:04:05Z";
  out.run = "0007";
  out.inputs = {{"measurements.csv", std::string(64, 'a')}};
  out.poses_fit = 160;
  out.held_out = {40, 5e-5, 6e-5, 9e-5, 1.2e-4};
  out.noise_floor_m = 1.6e-5;
  out.parameter_names = {"J2.d", "J3.alpha"};
  out.covariance = {1e-10F, 2e-12F, 3e-10F};
  return out;
}

}  // namespace

Model six_axis_model() {
  Model m;
  m.cell_name = "Golden cell";
  m.robot_name = "Six axes";
  m.serial = "G-1";
  m.nominal.convention = Convention::kStandard;
  constexpr double kRight = 1.5707963267948966;
  m.nominal.joints = {row("J1", kRight, 0.0, 0.1273),  row("J2", 0.0, -0.612, 0.0),
                      row("J3", 0.0, -0.5723, 0.0),    row("J4", kRight, 0.0, 0.163941),
                      row("J5", -kRight, 0.0, 0.1157), row("J6", 0.0, 0.0, 0.0922)};
  m.nominal.tool.p = {0.0, 0.01, 0.15};
  m.calibrated = m.nominal;
  for (auto& joint : m.calibrated.joints) {
    joint.alpha += 3e-4;
    joint.a -= 4e-4;
    joint.theta = 2e-4;
  }
  m.calibrated.joints[1].beta = 1e-4;
  m.calibrated.joints[2].post.e = {1e-5, 0.0, -1e-5};
  m.effects = {{.name = "reversal",
                .version = 1,
                .joints = {1, 2},
                .parameters = {1e-4, 0.05, 2e-4, 0.05},
                .context = {{ContextInput::kDirection, "", 0.0}}}};
  m.trees = {leaning_tree(6), leaning_tree(6), Tree{}};
  m.domain = {std::vector<double>(6, -2.5), std::vector<double>(6, 2.5), 0.05};
  m.provenance = provenance();
  return m;
}

Model planar_model() {
  Model m;
  m.robot_name = "Planar";
  m.gravity = {0.0, -9.81, 0.0};
  m.nominal.convention = Convention::kModified;
  m.nominal.joints = {row("A", 0.0, 0.0, 0.0), row("B", 0.0, 1.0, 0.0)};
  m.nominal.joints[1].type = JointType::kPrismatic;
  m.calibrated = m.nominal;
  m.guard.corrects = Corrects::kPose;
  return m;
}

Model planar_2r_model() {
  Model m;
  m.cell_name = "Ebene Zelle";
  m.robot_name = "2R";
  m.nominal.convention = Convention::kStandard;
  m.nominal.joints = {row("J1", 0.0, 0.5, 0.0), row("J2", 0.0, 0.375, 0.0)};
  m.calibrated = m.nominal;
  m.calibrated.joints[0].offset = 1e-3;
  m.calibrated.joints[1].scale = 1.0001;
  m.calibrated.base_twist = {{1e-4, -2e-4, 0.0}, {0.0, 0.0, 1e-3}};
  m.trees[0] = {.depth = 0,
                .nodes = {},
                .coefficients = {1e-4, -2e-5, 3e-5},
                .bounds = {-1e-4, 1.5e-4},
                .blend_half_width = {}};
  m.domain = {{-1.5, 0.25}, {1.5, 2.0}, 0.125};
  return m;
}

/// Two quadratic leaves, blended over the whole box; what is beyond 0.5 was not seen.
Tree quadratic_tree() {
  return {.depth = 1,
          .nodes = {{0.0, 0, ~0, ~1, 0}},
          .coefficients = {1e-4, -2e-5, 3e-5, 1e-5, -1e-5, 2e-5, 5e-5, 2e-5, 0.0, 1e-5, 0.0, -3e-5},
          .bounds = {-1e-4, 1.5e-4, -5e-5, 1e-4},
          .blend_half_width = {1.0},
          .degree = 2,
          .directions = {},
          .region = {-1.25F, 0.5F, -1.25F, 1.25F, -0.5F, 1.25F, -1.25F, 0.5F},
          .sigma = {5e-6F, 7e-6F}};
}

/// Three affine leaves along directions, the second split narrow.
Tree oblique_tree() {
  return {.depth = 2,
          .nodes = {{-0.25, 0, 1, ~2, 0}, {0.5, 0, ~0, ~1, 0}},
          .coefficients = {1e-5, 2e-5, -1e-5, 0.0, 1e-5, 3e-5, -2e-5, 0.0, 4e-5},
          .bounds = {-2e-5, 4e-5, -1e-5, 3e-5, -6e-5, 2e-5},
          .blend_half_width = {0.75, 0.0625},
          .degree = 1,
          .directions = {0.5, 0.5, 0.75, -0.25},
          .region = {},
          .sigma = {}};
}

Model blended_model() {
  Model m = planar_2r_model();
  m.trees = {quadratic_tree(), oblique_tree(), quadratic_tree()};
  m.trees[2].coefficients[0] = -5e-5;
  m.trees[2].blend_half_width.clear();
  return m;
}

Model formula_model() {
  Model m = planar_2r_model();
  m.trees = {};
  Effect own{.name = "formula",
             .version = 1,
             .joints = {0},
             .parameters = {2e-6, 1e-3},
             .context = {{ContextInput::kDirection, "", 0.0},
                         {ContextInput::kTravel, "", 0.0},
                         {ContextInput::kTemperature, "temp_arm", 21.5}}};
  own.formula = {
      .name = "heat",
      .target = FormulaTarget::kPost,
      .joint = 1,
      .component = 5,
      .domain = 1,
      .expression = "post2.rz = k * dir1 * travel1 * (1 + c * (temp_arm - 20 [degC]))",
      .code = {instruction(FormulaOp::kParameter, 0), instruction(FormulaOp::kDirection, 0),
               instruction(FormulaOp::kMultiply), instruction(FormulaOp::kTravel, 0),
               instruction(FormulaOp::kMultiply), instruction(FormulaOp::kLiteral, 0),
               instruction(FormulaOp::kParameter, 1), instruction(FormulaOp::kTemperature, 0),
               instruction(FormulaOp::kLiteral, 1), instruction(FormulaOp::kSubtract),
               instruction(FormulaOp::kMultiply), instruction(FormulaOp::kAdd),
               instruction(FormulaOp::kMultiply)},
      .literals = {1.0, 20.0},
      .parameters = {{"k", "1", 1e-6, 0.0}, {"c", "1/K", 1e-3, 1e-3}}};
  m.effects = {std::move(own)};
  return m;
}

Model ranges_model() {
  Model m = formula_model();
  m.domain.context = {{ContextInput::kPayload, "", 0.0, 4.5},
                      {ContextInput::kPayload, "cz", 0.125, 0.125},
                      {ContextInput::kTemperature, "temp_arm", 18.5, 27.25}};
  return m;
}

/// J3 = q3 + q2, J6 = q6 - 0.5 q5.
Model coupled_model() {
  Model m = six_axis_model();
  m.nominal.coupling = m.calibrated.coupling = {{2, 1, -1.0}, {5, 4, 0.5}};
  return m;
}

std::vector<std::pair<std::string, Model>> golden_models() {
  return {{"six_axis", six_axis_model()},   {"planar", planar_model()},
          {"planar_2r", planar_2r_model()}, {"formula", formula_model()},
          {"blended", blended_model()},     {"ranges", ranges_model()},
          {"coupled", coupled_model()}};
}

}  // namespace plumb::format

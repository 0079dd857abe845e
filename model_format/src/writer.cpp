// SPDX-License-Identifier: Apache-2.0
#include "plumb/format/writer.hpp"

#include <algorithm>
#include <stdexcept>

#include "model_generated.h"
#include "plumb/format/version.hpp"
#include "semantic_check.hpp"
#include "trailer.hpp"

namespace plumb::format {
namespace {

using Builder = flatbuffers::FlatBufferBuilder;
template <class T>
using Offset = flatbuffers::Offset<T>;

wire::Pose to_wire(const Pose& x) {
  return {x.p[0], x.p[1], x.p[2], x.q[0], x.q[1], x.q[2], x.q[3]};
}
wire::Twist to_wire(const Twist& x) { return {x.d[0], x.d[1], x.d[2], x.e[0], x.e[1], x.e[2]}; }

Offset<wire::Joint> add(Builder& b, const JointRow& row) {
  const auto name = b.CreateString(row.name);
  const auto pre = to_wire(row.pre), post = to_wire(row.post);
  return wire::CreateJoint(b, name, static_cast<wire::JointType>(row.type), row.alpha, row.a, row.d,
                           row.theta, row.beta, row.scale, row.offset, row.q_min, row.q_max, &pre,
                           &post);
}

Offset<wire::Chain> add(Builder& b, const Chain& chain) {
  std::vector<Offset<wire::Joint>> joints;
  for (const auto& row : chain.joints) joints.push_back(add(b, row));
  const auto rows = b.CreateVector(joints);
  const auto base = to_wire(chain.base), tool = to_wire(chain.tool);
  const auto base_twist = to_wire(chain.base_twist), tool_twist = to_wire(chain.tool_twist);
  Offset<flatbuffers::Vector<const wire::Coupling*>> coupling;
  if (!chain.coupling.empty()) {
    std::vector<wire::Coupling> each;
    for (const auto& one : chain.coupling) each.emplace_back(one.ratio, one.joint, one.by);
    coupling = b.CreateVectorOfStructs(each);
  }
  return wire::CreateChain(b, static_cast<wire::Convention>(chain.convention), &base, &base_twist,
                           rows, &tool_twist, &tool, coupling);
}

/// Returns null if the effect has no formula.
Offset<wire::Formula> add(Builder& b, const Formula& f) {
  if (f == Formula{}) return {};
  std::vector<Offset<wire::FormulaParameter>> each;
  for (const auto& p : f.parameters) {
    const auto name = b.CreateString(p.name), unit = b.CreateString(p.unit);
    each.push_back(wire::CreateFormulaParameter(b, name, unit, p.typical, p.start));
  }
  const auto name = b.CreateString(f.name);
  const auto expression = b.CreateString(f.expression);
  const auto code = b.CreateVector(f.code);
  const auto literals = b.CreateVector(f.literals);
  return wire::CreateFormula(b, name, static_cast<std::uint8_t>(f.target), f.joint, f.component,
                             f.domain, expression, code, literals, b.CreateVector(each));
}

Offset<wire::Effect> add(Builder& b, const Effect& effect) {
  std::vector<Offset<wire::ContextNeed>> needs;
  for (const auto& need : effect.context)
    needs.push_back(wire::CreateContextNeed(b, static_cast<wire::ContextInput>(need.input),
                                            b.CreateString(need.name), need.fallback));
  const auto name = b.CreateString(effect.name);
  const auto joints = b.CreateVector(effect.joints);
  const auto parameters = b.CreateVector(effect.parameters);
  const auto context = b.CreateVector(needs);
  Offset<flatbuffers::Vector<double>> constants;
  if (!effect.constants.empty()) constants = b.CreateVector(effect.constants);
  const auto formula = add(b, effect.formula);
  return wire::CreateEffect(b, name, effect.version, joints, parameters, context, constants,
                            formula);
}

/// Returns null if no masses are known.
Offset<wire::Mechanics> add(Builder& b, const Mechanics& m) {
  if (m == Mechanics{}) return {};
  std::vector<wire::LinkMass> links;
  for (const auto& link : m.links)
    links.emplace_back(link.mass_kg, link.com_m[0], link.com_m[1], link.com_m[2]);
  const auto& c = m.payload_com_m;
  return wire::CreateMechanics(b, b.CreateVectorOfStructs(links), m.payload_kg, c[0], c[1], c[2]);
}

/// True if the tree needs schema 2. A reader of schema 1 ignores what it does not know and would
/// evaluate the tree as a crisp, affine one.
bool needs_schema_2(const Tree& tree) {
  return !tree.blend_half_width.empty() || tree.degree != 1 || !tree.directions.empty() ||
         !tree.region.empty();
}

/// The smallest schema that every reader of it evaluates correctly. Joint couplings need schema 3:
/// a reader of an older one would take the controller's joint values for angles.
unsigned schema_of(const Model& m) {
  if (!m.nominal.coupling.empty()) return 3;
  return std::any_of(m.trees.begin(), m.trees.end(), needs_schema_2) ? 2 : 1;
}

Offset<wire::Tree> add(Builder& b, const Tree& tree) {
  std::vector<wire::Node> nodes;
  for (const auto& n : tree.nodes)
    nodes.emplace_back(n.threshold, n.input, n.low, n.high, n.reserved);
  const auto inner = b.CreateVectorOfStructs(nodes);
  const auto coefficients = b.CreateVector(tree.coefficients);
  const auto bounds = b.CreateVector(tree.bounds);
  const auto half_width = b.CreateVector(tree.blend_half_width);
  const auto directions = tree.directions.empty() ? 0 : b.CreateVector(tree.directions);
  const auto region = tree.region.empty() ? 0 : b.CreateVector(tree.region);
  const auto sigma = tree.sigma.empty() ? 0 : b.CreateVector(tree.sigma);
  wire::TreeBuilder out(b);
  if (!sigma.IsNull()) out.add_sigma(sigma);
  if (!region.IsNull()) out.add_region(region);
  if (!directions.IsNull()) out.add_directions(directions);
  out.add_blend_half_width(half_width);
  out.add_bounds(bounds);
  out.add_coefficients(coefficients);
  out.add_nodes(inner);
  out.add_depth(tree.depth);
  if (tree.degree != 1) out.add_degree(tree.degree);
  return out.Finish();
}

Offset<wire::Domain> add(Builder& b, const Domain& d) {
  const auto q_min = b.CreateVector(d.q_min), q_max = b.CreateVector(d.q_max);
  Offset<flatbuffers::Vector<Offset<wire::ContextRange>>> context;
  if (!d.context.empty()) {
    std::vector<Offset<wire::ContextRange>> ranges;
    for (const auto& r : d.context)
      ranges.push_back(wire::CreateContextRange(b, static_cast<wire::ContextInput>(r.input),
                                                b.CreateString(r.name), r.low, r.high));
    context = b.CreateVector(ranges);
  }
  return wire::CreateDomain(b, q_min, q_max, d.fade, context);
}

Offset<wire::Guard> add(Builder& b, const GuardLimits& g) {
  return wire::CreateGuard(b, static_cast<wire::Corrects>(g.corrects), g.max_correction_m,
                           g.max_rotation_rad, g.slew_m_per_s, g.slew_rad_per_s, g.ramp_s,
                           g.cycle_s, g.length_scale_m, g.min_singular_value, g.max_seed_distance);
}

Offset<wire::Provenance> add(Builder& b, const Provenance& p) {
  std::vector<Offset<wire::InputHash>> inputs;
  for (const auto& input : p.inputs) {
    // In a fixed order, so that the same model gives the same bytes with every compiler. (As
    // function arguments, the compiler would choose the order.)
    const auto sha256 = b.CreateString(input.sha256);
    const auto name = b.CreateString(input.name);
    inputs.push_back(wire::CreateInputHash(b, name, sha256));
  }
  const auto& h = p.held_out;
  const auto held_out = wire::CreateHeldOut(b, h.poses, h.mean_m, h.rms_m, h.p95_m, h.max_m);
  const auto version = b.CreateString(p.tool_version);
  const auto created = b.CreateString(p.created);
  const auto run = b.CreateString(p.run);
  const auto files = b.CreateVector(inputs);
  const auto names = b.CreateVectorOfStrings(p.parameter_names);
  return wire::CreateProvenance(b, version, created, run, files, p.poses_fit, held_out,
                                p.noise_floor_m, names, b.CreateVector(p.covariance));
}

Offset<wire::Model> add(Builder& b, const Model& m) {
  const auto nominal = add(b, m.nominal), calibrated = add(b, m.calibrated);
  std::vector<Offset<wire::Effect>> effects;
  for (const auto& effect : m.effects) effects.push_back(add(b, effect));
  std::vector<Offset<wire::Tree>> trees;
  for (const auto& tree : m.trees) trees.push_back(add(b, tree));
  const auto domain = add(b, m.domain);
  const auto guard = add(b, m.guard);
  const auto provenance = add(b, m.provenance);
  const auto mechanics = add(b, m.mechanics);
  const auto cell = b.CreateString(m.cell_name);
  const auto robot = b.CreateString(m.robot_name);
  const auto serial = b.CreateString(m.serial);
  const auto all_effects = b.CreateVector(effects);
  const auto all_trees = b.CreateVector(trees);
  return wire::CreateModel(b, schema_of(m), cell, robot, serial, m.gravity[0], m.gravity[1],
                           m.gravity[2], nominal, calibrated, all_effects, all_trees, domain, guard,
                           provenance, mechanics);
}

}  // namespace

std::vector<std::byte> write_model(const Model& model) {
  if (const auto finding = internal::unsoundness(model)) throw std::invalid_argument(*finding);
  Builder builder;
  builder.ForceDefaults(true);
  wire::FinishModelBuffer(builder, add(builder, model));
  const auto* begin = reinterpret_cast<const std::byte*>(builder.GetBufferPointer());
  std::vector<std::byte> bytes(begin, begin + builder.GetSize());
  bytes.resize((bytes.size() + 7) / 8 * 8);
  internal::append_trailer(bytes);
  return bytes;
}

}  // namespace plumb::format

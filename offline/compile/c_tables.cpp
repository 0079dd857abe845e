// SPDX-License-Identifier: Apache-2.0
#include "compile/c_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "compile/c_text.hpp"
#include "plumb/runtime/detail/tree.hpp"

namespace plumb::offline {
namespace {

using format::Tree;

/// ForwardModel::tree_error refuses larger joint positions [rad] or [m].
constexpr double kMaxPosition = 1e4;

constexpr char kAxisNames[] = "xyz";

bool same_shape(const Tree& a, const Tree& b) {
  return a.nodes == b.nodes && a.blend_half_width == b.blend_half_width &&
         a.directions == b.directions;
}

/// Trees that differ in how they cut the domain, and which of them each axis has; -1: none.
struct Shapes {
  std::vector<const Tree*> all;
  std::array<int, format::kTreeAxes> of_axis{};
};

Shapes shapes_of(const format::Model& model) {
  Shapes out;
  for (std::size_t axis = 0; axis < model.trees.size(); ++axis) {
    const Tree& tree = model.trees[axis];
    const auto same = std::find_if(out.all.begin(), out.all.end(),
                                   [&](const Tree* t) { return same_shape(*t, tree); });
    out.of_axis[axis] = tree.leaves() == 0 ? -1 : static_cast<int>(same - out.all.begin());
    if (tree.leaves() > 0 && same == out.all.end()) out.all.push_back(&tree);
  }
  return out;
}

/// A table, if it has numbers; returns its name, or 0 for none.
std::string put_table(const std::string& name, const std::vector<double>& numbers, std::size_t row,
                      std::string& out) {
  if (numbers.empty()) return "0";
  out += c_table(name, numbers, row) + "\n";
  return name;
}

std::string put_nodes(const std::string& name, const Tree& tree, std::string& out) {
  if (tree.nodes.empty()) return "0";
  out += fmt::format("static const @_node {}[{}] = {{\n", name, tree.nodes.size());
  for (const auto& node : tree.nodes)
    out += fmt::format("    {{{}, {}, {}, {}}},\n", c_number(node.threshold), node.input, node.low,
                       node.high);
  out += "};\n\n";
  return name;
}

std::string shape_tables(const Shapes& shapes, std::size_t joints) {
  std::string out, rows;
  for (std::size_t s = 0; s < shapes.all.size(); ++s) {
    const Tree& tree = *shapes.all[s];
    const std::string nodes = put_nodes(fmt::format("@_nodes_{}", s), tree, out);
    const std::string widths =
        put_table(fmt::format("@_half_width_{}", s), tree.blend_half_width, tree.nodes.size(), out);
    const std::string directions =
        put_table(fmt::format("@_direction_{}", s), tree.directions, joints, out);
    rows += fmt::format("    {{{}, {}, {}, {}}},\n", nodes, widths, directions, tree.leaves());
  }
  return out + fmt::format("static const @_shape @_shapes[@_shape_count] = {{\n{}}};\n\n", rows);
}

std::string leaf_tables(const format::Model& model, const Shapes& shapes, std::size_t joints) {
  std::string out, rows;
  for (std::size_t axis = 0; axis < model.trees.size(); ++axis) {
    const Tree& tree = model.trees[axis];
    const char name = kAxisNames[axis];
    const std::size_t terms = format::leaf_terms(joints, tree.degree);
    const std::string coefficients =
        put_table(fmt::format("@_coefficient_{}", name), tree.coefficients, terms, out);
    const std::string bounds = put_table(fmt::format("@_bound_{}", name), tree.bounds, 2, out);
    const std::string region = put_table(fmt::format("@_region_{}", name),
                                         {tree.region.begin(), tree.region.end()}, 2 * joints, out);
    rows += fmt::format("    {{{}, {}, {}, {}, {}}}, /* {} */\n", shapes.of_axis[axis], terms,
                        coefficients, bounds, region, name);
  }
  return out + fmt::format("static const @_tree @_trees[3] = {{\n{}}};\n\n", rows);
}

std::string scalar(const std::string& name, double value) {
  return fmt::format("static const double {} = {};\n", name, c_number(value));
}

/// The same numbers as those of TrainedDomain.
std::string domain_tables(const format::Domain& domain) {
  std::vector<double> middle, half_inverse;
  for (std::size_t i = 0; i < domain.q_min.size(); ++i) {
    const double low = domain.q_min[i], high = domain.q_max[i];
    middle.push_back(0.5 * (low + high));
    half_inverse.push_back(2.0 / (high - low));
  }
  return "/* u = (q - middle) * half_inverse is in -1 .. 1 inside the trained domain. */\n" +
         c_table("@_middle", middle, middle.size()) +
         c_table("@_half_inverse", half_inverse, half_inverse.size()) +
         scalar("@_fade_inverse", 1.0 / (2.0 * domain.fade)) +
         scalar("@_max_position", kMaxPosition) + scalar("@_region_fade", kRegionFade) +
         scalar("@_ramp_end", internal::kRampEnd) + scalar("@_soft_share", kSoftShare) + "\n";
}

}  // namespace

CTables c_tables(const format::Model& model) {
  const std::size_t joints = model.domain.q_min.size();
  const Shapes shapes = shapes_of(model);
  std::size_t terms = 0;
  for (const Tree& tree : model.trees)
    if (tree.leaves() > 0) terms = std::max(terms, format::leaf_terms(joints, tree.degree));
  return {.sizes = fmt::format(
              "enum {{ @_joints = {}, @_terms = {}, @_room = {}, @_shape_count = {} }};\n\n",
              joints, terms, format::kMaxActiveLeaves, shapes.all.size()),
          .tables = domain_tables(model.domain) + shape_tables(shapes, joints) +
                    leaf_tables(model, shapes, joints)};
}

}  // namespace plumb::offline

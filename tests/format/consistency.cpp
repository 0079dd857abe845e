// SPDX-License-Identifier: Apache-2.0
#include "consistency.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace plumb::format {
namespace {

/// Visits every node and leaf below `node`; false if one is outside, met twice, or too deep.
bool visit(const Tree& tree, int node, int depth, std::set<int>& met) {
  if (depth > tree.depth || !met.insert(node).second) return false;
  if (node < 0) return 2 * static_cast<std::size_t>(~node) + 2 <= tree.bounds.size();
  if (static_cast<std::size_t>(node) >= tree.nodes.size()) return false;
  const TreeNode& n = tree.nodes[static_cast<std::size_t>(node)];
  return n.low != 0 && n.high != 0 && visit(tree, n.low, depth + 1, met) &&
         visit(tree, n.high, depth + 1, met);
}

/// The value for inputs u, as model.hpp states it; only after visit().
long double value(const Tree& tree, const std::vector<double>& u) {
  int at = tree.nodes.empty() ? ~0 : 0;
  while (at >= 0) {
    const TreeNode& n = tree.nodes.at(static_cast<std::size_t>(at));
    at = u.at(n.input) <= n.threshold ? n.low : n.high;
  }
  const auto leaf = static_cast<std::size_t>(~at);
  long double sum = tree.coefficients.at(leaf * (u.size() + 1));
  for (std::size_t i = 0; i < u.size(); ++i)
    sum += static_cast<long double>(tree.coefficients.at(leaf * (u.size() + 1) + i + 1)) * u[i];
  return std::clamp<long double>(sum, tree.bounds.at(2 * leaf), tree.bounds.at(2 * leaf + 1));
}

std::string of_tree(const Tree& tree, std::size_t joints) {
  const std::size_t leaves = tree.nodes.size() + 1;
  if (tree.bounds.size() != 2 * leaves) return "tree: leaves";
  if (tree.coefficients.size() != leaves * (joints + 1)) return "tree: coefficients";
  std::set<int> met;
  if (!visit(tree, tree.nodes.empty() ? ~0 : 0, 0, met)) return "tree: walk";
  if (met.size() != tree.nodes.size() + leaves) return "tree: unreached";
  for (const auto& n : tree.nodes)
    if (n.input >= joints || !std::isfinite(n.threshold)) return "tree: node";
  for (std::size_t i = 0; i < tree.bounds.size(); i += 2)
    if (!(tree.bounds[i] <= tree.bounds[i + 1])) return "tree: bounds";
  for (double u : {-1.0, -0.3, 0.0, 0.7, 1.0})
    if (!(std::abs(value(tree, std::vector<double>(joints, u))) <= 1.0L)) return "tree: value";
  return {};
}

/// Walks the code with the count of numbers alone; operations by their codes in the file.
std::string of_formula(const Effect& effect, std::size_t joints) {
  const Formula& f = effect.formula;
  if ((effect.name == "formula") == f.code.empty()) return "formula: whose";
  std::size_t sensors = 0;
  for (const auto& need : effect.context) sensors += need.input == ContextInput::kTemperature;
  int numbers = 0, most = 0;
  for (const unsigned code : f.code) {
    const unsigned op = code % 256, which = code / 256;
    const std::size_t there = op == 0              ? f.literals.size()
                              : op == 1            ? effect.parameters.size()
                              : op >= 2 && op <= 6 ? joints
                              : op == 8            ? sensors
                              : op == 10           ? 3
                                                   : 1;
    if (op > 29 || which >= there) return "formula: operation";
    const int needed = op == 29 ? 3 : op >= 22 ? 2 : op >= 12 ? 1 : 0;
    if (numbers < needed) return "formula: stack";
    numbers += 1 - needed;
    most = std::max(most, numbers);
  }
  if (!f.code.empty() && (numbers != 1 || most > 24 || f.joint >= joints)) return "formula: result";
  for (double x : f.literals)
    if (!std::isfinite(x)) return "formula: literal";
  return {};
}

std::string of_chain(const Chain& chain) {
  double sum = 0.0;  // finite only if every part is
  for (const auto& j : chain.joints) {
    if (!(j.q_min < j.q_max)) return "joint limits";
    if (j.type != JointType::kRevolute && j.type != JointType::kPrismatic) return "joint type";
    if (!(j.scale > 0.1)) return "scale";
    sum += j.alpha + j.a + j.d + j.theta + j.beta + j.scale + j.offset + j.q_min + j.q_max;
    for (const auto& twist : {j.pre, j.post})
      for (std::size_t k = 0; k < 3; ++k) sum += twist.d[k] + twist.e[k];
  }
  for (const auto& twist : {chain.base_twist, chain.tool_twist})
    for (std::size_t k = 0; k < 3; ++k) sum += twist.d[k] + twist.e[k];
  for (const auto& pose : {chain.base, chain.tool}) {
    sum += pose.p[0] + pose.p[1] + pose.p[2];
    const auto& q = pose.q;
    const double norm2 = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    if (!(std::abs(norm2 - 1.0) < 1e-8)) return "quaternion";
  }
  return std::isfinite(sum) ? "" : "chain: not finite";
}

std::string of_effects(const Model& m) {
  for (const auto& effect : m.effects) {
    if (effect.name.empty() || effect.version == 0) return "effect";
    for (auto joint : effect.joints)
      if (joint >= m.nominal.joints.size()) return "effect: joint";
    for (double x : effect.parameters)
      if (!std::isfinite(x)) return "effect: parameter";
    for (const auto& need : effect.context)
      if (!std::isfinite(need.fallback) || static_cast<int>(need.input) > 4)
        return "effect: context";
    if (auto what = of_formula(effect, m.nominal.joints.size()); !what.empty()) return what;
  }
  return {};
}

std::string of_guard(const GuardLimits& g) {
  for (double x : {g.max_correction_m, g.max_rotation_rad, g.slew_m_per_s, g.slew_rad_per_s,
                   g.cycle_s, g.length_scale_m, g.min_singular_value, g.max_seed_distance})
    if (!(x > 0.0) || !std::isfinite(x)) return "guard";
  return g.ramp_s >= 0.0 && std::isfinite(g.ramp_s) && static_cast<int>(g.corrects) <= 1 ? ""
                                                                                         : "guard";
}

}  // namespace

std::string inconsistency(const Model& m) {
  const std::size_t n = m.nominal.joints.size();
  if (n < 1 || n > kMaxJoints || m.calibrated.joints.size() != n) return "joints";
  for (double g : m.gravity)
    if (!std::isfinite(g)) return "gravity";
  for (const auto& what :
       {of_chain(m.nominal), of_chain(m.calibrated), of_effects(m), of_guard(m.guard)})
    if (!what.empty()) return what;
  bool any = !m.domain.q_min.empty() || !m.domain.q_max.empty();
  for (const auto& tree : m.trees) {
    if (tree.bounds.empty() && tree.nodes.empty() && tree.coefficients.empty()) continue;
    any = true;
    if (auto what = of_tree(tree, n); !what.empty()) return what;
  }
  if (any && (m.domain.q_min.size() != n || m.domain.q_max.size() != n)) return "domain";
  for (std::size_t i = 0; any && i < n; ++i)
    if (!std::isfinite(2.0 / (m.domain.q_max[i] - m.domain.q_min[i])) ||
        !(m.domain.q_min[i] < m.domain.q_max[i]))
      return "domain: span";
  const std::size_t k = m.provenance.parameter_names.size();
  const std::size_t entries = m.provenance.covariance.size();
  if (entries != 0 && entries != k * (k + 1) / 2) return "covariance";
  for (float x : m.provenance.covariance)
    if (!std::isfinite(x)) return "covariance: not finite";
  return {};
}

}  // namespace plumb::format

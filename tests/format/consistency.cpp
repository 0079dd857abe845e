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

/// Products u_i u_k, i <= k, counted one by one.
std::size_t terms_of(std::size_t joints, int degree) {
  std::size_t out = 1 + joints;
  for (std::size_t i = 0; degree == 2 && i < joints; ++i) out += joints - i;
  return out;
}

/// A tree's value for inputs u, as model.hpp and tree.hpp state it; only after the sizes and
/// visit(). The sum goes over every leaf with a validity, however many.
class Reading {
 public:
  Reading(const Tree& tree, const std::vector<double>& u) : tree_(tree), u_(u) {
    terms_.push_back(1.0L);
    terms_.insert(terms_.end(), u.begin(), u.end());
    for (std::size_t i = 0; tree.degree == 2 && i < u.size(); ++i)
      for (std::size_t k = i; k < u.size(); ++k)
        terms_.push_back(static_cast<long double>(u[i]) * u[k]);
    descend(tree.nodes.empty() ? ~0 : 0, 1.0L);
  }

  long double value() const {
    const long double margin = blended() ? 0.1L * (high_ - low_) : 0.0L;
    long double y = std::clamp(y_, low_, high_);
    if (margin > 0.0L && y_ > high_) y += margin * (y_ - high_) / (margin + y_ - high_);
    if (margin > 0.0L && y_ < low_) y -= margin * (low_ - y_) / (margin + low_ - y_);
    return y * trust_;
  }

 private:
  bool blended() const { return !tree_.blend_half_width.empty(); }

  void descend(int at, long double validity) {
    if (!(validity > 0.0L)) return;
    if (at < 0) return speak(static_cast<std::size_t>(~at), validity);
    const auto index = static_cast<std::size_t>(at);
    const TreeNode& n = tree_.nodes.at(index);
    long double x = u_.at(n.input);
    if (!tree_.directions.empty()) {
      x = 0.0L;
      for (std::size_t i = 0; i < u_.size(); ++i)
        x += static_cast<long double>(tree_.directions.at(index * u_.size() + i)) * u_[i];
    }
    long double high = x <= n.threshold ? 0.0L : 1.0L;
    if (blended()) {
      const long double h = tree_.blend_half_width.at(index);
      const long double s = std::clamp((x - n.threshold + h) / (2.0L * h), 0.0L, 1.0L);
      high = s * s * (3.0L - 2.0L * s);
    }
    descend(n.low, validity * (1.0L - high));
    descend(n.high, validity * high);
  }

  void speak(std::size_t leaf, long double validity) {
    for (std::size_t i = 0; i < terms_.size(); ++i)
      y_ += validity * tree_.coefficients.at(leaf * terms_.size() + i) * terms_[i];
    low_ += validity * tree_.bounds.at(2 * leaf);
    high_ += validity * tree_.bounds.at(2 * leaf + 1);
    long double trust = validity;
    for (std::size_t i = 0; !tree_.region.empty() && i < u_.size(); ++i) {
      const std::size_t side = (leaf * u_.size() + i) * 2;
      const long double below = tree_.region.at(side) - static_cast<long double>(u_[i]);
      const long double above = u_[i] - static_cast<long double>(tree_.region.at(side + 1));
      const long double s = std::clamp(1.0L - std::max(below, above) / 0.1L, 0.0L, 1.0L);
      trust *= s * s * (3.0L - 2.0L * s);
    }
    trust_ += trust;
  }

  const Tree& tree_;
  const std::vector<double>& u_;
  std::vector<long double> terms_;
  long double y_ = 0.0L, low_ = 0.0L, high_ = 0.0L, trust_ = 0.0L;
};

std::string of_sizes(const Tree& tree, std::size_t joints) {
  const std::size_t nodes = tree.nodes.size(), leaves = nodes + 1;
  const auto all_or_none = [](const auto& x, std::size_t size) {
    return x.empty() || x.size() == size;
  };
  if (tree.degree != 1 && tree.degree != 2) return "tree: degree";
  if (tree.bounds.size() != 2 * leaves) return "tree: leaves";
  if (tree.coefficients.size() != leaves * terms_of(joints, tree.degree))
    return "tree: coefficients";
  if (!all_or_none(tree.blend_half_width, nodes)) return "tree: half widths";
  if (!all_or_none(tree.directions, nodes * joints)) return "tree: directions";
  if (!all_or_none(tree.region, 2 * leaves * joints)) return "tree: regions";
  return all_or_none(tree.sigma, leaves) ? "" : "tree: sigmas";
}

std::string of_numbers(const Tree& tree, std::size_t joints) {
  for (const auto& n : tree.nodes)
    if (n.input >= joints || !std::isfinite(n.threshold)) return "tree: node";
  for (std::size_t i = 0; i < tree.bounds.size(); i += 2)
    if (!(tree.bounds[i] <= tree.bounds[i + 1])) return "tree: bounds";
  for (double h : tree.blend_half_width)
    if (!std::isfinite(1.0 / h) || !(h > 0.0 && h <= 2.0)) return "tree: half width";
  for (std::size_t i = 0; i < tree.directions.size(); i += joints) {
    long double length = 0.0L;
    for (std::size_t k = i; k < i + joints; ++k) length += std::abs(tree.directions[k]);
    if (!(std::abs(length - 1.0L) < 1e-8L)) return "tree: direction";
  }
  for (std::size_t i = 0; i < tree.region.size(); i += 2)
    if (!(tree.region[i] <= tree.region[i + 1]) ||
        !std::isfinite(tree.region[i + 1] - tree.region[i]))
      return "tree: region";
  for (float sigma : tree.sigma)
    if (!(sigma >= 0.0F) || !std::isfinite(sigma)) return "tree: sigma";
  return {};
}

std::string of_tree(const Tree& tree, std::size_t joints) {
  if (auto what = of_sizes(tree, joints); !what.empty()) return what;
  std::set<int> met;
  if (!visit(tree, tree.nodes.empty() ? ~0 : 0, 0, met)) return "tree: walk";
  if (met.size() != 2 * tree.nodes.size() + 1) return "tree: unreached";
  if (auto what = of_numbers(tree, joints); !what.empty()) return what;
  // Bounds of 1 m, and a tenth of their range beyond.
  for (double u : {-1.0, -0.3, 0.0, 0.7, 1.0})
    if (!(std::abs(Reading(tree, std::vector<double>(joints, u)).value()) <= 1.2L))
      return "tree: value";
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
    if (tree == Tree{} || tree == Tree{.degree = 2}) continue;
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

// SPDX-License-Identifier: Apache-2.0
#include "random_model.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace plumb::format {
namespace {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  int between(int low, int high) {
    return low + static_cast<int>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }
  std::array<double, 3> vector(double size) {
    return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
  }
  Twist twist() { return {vector(0.01), vector(0.01)}; }
  Pose pose() {
    std::array<double, 4> q{uniform(0.1, 1.0), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
    const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (double& x : q) x /= norm;
    return {vector(3.0), q};
  }

 private:
  std::mt19937_64 engine_;
};

JointRow joint(Random& random, int number) {
  JointRow out;
  out.name = "J" + std::to_string(number);
  for (double* x : {&out.alpha, &out.theta, &out.beta}) *x = random.uniform(-3.0, 3.0);
  for (double* x : {&out.a, &out.d}) *x = random.uniform(-2.0, 2.0);
  out.scale = random.uniform(0.9, 1.1);
  out.offset = random.uniform(-0.1, 0.1);
  out.q_min = random.uniform(-4.0, -1.0);
  out.q_max = random.uniform(1.0, 4.0);
  out.pre = random.twist();
  out.post = random.twist();
  return out;
}

Chain chain(Random& random, int joints) {
  Chain out;
  for (int i = 0; i < joints; ++i) out.joints.push_back(joint(random, i + 1));
  out.base = random.pose();
  out.base_twist = random.twist();
  out.tool = random.pose();
  out.tool_twist = random.twist();
  return out;
}

/// Splits the subtree of `leaves` leaves at a random place; returns what the parent points at.
int grow(Random& random, Tree& tree, int joints, int leaves, int& next_leaf, int depth) {
  tree.depth = std::max(tree.depth, static_cast<std::uint16_t>(depth));
  if (leaves == 1) return ~next_leaf++;
  const std::size_t here = tree.nodes.size();
  tree.nodes.push_back({.threshold = random.uniform(-1.0, 1.0),
                        .input = static_cast<std::uint16_t>(random.between(0, joints - 1))});
  const int low = random.between(std::max(1, leaves / 4), std::max(1, leaves - leaves / 4 - 1));
  const int child = grow(random, tree, joints, low, next_leaf, depth + 1);
  tree.nodes[here].low = static_cast<std::int16_t>(child);
  const int other = grow(random, tree, joints, leaves - low, next_leaf, depth + 1);
  tree.nodes[here].high = static_cast<std::int16_t>(other);
  return static_cast<int>(here);
}

/// What a tree has beside its nodes, thresholds and bounds.
struct Kind {
  bool blended, quadratic, oblique, region, sigma;
};

Kind kind(Random& random) {
  const int bits = random.between(0, 31);
  return {(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0, (bits & 16) != 0};
}

/// Sum of absolute values 1.
void add_direction(Random& random, int joints, Tree& tree) {
  std::vector<double> direction;
  double length = 0.0;
  for (int i = 0; i < joints; ++i) {
    direction.push_back(random.uniform(-1.0, 1.0));
    length += std::abs(direction.back());
  }
  for (double x : direction) tree.directions.push_back(x / length);
}

void add_kind(Random& random, const Kind& kind, int joints, int leaves, Tree& out) {
  out.degree = kind.quadratic ? 2 : 1;
  for (auto& node : out.nodes) {
    if (kind.blended) out.blend_half_width.push_back(random.uniform(1e-6, 2.0));
    if (!kind.oblique) continue;
    add_direction(random, joints, out);
    node.input = 0;
  }
  for (int i = 0; kind.region && i < leaves * joints; ++i) {
    out.region.push_back(static_cast<float>(random.uniform(-1.5, 0.0)));
    out.region.push_back(static_cast<float>(random.uniform(0.0, 1.5)));
  }
  for (int i = 0; kind.sigma && i < leaves; ++i)
    out.sigma.push_back(static_cast<float>(random.uniform(0.0, 1e-3)));
}

Tree tree(Random& random, const Kind& kind, int joints, int leaves) {
  Tree out;
  if (leaves == 0) return out;
  int next_leaf = 0;
  grow(random, out, joints, leaves, next_leaf, 0);
  add_kind(random, kind, joints, leaves, out);
  const int terms = 1 + joints + (kind.quadratic ? joints * (joints + 1) / 2 : 0);
  for (int i = 0; i < leaves * terms; ++i) out.coefficients.push_back(random.uniform(-1e-3, 1e-3));
  for (int i = 0; i < leaves; ++i) {
    out.bounds.push_back(random.uniform(-1e-3, 0.0));
    out.bounds.push_back(random.uniform(0.0, 1e-3));
  }
  return out;
}

Effect effect(Random& random, int joints, int parameters) {
  Effect out{.name = "effect_" + std::to_string(random.between(0, 99)),
             .version = static_cast<std::uint32_t>(random.between(1, 9)),
             .joints = {},
             .parameters = {},
             .context = {}};
  for (int i = 0; i < joints; ++i) out.joints.push_back(static_cast<std::uint8_t>(i));
  for (int i = 0; i < parameters; ++i) out.parameters.push_back(random.uniform(-1e9, 1e9));
  for (int i = 0; i <= 3; ++i)
    out.context.push_back({static_cast<ContextInput>(i), i == 2 ? "Öl" : "", random.uniform(0, 9)});
  return out;
}

Provenance provenance(Random& random, int parameters) {
  Provenance out;
  out.tool_version = "9.8.7";
  out.created = "2026-11-20T12:00:00Z";
  out.run = std::to_string(random.between(1, 9999));
  for (int i = random.between(0, 3); i >= 0; --i)
    out.inputs.push_back({"série " + std::to_string(i) + ".csv", std::string(64, 'f')});
  out.poses_fit = static_cast<std::uint32_t>(random.between(1, 100000));
  const double mean = random.uniform(0.0, 1e-3);
  out.held_out = {static_cast<std::uint32_t>(random.between(1, 9999)), mean, 1.1 * mean, 2.0 * mean,
                  3.0 * mean};
  out.noise_floor_m = random.uniform(0.0, 1e-4);
  for (int i = 0; i < parameters; ++i) {
    out.parameter_names.push_back("p" + std::to_string(i));
    for (int k = 0; k <= i; ++k)
      out.covariance.push_back(static_cast<float>(random.uniform(0.0, 1e-8)));
  }
  return out;
}

struct Sizes {
  int joints, leaves, effects, effect_parameters, parameters;
};

Model model(Random& random, const Sizes& sizes, const std::array<Kind, kTreeAxes>& kinds) {
  Model m;
  m.cell_name = "Zelle 4 — 東";
  m.robot_name = "R";
  m.serial = std::to_string(random.between(0, 1 << 30));
  m.gravity = random.vector(9.81);
  m.nominal = chain(random, sizes.joints);
  m.calibrated = chain(random, sizes.joints);
  const auto convention = static_cast<Convention>(random.between(0, 1));
  m.nominal.convention = m.calibrated.convention = convention;
  for (std::size_t i = 0; i < m.nominal.joints.size(); ++i) {
    const auto type = static_cast<JointType>(random.between(0, 1));
    m.nominal.joints[i].type = m.calibrated.joints[i].type = type;
    m.domain.q_min.push_back(random.uniform(-3.0, -1.0));
    m.domain.q_max.push_back(random.uniform(1.0, 3.0));
  }
  m.domain.fade = random.uniform(0.01, 1.0);
  for (int i = 0; i < sizes.effects; ++i)
    m.effects.push_back(effect(random, sizes.joints, sizes.effect_parameters));
  for (std::size_t axis = 0; axis < kinds.size(); ++axis)
    m.trees[axis] = tree(random, kinds[axis], sizes.joints, sizes.leaves);
  m.guard = {.corrects = static_cast<Corrects>(random.between(0, 1)),
             .max_correction_m = random.uniform(1e-4, 1e-2),
             .max_rotation_rad = random.uniform(1e-3, 0.1),
             .slew_m_per_s = random.uniform(1e-3, 1.0),
             .slew_rad_per_s = random.uniform(1e-3, 1.0),
             .ramp_s = random.uniform(0.0, 10.0),
             .cycle_s = random.uniform(1e-3, 0.1),
             .length_scale_m = random.uniform(0.1, 4.0),
             .min_singular_value = random.uniform(1e-3, 0.1),
             .max_seed_distance = random.uniform(0.05, 1.0)};
  m.provenance = provenance(random, sizes.parameters);
  return m;
}

}  // namespace

Model random_model(std::uint64_t seed) {
  Random random(seed);
  const Sizes sizes{.joints = random.between(1, kMaxJoints),
                    .leaves = random.between(0, 40),
                    .effects = random.between(0, 5),
                    .effect_parameters = random.between(0, 12),
                    .parameters = random.between(0, 40)};
  return model(random, sizes, {kind(random), kind(random), kind(random)});
}

Model largest_model() {
  Random random(1);
  std::array<Kind, kTreeAxes> everything;
  everything.fill({true, true, true, true, true});
  return model(random,
               {kMaxJoints, kMaxTreeLeaves, kMaxEffects, kMaxEffectParameters, kMaxParameters},
               everything);
}

}  // namespace plumb::format

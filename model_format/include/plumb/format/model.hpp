// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "plumb/format/limits.hpp"

/// The content of a model file as plain structs. SI units: [m], [rad], [s].
///
/// What `read_model` returns has passed the verifier and the semantic check: every number is
/// finite, every index in range, every tree acyclic. Nothing here computes.
namespace plumb::format {

/// Which end of the link a DH row describes.
/// Standard (distal): Rz(theta) Tz(d) Tx(a) Rx(alpha). Modified (Craig): Rx(alpha) Tx(a) Rz Tz.
enum class Convention : std::uint8_t { kStandard = 0, kModified = 1 };

enum class JointType : std::uint8_t { kRevolute = 0, kPrismatic = 1 };

/// Rigid transform: translation [m] and unit quaternion (w, x, y, z).
struct Pose {
  std::array<double, 3> p{};
  std::array<double, 4> q{1.0, 0.0, 0.0, 0.0};
  bool operator==(const Pose&) const = default;
};

/// Small rigid motion, Exp(xi): displacement d [m] and rotation e [rad].
struct Twist {
  std::array<double, 3> d{};
  std::array<double, 3> e{};
  bool operator==(const Twist&) const = default;
};

/// One joint: q' = scale * q + offset turns (or slides) about z;
/// the link is Tx(a) Rx(alpha) Ry(beta), beta being Hayati's angle for near-parallel neighbours.
struct JointRow {
  std::string name;
  JointType type = JointType::kRevolute;
  double alpha = 0.0;   // [rad]
  double a = 0.0;       // [m]
  double d = 0.0;       // [m]
  double theta = 0.0;   // [rad]
  double beta = 0.0;    // [rad]
  double scale = 1.0;   // encoder scale s_i
  double offset = 0.0;  // encoder offset o_i [rad] or [m]
  double q_min = 0.0;   // [rad] or [m]
  double q_max = 0.0;
  Twist pre;   // before the joint motion
  Twist post;  // after the joint motion
  bool operator==(const JointRow&) const = default;
};

/// T = base * Exp(base_twist) * prod_i [A_i Exp(pre_i) Joint_i(q_i') Exp(post_i) B_i]
///       * Exp(tool_twist) * tool
struct Chain {
  Convention convention = Convention::kStandard;
  Pose base;
  Twist base_twist;
  std::vector<JointRow> joints;
  Twist tool_twist;
  Pose tool;
  bool operator==(const Chain&) const = default;
};

/// What an effect must be told in the cycle besides the joint positions.
enum class ContextInput : std::uint8_t {
  kDirection = 0,
  kPayload = 1,
  kTemperature = 2,
  kTime = 3,
  kTravel = 4
};

struct ContextNeed {
  ContextInput input = ContextInput::kDirection;
  std::string name;       // which temperature; empty otherwise
  double fallback = 0.0;  // used when the input is missing or stale, SI
  bool operator==(const ContextNeed&) const = default;
};

/// Operations of a formula's stack code. An instruction is one of them + 256 x operand.
/// Pushing: a literal or parameter of the formula; a joint's position [rad] or [m], torque [N m] or
/// force [N], sign and size of its last move, its move as a share of the largest joint's; time [s],
/// the effect's k-th temperature [degC], payload [kg], the tip in the base [m], the row from 1.
/// Then operations on one number, on two, and clamp(x, low, high) on three.
enum class FormulaOp : std::uint8_t {
  kLiteral,
  kParameter,
  kPosition,
  kTorque,
  kDirection,
  kTravel,
  kMove,
  kTime,
  kTemperature,
  kPayload,
  kTip,
  kRow,
  kNegate,
  kSin,
  kCos,
  kExp,
  kLog,
  kSqrt,
  kAbs,
  kTanh,
  kSign,
  kStep,
  kAdd,
  kSubtract,
  kMultiply,
  kDivide,
  kPower,
  kMin,
  kMax,
  kClamp
};

/// What a formula moves: a joint, the frame ahead of or behind its motion, the base, the tool
/// frame, or the tip along the axes of the base.
enum class FormulaTarget : std::uint8_t { kJoint, kPre, kPost, kBase, kTool, kTip };

struct FormulaParameter {
  std::string name;
  std::string unit;      // SI
  double typical = 0.0;  // 1 sigma of its prior
  double start = 0.0;
  bool operator==(const FormulaParameter&) const = default;
};

/// A law of the user's own. Empty for every effect but 'formula'.
struct Formula {
  std::string name;
  FormulaTarget target = FormulaTarget::kJoint;
  std::uint8_t joint = 0;      // zero-based
  std::uint8_t component = 0;  // dx dy dz rx ry rz
  std::uint8_t domain = 0;     // robot, environment, procedure, measurement
  std::string expression;      // as written
  std::vector<std::uint16_t> code;
  std::vector<double> literals;
  std::vector<FormulaParameter> parameters;
  bool operator==(const Formula&) const = default;
};

/// A physical effect: a name of the catalogue, its version, and numbers.
struct Effect {
  std::string name;
  std::uint32_t version = 1;
  std::vector<std::uint8_t> joints;  // zero-based
  std::vector<double> parameters;    // SI, in the catalogue's order
  std::vector<ContextNeed> context;
  std::vector<double> constants = {};  // given, not fitted; SI, in the law's order
  Formula formula = {};
  bool operator==(const Effect&) const = default;
};

/// Mass of what moves with a joint; centre of mass in the frame just behind the joint's motion.
struct LinkMass {
  double mass_kg = 0.0;
  std::array<double, 3> com_m{};
  bool operator==(const LinkMass&) const = default;
};

/// What the loads of the effects come from. No links: masses unknown, taken as 0.
struct Mechanics {
  std::vector<LinkMass> links;            // one per joint, or none
  double payload_kg = 0.0;                // unless the context knows better
  std::array<double, 3> payload_com_m{};  // flange frame: the tip without the tool
  bool operator==(const Mechanics&) const = default;
};

/// Inner node of a tree: x <= threshold goes low, else high; x is u[input], or the node's direction
/// times u. A child >= 0 is an inner node, always behind its parent; a child < 0 is leaf ~child.
struct TreeNode {
  double threshold = 0.0;  // on the normalised input, -1 .. 1
  std::uint16_t input = 0;
  std::int16_t low = -1;
  std::int16_t high = -1;
  std::uint16_t reserved = 0;
  bool operator==(const TreeNode&) const = default;
};

/// Local linear model tree for one axis [Nelles 2000], inputs normalised to the trained domain:
/// u_i = (2 q_i - q_min_i - q_max_i) / (q_max_i - q_min_i).
/// Leaf k says y_k = w[k] . (1, u_1 .. u_n [, u_i u_k for i <= k]) in [m].
///
/// Crisp: the leaf that u falls into speaks, clamp(y_k, low_k, high_k).
/// Blended: at a node with half width h and s = clamp((x - threshold + h) / 2h, 0, 1) the high side
/// weighs 3 s^2 - 2 s^3 and the low side the rest; a leaf's validity Phi_k is the product along its
/// path. sum_k Phi_k y_k is held softly, C1, between sum_k Phi_k low_k and sum_k Phi_k high_k.
/// With regions, either fades out where u leaves what the leaves that speak were trained in.
/// No nodes and one leaf is a plain model; no leaves is "no correction".
struct Tree {
  std::uint16_t depth = 0;                    // compares from the root to the deepest leaf
  std::vector<TreeNode> nodes = {};           // leaves - 1 of them
  std::vector<double> coefficients = {};      // leaves x terms, row-major, [m]
  std::vector<double> bounds = {};            // leaves x 2, [m]: what was seen in training
  std::vector<double> blend_half_width = {};  // empty: crisp; else one per node, normalised
  std::uint8_t degree = 1;                    // of the leaves in u: 1 or 2
  std::vector<double> directions = {};        // nodes x joints, sum |.| = 1; empty: along the axes
  std::vector<float> region = {};             // leaves x joints x (low, high), normalised, or empty
  std::vector<float> sigma = {};              // one per leaf, [m]: 1 sigma of an error, or empty
  bool operator==(const Tree&) const = default;

  std::size_t leaves() const { return bounds.size() / 2; }
};

/// Coefficients of a leaf over so many inputs.
constexpr std::size_t leaf_terms(std::size_t inputs, int degree) {
  return 1 + inputs + (degree == 2 ? inputs * (inputs + 1) / 2 : 0);
}

/// Box of joint positions the model was trained in, [rad] or [m].
struct Domain {
  std::vector<double> q_min;
  std::vector<double> q_max;
  double fade = 0.05;  // the tree fades to zero over this share of the span outside the box
  bool operator==(const Domain&) const = default;
};

/// What part of the pose the correction may touch.
enum class Corrects : std::uint8_t { kPosition = 0, kPose = 1 };

/// Limits on the correction, never on the target.
struct GuardLimits {
  Corrects corrects = Corrects::kPosition;
  double max_correction_m = 0.003;
  double max_rotation_rad = 0.01;
  double slew_m_per_s = 0.01;
  double slew_rad_per_s = 0.03;
  double ramp_s = 1.0;  // ramp-in and ramp-out
  double cycle_s = 0.004;
  double length_scale_m = 1.0;       // makes metres and radians comparable: about the reach
  double min_singular_value = 0.02;  // of the Jacobian with lengths divided by length_scale_m
  double max_seed_distance = 0.2;    // |q - seed| [rad]; times length_scale_m for sliding joints
  bool operator==(const GuardLimits&) const = default;
};

struct InputHash {
  std::string name;    // file name without folders
  std::string sha256;  // 64 hex digits
  bool operator==(const InputHash&) const = default;
};

/// Held-out error; absent (poses == 0) when every pose was used for the fit.
struct HeldOut {
  std::uint32_t poses = 0;
  double mean_m = 0.0;
  double rms_m = 0.0;
  double p95_m = 0.0;
  double max_m = 0.0;
  bool operator==(const HeldOut&) const = default;
};

struct Provenance {
  std::string tool_version;
  std::string created;  // ISO 8601, UTC
  std::string run;
  std::vector<InputHash> inputs;
  std::uint32_t poses_fit = 0;
  HeldOut held_out;
  double noise_floor_m = 0.0;                // mean 3-D error that noise alone would leave
  std::vector<std::string> parameter_names;  // fitted robot parameters, for example "J2.d"
  std::vector<float> covariance;             // packed lower triangle, row by row, SI
  bool operator==(const Provenance&) const = default;
};

struct Model {
  std::string cell_name;
  std::string robot_name;
  std::string serial;
  std::array<double, 3> gravity{0.0, 0.0, -9.81};  // [m/s^2], base frame
  Chain nominal;                                   // what the controller believes
  Chain calibrated;                                // what was fitted
  std::vector<Effect> effects;
  Mechanics mechanics;
  std::array<Tree, kTreeAxes> trees;
  Domain domain;
  GuardLimits guard;
  Provenance provenance;
  bool operator==(const Model&) const = default;
};

}  // namespace plumb::format

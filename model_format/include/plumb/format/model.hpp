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

/// The DH convention: which end of the link a row describes.
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

/// One joint: q' = scale * q + offset is the rotation about z, or the translation along it;
/// the link is Tx(a) Rx(alpha) Ry(beta), beta being Hayati's angle for nearly parallel axes.
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
  Twist pre;   // twist before the joint's motion
  Twist post;  // twist after the joint's motion
  bool operator==(const JointRow&) const = default;
};

/// The angle of `joint` is the controller's value of it plus `ratio` times that of joint `by`.
struct JointCoupling {
  std::uint8_t joint = 0;  // zero-based
  std::uint8_t by = 0;
  double ratio = 0.0;
  bool operator==(const JointCoupling&) const = default;
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
  std::vector<JointCoupling> coupling = {};  // how q follows from the controller's joint values
  bool operator==(const Chain&) const = default;
};

/// The inputs that an effect may need in the cycle besides the joint positions.
enum class ContextInput : std::uint8_t {
  kDirection = 0,
  kPayload = 1,
  kTemperature = 2,
  kTime = 3,
  kTravel = 4
};

struct ContextNeed {
  ContextInput input = ContextInput::kDirection;
  std::string name;       // name of the temperature sensor; empty for other inputs
  double fallback = 0.0;  // used while the input is missing or stale, SI
  bool operator==(const ContextNeed&) const = default;
};

/// Operations of a formula's stack code. An instruction is an operation + 256 x operand.
/// kLiteral to kRow push one number: a literal or parameter of the formula; a joint's position
/// [rad] or [m], torque [N m] or force [N], sign and size of its last move, its move as a fraction
/// of the largest move of all joints; the time [s], the effect's k-th temperature [degC], the
/// payload [kg], a coordinate of the tip in the base frame [m], the row of the measurement, counted
/// from 1. kNegate to kStep replace one number, kAdd to kMax two, kClamp (x, low, high) three. The
/// move and the row are known only of measured poses: a fit reads them, and no model file does.
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

/// What a formula moves: a joint, the frame before or after its motion, the base, the tool frame,
/// or the tip along the axes of the base.
enum class FormulaTarget : std::uint8_t { kJoint, kPre, kPost, kBase, kTool, kTip };

struct FormulaParameter {
  std::string name;
  std::string unit;      // SI
  double typical = 0.0;  // 1 sigma of its prior
  double start = 0.0;
  bool operator==(const FormulaParameter&) const = default;
};

/// A law of the user's own. Empty unless the effect is 'formula'.
struct Formula {
  std::string name;
  FormulaTarget target = FormulaTarget::kJoint;
  std::uint8_t joint = 0;      // zero-based
  std::uint8_t component = 0;  // 0 .. 5: dx dy dz rx ry rz
  std::uint8_t domain = 0;     // 0 .. 3: robot, environment, procedure, measurement
  std::string expression;      // as the user wrote it
  std::vector<std::uint16_t> code;
  std::vector<double> literals;
  std::vector<FormulaParameter> parameters;
  bool operator==(const Formula&) const = default;
};

/// A physical effect: the name and version of its law, and its numbers.
struct Effect {
  std::string name;
  std::uint32_t version = 1;
  std::vector<std::uint8_t> joints;  // zero-based
  std::vector<double> parameters;    // fitted; SI, in the law's order
  std::vector<ContextNeed> context;
  std::vector<double> constants = {};  // given, not fitted; SI, in the law's order
  Formula formula = {};
  bool operator==(const Effect&) const = default;
};

/// Mass of all that moves with a joint, and its centre in the frame just after the joint's motion.
struct LinkMass {
  double mass_kg = 0.0;
  std::array<double, 3> com_m{};
  bool operator==(const LinkMass&) const = default;
};

/// The masses that the loads are computed from. If `links` is empty the masses of the links are
/// unknown and taken as 0.
struct Mechanics {
  std::vector<LinkMass> links;            // one per joint, or none
  double payload_kg = 0.0;                // used if the context does not give one
  std::array<double, 3> payload_com_m{};  // flange frame: the tip frame without the tool
  bool operator==(const Mechanics&) const = default;
};

/// Inner node of a tree: x <= threshold leads to `low`, else to `high`; x is u[input], or the dot
/// product of the node's direction and u. A child >= 0 is the index of an inner node, always
/// greater than its parent's; a child < 0 is leaf ~child.
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
/// The value of leaf k is y_k = w[k] . (1, u_1 .. u_n [, u_i u_j for i <= j]) in [m].
///
/// Crisp tree: its value is clamp(y_k, low_k, high_k) of the leaf k whose cell contains u.
/// Blended tree: at a node with half width h and s = clamp((x - threshold + h) / 2h, 0, 1) the high
/// side has the weight 3 s^2 - 2 s^3 and the low side the rest. The validity Phi_k of a leaf is the
/// product of the weights along its path. The value is sum_k Phi_k y_k, limited to the range from
/// sum_k Phi_k low_k to sum_k Phi_k high_k with a continuous slope.
/// With regions, the value fades out where u leaves the regions in which its leaves were trained.
/// A tree of one leaf and no nodes is one linear model; a tree without leaves corrects nothing.
struct Tree {
  std::uint16_t depth = 0;                    // comparisons from the root to the deepest leaf
  std::vector<TreeNode> nodes = {};           // leaves - 1 of them
  std::vector<double> coefficients = {};      // leaves x terms, row-major, [m]
  std::vector<double> bounds = {};            // leaves x (low, high), [m]: seen in training
  std::vector<double> blend_half_width = {};  // empty: crisp; else one per node, normalised
  std::uint8_t degree = 1;                    // degree of the leaves in u: 1 or 2
  std::vector<double> directions = {};        // nodes x joints, sum |.| = 1; empty: along the axes
  std::vector<float> region = {};             // leaves x joints x (low, high), normalised, or empty
  std::vector<float> sigma = {};              // one per leaf, [m]: 1 sigma of its error, or empty
  bool operator==(const Tree&) const = default;

  std::size_t leaves() const { return bounds.size() / 2; }
};

/// Number of coefficients of a leaf with this number of inputs.
constexpr std::size_t leaf_terms(std::size_t inputs, int degree) {
  return 1 + inputs + (degree == 2 ? inputs * (inputs + 1) / 2 : 0);
}

/// Range of one context input over the poses of the fit.
struct ContextRange {
  ContextInput input = ContextInput::kPayload;
  std::string name;  // name of the temperature sensor, or one of kLoadNames
  double low = 0.0;  // SI, temperatures in [degC]
  double high = 0.0;
  bool operator==(const ContextRange&) const = default;
};

/// Box of joint positions, [rad] or [m], and ranges of context inputs that the model was trained
/// in.
struct Domain {
  std::vector<double> q_min;
  std::vector<double> q_max;
  double fade = 0.05;  // outside the box the tree fades to zero over this fraction of the span
  std::vector<ContextRange> context = {};
  bool operator==(const Domain&) const = default;
};

/// The part of the pose that is corrected.
enum class Corrects : std::uint8_t { kPosition = 0, kPose = 1 };

/// Limits of the correction; the target itself is never limited.
struct GuardLimits {
  Corrects corrects = Corrects::kPosition;
  double max_correction_m = 0.003;
  double max_rotation_rad = 0.01;
  double slew_m_per_s = 0.01;
  double slew_rad_per_s = 0.03;
  double ramp_s = 1.0;  // ramp-in and ramp-out
  double cycle_s = 0.004;
  double length_scale_m = 1.0;       // about the arm's reach; makes metres and radians comparable
  double min_singular_value = 0.02;  // of the Jacobian with lengths divided by length_scale_m
  double max_seed_distance = 0.2;    // |q - seed| [rad]; prismatic joints: times length_scale_m
  bool operator==(const GuardLimits&) const = default;
};

struct InputHash {
  std::string name;    // file name without folders
  std::string sha256;  // 64 hex digits
  bool operator==(const InputHash&) const = default;
};

/// Error on held-out poses; absent (poses == 0) if every pose was used for the fit.
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
  double noise_floor_m = 0.0;                // mean 3-D error that measurement noise alone leaves
  std::vector<std::string> parameter_names;  // fitted robot parameters, for example "J2.d"
  std::vector<float> covariance;             // packed lower triangle, row by row, SI
  bool operator==(const Provenance&) const = default;
};

struct Model {
  std::string cell_name;
  std::string robot_name;
  std::string serial;
  std::array<double, 3> gravity{0.0, 0.0, -9.81};  // [m/s^2], base frame
  Chain nominal;                                   // the chain that the controller uses
  Chain calibrated;                                // the fitted chain
  std::vector<Effect> effects;
  Mechanics mechanics;
  std::array<Tree, kTreeAxes> trees;
  Domain domain;
  GuardLimits guard;
  Provenance provenance;
  bool operator==(const Model&) const = default;
};

}  // namespace plumb::format

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "simulate/hidden_effect.hpp"
#include "simulate/statics.hpp"
#include "simulate/visit.hpp"

namespace plumb::offline::sim {

/// The arm and its surroundings, as the laws use them. It must outlive the laws.
struct World {
  const Cell& cell;
  const Arm& arm;  // the true one
  const MassModel& masses;
  const std::vector<Visit>& visits;  // q, direction, travel: of the drives, see joints()
  VectorXd q_min, q_max;
  std::uint64_t seed = 1;  // for the arm
  double session_s = 0.0;
  Isometry3d X_MB = Isometry3d::Identity();  // true base in the tracker frame
  Isometry3d X_TG = Isometry3d::Identity();  // reflector in the tool frame
  double most_payload_kg = 0.0;
  /// Factor on the second-order terms of every law. The formulas above the laws are for 1.
  double richness = 1.0;
  RowsN scatter = {};  // errors of the drives at each visit; no rows: none

  /// The positions of the joints at one visit.
  VectorXd joints(const Visit& visit) const { return masses.drives.to_joints(visit.q); }
};

/// One visit with the frames and loads that follow from it, which are those of the rigid true arm.
struct Moment {
  int row = 0;
  const Visit& visit;
  const Frames& frames;
  const Loads& loads;
};

/// The poses inside the joint limits at which the sizes of effects are defined. They are the same
/// for every plan with this seed.
std::vector<VectorXd> reference_poses(const World& world);

/// Largest gravity torque of each joint at the reference poses [N m]; 0 where the joint slides or
/// gravity hardly turns it (less than 0.3 % of weight times reach).
VectorXd largest_torque(const World& world);

/// A hidden effect with its true numbers.
class Law {
 public:
  virtual ~Law() = default;
  /// Adds the deflection that the effect causes at one visit. It is proportional to the size of the
  /// effect.
  virtual void bend(const Moment& now, Deflection& out) const = 0;
  /// The true numbers for the truth file: one object, or an array with one object for each "joint".
  virtual nlohmann::ordered_json truth() const = 0;
  /// For effects unknown to the library, the inputs on which they depend: "q4", "t", "previous q2".
  virtual std::vector<std::string> inputs() const { return {}; }
  /// Writes the numbers that depend on this session into `effect`, so that it is the same in
  /// another session.
  virtual void pin(HiddenEffect&) const {}
};

/// A joint, or the link behind it, on which a law acts, and the size of the effect there.
struct SizedJoint {
  int joint = 0;
  std::string name;
  double size = 0.0;  // SI
};

/// The joints that the effect names, or else all `usual` ones. Each has its own size if one is
/// given, else the size of the effect, else `fallback`. Throws Failure (kUsage) if a joint is named
/// that is not `possible`.
std::vector<SizedJoint> sized_joints(const HiddenEffect& effect, const World& world,
                                     const std::vector<bool>& possible,
                                     const std::vector<bool>& usual, double fallback,
                                     const std::string& why_not);

/// The description of a law in the list of laws.
struct LawEntry {
  std::string name;
  std::string line;     // for --help
  std::string library;  // name that a diagnosis should find, or "unknown"
  enum class Size { kNone, kAngle, kLength } size = Size::kAngle;
  enum class On { kJoints, kArm } on = On::kJoints;
  enum class Domain { kRobot, kEnvironment, kMeasurement, kProcedure } domain = Domain::kRobot;
  enum class Needs { kNothing, kDirection, kTemperature } needs = Needs::kNothing;  // recorded
  std::vector<std::string> keys;     // keys that HiddenEffect::numbers may have
  std::vector<std::string> same_as;  // effects that may explain it equally well
  std::unique_ptr<Law> (*make)(const HiddenEffect&, const World&) = nullptr;
};
const std::vector<LawEntry>& law_entries();
const LawEntry* find_law(const std::string& name);

}  // namespace plumb::offline::sim

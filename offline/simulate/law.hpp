// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "simulate/simulate.hpp"
#include "simulate/statics.hpp"
#include "simulate/visit.hpp"

namespace plumb::offline::sim {

/// The arm as its laws see it; outlives them.
struct World {
  const Cell& cell;
  const Arm& arm;  // the true one
  const MassModel& masses;
  const std::vector<Visit>& visits;
  VectorXd q_min, q_max;
  std::uint64_t seed = 1;  // of the arm
  double session_s = 0.0;
  Isometry3d X_MB = Isometry3d::Identity();  // true base in the tracker frame
  Isometry3d X_TG = Isometry3d::Identity();  // reflector in the tool frame
  double most_payload_kg = 0.0;
  double richness = 1.0;  // times what is of second order in every law
};

/// One visit with what follows from it; frames and loads are those of the rigid true arm.
struct Moment {
  int row = 0;
  const Visit& visit;
  const Frames& frames;
  const Loads& loads;
};

/// Poses inside the limits on which sizes are defined; the same for every plan with that seed.
std::vector<VectorXd> reference_poses(const World& world);

/// Largest gravity torque of each joint at the reference poses [N m]; 0 where the joint slides or
/// gravity hardly turns it (less than 0.3 % of weight times reach).
VectorXd largest_torque(const World& world);

/// A hidden effect with its true numbers.
class Law {
 public:
  virtual ~Law() = default;
  /// Adds what the effect does at one visit; in proportion to its size.
  virtual void bend(const Moment& now, Deflection& out) const = 0;
  /// Its true numbers, for the truth file: one object, or an array of one object per "joint".
  virtual nlohmann::ordered_json truth() const = 0;
  /// What it truly depends on, where that is the question: "q4", "t", "previous q2".
  virtual std::vector<std::string> inputs() const { return {}; }
  /// Writes into `effect` what it took from this session, so that it is the same in another one.
  virtual void pin(HiddenEffect&) const {}
};

/// A joint a law works on (or the link behind it) and how much.
struct SizedJoint {
  int joint = 0;
  std::string name;
  double size = 0.0;  // SI
};

/// The joints asked for, or all `usual` ones; each with its own size, else the effect's, else
/// `fallback`. Throws Failure (kUsage) if a joint is named that is not `possible`.
std::vector<SizedJoint> sized_joints(const HiddenEffect& effect, const World& world,
                                     const std::vector<bool>& possible,
                                     const std::vector<bool>& usual, double fallback,
                                     const std::string& why_not);

/// What the simulator knows of a law before it is made.
struct LawEntry {
  std::string name;
  std::string line;     // for --help
  std::string library;  // what a diagnosis should call it, or "unknown"
  enum class Size { kNone, kAngle, kLength } size = Size::kAngle;
  enum class On { kJoints, kArm } on = On::kJoints;
  enum class Domain { kRobot, kEnvironment, kMeasurement, kProcedure } domain = Domain::kRobot;
  enum class Needs { kNothing, kDirection, kTemperature } needs = Needs::kNothing;  // then recorded
  std::vector<std::string> keys;     // of HiddenEffect::numbers
  std::vector<std::string> same_as;  // what else may explain it as well
  std::unique_ptr<Law> (*make)(const HiddenEffect&, const World&) = nullptr;
};
const std::vector<LawEntry>& law_entries();
const LawEntry* find_law(const std::string& name);

}  // namespace plumb::offline::sim

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "simulate/simulate.hpp"
#include "simulate/statics.hpp"

namespace plumb::offline::sim {

/// One pose as it was driven to.
struct Visit {
  VectorXd q;          // [rad] or [m]
  VectorXd direction;  // -1, 0 (never moved) or 1: sign of each joint's last move
  VectorXd travel;     // size of that move [rad] or [m]
  double time_s = 0.0;
};

/// Visits in the order of q, starting from rest in the middle of the joint limits. A joint that
/// does not move keeps its last direction and travel.
std::vector<Visit> drive(const RowsN& q, const VectorXd& start, double seconds_per_pose);

/// The arm as its laws see it; outlives them.
struct World {
  const Cell& cell;
  const Arm& arm;  // the true one
  const MassModel& masses;
  const std::vector<Visit>& visits;
  VectorXd q_min, q_max;
  std::uint64_t seed = 1;
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
  /// Adds what the effect does at visit `row`; frames and loads are those of the rigid true arm.
  virtual void bend(int row, const Frames& frames, const Loads& loads, Deflection& out) const = 0;
  /// Its true numbers, for the truth file: one object, or an array of one object per "joint".
  virtual nlohmann::ordered_json truth() const = 0;
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

// The makers, one per law; formulas stand above their code.
std::unique_ptr<Law> make_joint_compliance(const HiddenEffect& effect, const World& world);
std::unique_ptr<Law> make_gear_harmonics(const HiddenEffect& effect, const World& world);
std::unique_ptr<Law> make_link_flexure(const HiddenEffect& effect, const World& world);
std::unique_ptr<Law> make_drift(const HiddenEffect& effect, const World& world);
std::unique_ptr<Law> make_reversal(const HiddenEffect& effect, const World& world);
std::unique_ptr<Law> make_planar_published(const HiddenEffect& effect, const World& world);
std::unique_ptr<Law> make_planar_printed(const HiddenEffect& effect, const World& world);

/// What the simulator knows of a law before it is made.
struct LawEntry {
  std::string name;
  std::string line;  // for --help
  enum class Size { kNone, kAngle, kLength } size = Size::kAngle;
  bool per_joint = true;
  bool needs_direction = false;  // its columns are then always recorded
  std::unique_ptr<Law> (*make)(const HiddenEffect&, const World&) = nullptr;
};
const std::vector<LawEntry>& law_entries();
const LawEntry* find_law(const std::string& name);

}  // namespace plumb::offline::sim

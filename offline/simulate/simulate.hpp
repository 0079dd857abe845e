// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"

namespace plumb::offline {

/// A hidden effect as asked for: NAME[=SIZE][:JOINT[=SIZE],...][:SIGMA][@KEY=NUMBER,...], for
/// example "drift=100um", "gear_harmonics:J2,J3", "joint_compliance:J2=150urad" or
/// "gear_ripple:J2:5@cycles=20". Units: um, mm, m, urad, mrad, rad, deg; or sigma, see size_sigma.
struct HiddenEffect {
  struct Part {
    int joint = 0;  // zero-based
    std::optional<double> size;
  };
  std::string name;
  std::optional<double> size;  // SI; of every joint without its own
  /// Instead of a size: per-axis RMS of what it moves the measured points, geometry having been
  /// fitted to them, over the noise.
  std::optional<double> size_sigma;
  std::vector<Part> joints;               // empty: the joints the law is usual on
  std::map<std::string, double> numbers;  // what else the law can be told, SI
};

/// What the simulated arm does that its nominal model does not know. SI.
struct HiddenTruth {
  double geometry_m = 0.0;            // 1 sigma of every length error
  double geometry_rad = 0.0;          // 1 sigma of every angle error
  double mass_share = 0.0;            // 1 sigma of every link's mass over the one in the cell
  double richness = 1.0;              // of the laws: 0 leaves only what the library also knows
  std::vector<std::string> effects;   // laws of the simulator, see parse_hidden_effect
  std::vector<HiddenEffect> sized;    // instead: as Simulation::effects gave them, for fresh poses
  std::optional<std::uint64_t> seed;  // of the arm and its set-up; the plan's if not given: state
                                      // it to measure one arm at fresh poses
  std::optional<format::Pose> X_MB;   // base in the tracker frame; else the cell's, else random
  std::optional<std::array<double, 3>> target_T;  // reflector in the tool frame; likewise
};

/// Which poses, and in which order.
struct PoseChoice {
  double range = 1.0;   // share of each joint's range, around its middle
  int grid_levels = 0;  // at least 2: every joint only on so many equally spaced places
  enum class Order { kAsDrawn, kNearest } order = Order::kAsDrawn;
};

/// Whether columns are written.
enum class Recorded { kIfNeeded, kAlways, kNever };

/// How the arm is measured. SI.
struct SimulationPlan {
  int poses = 150;  // distinct, uniform inside the joint limits
  PoseChoice choice;
  RowsN q;                          // (poses, joints) instead of random ones, if it has rows
  int repeats = 1;                  // of every tenth pose, one after the other, for the noise floor
  double noise_m = 10e-6;           // 1 sigma per axis
  std::optional<double> noise_rad;  // if given, the reflector's orientation is measured too
  std::array<bool, 3> axes{true, true, true};  // which of x, y, z are measured
  double seconds_per_pose = 30.0;
  std::optional<double> session_s;              // else as long as the poses take
  Recorded directions = Recorded::kIfNeeded;    // dir_jN, travel_jN_deg
  Recorded temperatures = Recorded::kIfNeeded;  // temp_degC, temp_room_degC, temp_elbow_degC
  enum class Climate { kChanging, kConstant } climate = Climate::kChanging;
  std::vector<Payload> payloads;  // each pose carries one of them; empty: always the cell's
  double held_share = 0.0;        // of the poses, marked in column set
  double outlier_share = 0.0;     // of the rows, 30 to 300 sigma off
  std::uint64_t seed = 1;         // of poses and noise
  HiddenTruth truth;
};

/// What one hidden effect does to the measured points.
struct EffectSize {
  double rms_m = 0.0;      // per axis
  double visible_m = 0.0;  // per axis, geometry having been fitted to it
};

struct GrossOutlier {
  int row = 0;
  std::array<double, 3> shift_M{};  // [m]
};

struct Simulation {
  Measurements measured;               // its one table holds the context columns
  std::vector<Column> context;         // t_s; and what is recorded of SimulationPlan
  Rows3 true_p_M;                      // without noise and outliers [m]
  std::vector<HiddenEffect> effects;   // with the sizes and numbers they got
  std::vector<EffectSize> sizes;       // of each of them
  std::vector<GrossOutlier> outliers;  // by row
  format::Chain true_chain;            // the geometry that was drawn
  format::Pose X_MB;
  format::Pose X_TG;       // reflector G in the tool frame; turned if its place is fitted
  std::string truth_json;  // every true parameter, for the scorer only
};

/// Measures a simulated arm. Its laws and its kinematics are its own: nothing of the runtime is
/// used here, so a test against it is a test. The same plan gives the same numbers.
/// Throws Failure (kUsage) for a plan that makes no sense or an effect it does not know.
Simulation simulate(const Cell& cell, const SimulationPlan& plan);

/// The measurements as a canonical CSV file, context columns included.
std::string simulated_csv(const Cell& cell, const Simulation& simulation);

/// Throws Failure (kUsage) with a caret and "did you mean".
HiddenEffect parse_hidden_effect(const std::string& spec, const Cell& cell);

/// Effects the simulator knows, one line each for --help.
const std::vector<std::pair<std::string, std::string>>& simulated_effects();

/// Sample cells of `plumb demo`: name and one line about it; the first is the default.
const std::vector<std::pair<std::string, std::string>>& demo_cells();
struct Demo {
  Cell cell;
  SimulationPlan plan;
};

/// An empty name gives the default. Throws Failure (kUsage) for a name it does not know.
Demo make_demo(const std::string& name);

/// A random arm of sensible shape, round nominal values, limits and a 100 to 200 mm tool.
/// kRevolute: 4 to 7 joints; kScara: 4, the third one slides.
enum class ArmKind { kRevolute, kScara };
Cell random_cell(std::uint64_t seed, int joints, format::Convention convention, ArmKind kind);

}  // namespace plumb::offline

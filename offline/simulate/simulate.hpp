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
#include "simulate/imperfections.hpp"
#include "simulate/stated_visit.hpp"

namespace plumb::offline {

/// A hidden effect as the user states it: NAME[=SIZE][:JOINT[=SIZE],...][:SIGMA][@KEY=NUMBER,...],
/// for example "drift=100um", "gear_harmonics:J2,J3", "joint_compliance:J2=150urad" or
/// "gear_ripple:J2:5@cycles=20". Units: um, mm, m, urad, mrad, rad, deg; or sigma, see size_sigma.
struct HiddenEffect {
  struct Part {
    int joint = 0;  // zero-based
    std::optional<double> size;
  };
  std::string name;
  std::optional<double> size;  // for the joints without a size of their own; SI
  /// Given instead of a size: the RMS per axis of the motion of the measured points that remains
  /// after geometry was fitted to it, divided by the noise.
  std::optional<double> size_sigma;
  std::vector<Part> joints;               // if empty, the usual joints of the law
  std::map<std::string, double> numbers;  // other numbers of the law, SI
};

/// The properties of the simulated arm that its nominal model does not contain. SI units.
struct HiddenTruth {
  double geometry_m = 0.0;            // 1 sigma of every length error
  double geometry_rad = 0.0;          // 1 sigma of every angle error
  double mass_share = 0.0;            // 1 sigma of every link's mass over the one in the cell
  double richness = 1.0;              // 0: only terms that the library knows as well
  std::vector<std::string> effects;   // in the form of parse_hidden_effect
  std::vector<HiddenEffect> sized;    // instead, for fresh poses: from Simulation::effects
  std::optional<std::uint64_t> seed;  // of the arm and its set-up; the plan's if not given: state
                                      // it to measure one arm at fresh poses
  std::optional<std::uint64_t> like;  // seed of an arm of the same batch, whose errors of geometry
                                      // it shares in part
  std::optional<format::Pose> X_MB;   // base in the tracker frame; else the cell's, else random
  std::optional<std::array<double, 3>> target_T;  // reflector in the tool frame; likewise
};

/// Which poses are measured, and in which order.
struct PoseChoice {
  double range = 1.0;   // share of the range of each joint that is used, around its middle
  int grid_levels = 0;  // if at least 2: number of equally spaced positions of each joint
  enum class Order { kAsDrawn, kNearest } order = Order::kAsDrawn;
};

/// Whether context columns are written.
enum class Recorded { kIfNeeded, kAlways, kNever };

/// How the arm is measured. SI units.
struct SimulationPlan {
  int poses = 150;  // distinct, uniform inside the joint limits
  PoseChoice choice;
  RowsN q;                          // (poses, joints), used instead of random poses if not empty
  int repeats = 1;                  // successive readings of every tenth pose, for the noise floor
  int revisits = 0;                 // of the poses, measured once more at the end of the session
  double noise_m = 10e-6;           // 1 sigma per axis
  std::optional<double> noise_rad;  // if given, the orientation is measured as well
  std::array<bool, 3> axes{true, true, true};  // which of x, y, z are measured
  double seconds_per_pose = 30.0;
  std::optional<double> session_s;              // if not given, as long as the poses take
  Recorded directions = Recorded::kIfNeeded;    // dir_jN, travel_jN_deg
  Recorded temperatures = Recorded::kIfNeeded;  // temp_degC, temp_room_degC, temp_elbow_degC
  enum class Climate { kChanging, kConstant } climate = Climate::kChanging;
  std::vector<Payload> payloads;    // each pose carries one; if empty, that of the cell
  std::vector<StatedVisit> stated;  // one a row, if not empty: instead of what would be drawn
  double held_share = 0.0;          // share of the poses that are marked as held out
  double outlier_share = 0.0;       // share of the rows that are 30 to 300 sigma off
  std::uint64_t seed = 1;           // for poses, noise and scatter
  HiddenTruth truth;
  Imperfections imperfections;
};

/// The motion of the measured points that one hidden effect causes.
struct EffectSize {
  double rms_m = 0.0;      // per axis
  double visible_m = 0.0;  // per axis, after geometry was fitted to it
};

struct GrossOutlier {
  int row = 0;
  std::array<double, 3> shift_M{};  // [m]
};

struct Simulation {
  MeasurementFiles measured;           // its table contains the context columns
  std::vector<Column> context;         // time and the recorded context
  Rows3 true_p_M;                      // without noise and outliers, with scatter of joints [m]
  std::vector<HiddenEffect> effects;   // with the sizes and numbers that were used
  std::vector<EffectSize> sizes;       // of each effect
  std::vector<GrossOutlier> outliers;  // by row
  format::Chain true_chain;            // the true geometry
  format::Pose X_MB;
  format::Pose X_TG;       // reflector G in the tool frame; turned if the target is fitted
  std::string truth_json;  // every true parameter, for the scoring only
};

/// Measures a simulated arm. Laws and kinematics are independent of the runtime, so that the two
/// can be tested against each other. The same plan gives the same numbers.
/// Throws Failure (kUsage) for an impossible plan or an unknown effect.
Simulation simulate(const Cell& cell, const SimulationPlan& plan);

/// The measurements as a canonical CSV file, context columns included.
std::string simulated_csv(const Cell& cell, const Simulation& simulation);

/// Reads the specification of a hidden effect. Throws Failure (kUsage) with a caret and "did you
/// mean".
HiddenEffect parse_hidden_effect(const std::string& spec, const Cell& cell);

/// The specification that reads back to this effect, whose size must not be stated in sigma.
std::string hidden_effect_text(const HiddenEffect& effect, const Cell& cell);

/// The effects of the simulator, with one line each for --help.
const std::vector<std::pair<std::string, std::string>>& simulated_effects();

/// The sample cells of `plumb demo`: the name and one line of description. The first is the
/// default.
const std::vector<std::pair<std::string, std::string>>& demo_cells();
struct Demo {
  Cell cell;
  SimulationPlan plan;
};

/// Makes a sample cell. An empty name gives the default. Throws Failure (kUsage) for an unknown
/// name.
Demo make_demo(const std::string& name);

/// A random arm of plausible shape with round nominal values, joint limits and a tool of 100 to 200
/// mm. kRevolute has 4 to 7 joints, kScara has 4, of which the third slides.
enum class ArmKind { kRevolute, kScara };
Cell random_cell(std::uint64_t seed, int joints, format::Convention convention, ArmKind kind);

}  // namespace plumb::offline

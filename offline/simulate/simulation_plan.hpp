// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "simulate/hidden_effect.hpp"
#include "simulate/imperfections.hpp"
#include "simulate/stated_visit.hpp"

namespace plumb::offline {

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
  /// Reflector in the tool frame [m]; else the cell's, else random.
  std::optional<std::array<double, 3>> target_T;
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

}  // namespace plumb::offline

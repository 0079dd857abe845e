// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "simulate/simulate.hpp"
#include "tests/cases/path_poses.hpp"

namespace plumb::offline {

/// kHeavy has a reach of 2.2 m and carries 60 kg, kLight 1.3 m and 10 kg; both have geometry errors
/// and masses that differ from the stated ones. The planar arms of the published study include
/// their flexible beams. kTrack, kScara and kPalletiser: see study_arms.hpp; the joints 3 and 4 of
/// kPalletiser are coupled, whatever the request says of them.
enum class BlindArm {
  kHeavy,
  kLight,
  kPlanarPublished,
  kPlanarPrinted,
  kTrack,
  kScara,
  kPalletiser
};

/// What the written cell says of the links' masses. The simulated arm has them within 15 %.
enum class StatedMasses {
  kBehindD,     // centres in the frame behind d, though the cell file is read ahead of d: off by d
  kRight,       // centres in the frame that the cell file asks for
  kOtherFrame,  // centres in the Denavit-Hartenberg frame of the link, without com_frame = "dh"
  kNone
};

/// Orientations that are measured beside the points.
struct MeasuredTurns {
  double sigma_rad = 20e-6;  // 1 sigma per axis, as the cell states it
  double times = 1.0;        // they scatter by so many times that
  double by_place_rad =
      0.0;  // and err by so much, usually, by where the reflector is: repeats agree
};

/// The settings of a blind case.
struct BlindRequest {
  BlindArm arm = BlindArm::kHeavy;
  std::vector<std::string> effects;  // in the form of parse_hidden_effect: "gear_ripple:J2:5"
  double sigma_m = 20e-6;            // of the tracker, per axis
  std::optional<MeasuredTurns> turns;
  int poses = 150;
  int fresh_poses = 500;
  int repeats = 3;   // readings of every tenth pose
  int revisits = 0;  // poses that are measured once more at the end
  std::uint64_t seed = 1;
  double richness = 1.0;  // see HiddenTruth
  double outlier_share = 0.0;
  double session_s = 3.0 * 3600.0;
  PoseChoice choice;
  PoseField field = PoseField::kAnywhere;  // an effect has the same size on a path
  /// kVaried: three payloads, each with its own centre of mass. kConstant: the payload of the cell
  /// only.
  enum class Payloads { kVaried, kConstant } payloads = Payloads::kVaried;
  Recorded directions = Recorded::kAlways;
  Recorded temperatures = Recorded::kAlways;
  SimulationPlan::Climate climate = SimulationPlan::Climate::kChanging;
  double held_share = 0.0;
  StatedMasses masses = StatedMasses::kBehindD;
  Imperfections imperfections;
};

/// A measured arm with hidden effects. Only the scoring may use the members that follow `measured`.
struct BlindCase {
  Cell cell;                     // as it is written
  std::string cell_toml;         // refers to measurements.csv
  std::string measurements_csv;  // the input of a diagnosis
  std::string truth_json;
  /// Fresh poses without noise, at other times of a session of the same length: measured with all
  /// effects, and as a perfect measurement would see the arm.
  std::string fresh_csv;
  std::string fresh_robot_csv;
  Simulation measured, fresh, fresh_robot;
  /// As fresh_robot, but with the scatter of the joints and rounded encoders: what a user would see
  /// on new poses with a perfect tracker. Only if there are such imperfections.
  std::optional<Simulation> fresh_scattered;
};

/// Makes a blind case. The same request gives the same bytes. Throws Failure (kUsage) as simulate
/// does.
BlindCase make_blind_case(const BlindRequest& request);

}  // namespace plumb::offline

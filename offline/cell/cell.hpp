// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cell/reading_kind.hpp"
#include "effects/effect_entry.hpp"
#include "plumb/format/model.hpp"
#include "program/problem.hpp"

namespace plumb::drivers {
enum class BusUse : std::uint8_t;
struct BusLayout;
}  // namespace plumb::drivers

namespace plumb::offline {

/// Optional mechanical data of a joint and its link, for the effects that need them. SI.
struct JointMechanics {
  std::optional<double> gear_ratio;
  std::optional<double> stiffness_Nm_per_rad;
  std::optional<double> link_mass_kg;
  std::optional<std::array<double, 3>> link_com_m;
  std::optional<double> length_m, EI_Nm2, GJ_Nm2, kg_per_m;
  bool parallel_next = false;  // its axis is nominally parallel to the next one
  bool has_mass() const { return link_mass_kg || kg_per_m; }
};

struct Payload {
  double mass_kg = 0.0;
  std::array<double, 3> com_m{};  // flange frame
};

/// How the held-out poses are chosen.
struct HeldOutRule {
  enum class Kind { kAuto, kShare, kFolds, kColumn, kFile } kind = Kind::kAuto;
  double share = 0.2;               // kShare
  int folds = 5;                    // kFolds
  std::string column = "set";       // kColumn
  std::filesystem::path file = {};  // kFile, absolute
  Place named_at = {};              // where the cell file says so, if it does
};

/// One of several arrangements of tracker and reflector in which one arm was measured: another day,
/// another station, another reflector on the tool. Which rows are its own say `files`, or the text
/// column `setup` of the files of [measurement], which then holds its name.
struct Setup {
  std::string name;
  std::vector<std::filesystem::path> files;  // absolute
  std::vector<Place> named_at = {};          // of each file in the cell file
  bool fit_frame = true;
  format::Pose X_MB;            // base in the measurement frame, if not fitted
  std::optional<int> frame_of;  // stands where that earlier set-up stands
  bool fit_target = true;
  std::array<double, 3> target_T{};            // reflector in the tool frame [m], if not fitted
  std::optional<int> target_of;                // has the reflector of that earlier set-up
  ReadingKind reads = ReadingKind::kPosition;  // what its rows read: artefacts.hpp
  std::string position = {};                   // of an artefact: where it was placed
  double length_m = 0.0;  // radius of a sphere, or how much less a wire reads than the distance
  bool fit_length = false;
  bool is_artefact() const { return reads != ReadingKind::kPosition; }
  Place place = {};
};

/// A distance between two touched points that is known, as of two sockets on one plate.
struct KnownLength {
  int from = 0, to = 0;  // set-ups of the two points
  double length_m = 0.0;
};

struct MeasurementSettings {
  std::vector<std::filesystem::path> files;  // absolute
  std::vector<Place> named_at;               // of each file in the cell file, if it was read there
  bool fit_frame = true;
  format::Pose X_MB;  // base in the measurement frame, if not fitted
  bool fit_target = true;
  std::array<double, 3> target_T{};     // reflector in the tool frame [m], if not fitted
  std::optional<double> sigma_m;        // 1 sigma per axis
  std::optional<double> sigma_rad;      // 1 sigma per axis of measured orientations (sigma_urad)
  std::optional<double> sigma_touch_m;  // the same of readings of artefacts
  HeldOutRule held_out;
  std::uint64_t seed = 1;
  std::vector<Setup> setups;  // none: one, as above
  std::vector<KnownLength> lengths;
  double sigma_length_m = 50e-6;  // 1 sigma of each (sigma_distance_um), that of a printed part
};

/// What is known of a parameter beforehand: its nominal value and what arms differ from it, give or
/// take.
struct Prior {
  std::string name;       // "J2.d", "joint_compliance.J2.c"
  double sigma = 0.0;     // 1 sigma, SI
  double mean = 0.0;      // difference from nominal, or size of an effect, SI
  bool of_fleet = false;  // learnt from other arms: this one may nevertheless be unlike them
};

/// How much the arms of a fleet speak for an effect in one more of them.
struct SisterOdds {
  std::string effect;
  double nats = 0.0;  // added to ln B
};

struct EarlierArm;

struct FitSettings {
  std::vector<std::string> fixed;  // parameters held at nominal, "J2.d"
  std::vector<Prior> priors;
  std::vector<SisterOdds> sister_odds;  // learnt from other arms
  std::string prior_from;  // a file of plumb fleet, or a folder of a run or of a cell that has
                           // one, as the cell file names it; empty: none
  std::shared_ptr<const EarlierArm> earlier;  // that run
  double prior_m = 0.5e-3;                    // 1 sigma of how far arms are built from nominal
  double prior_rad = 0.5e-3;                  // the same of angles
  enum class Model { kDh, kComplete } model = Model::kDh;
};

struct DeploySettings {
  double cycle_s = 0.004;
  double max_correction_m = 0.003;
  drivers::BusUse link{};                         // CAN
  std::string interface = "can0";                 // of CAN
  std::string address = "127.0.0.1";              // of a controller that speaks Modbus TCP
  std::shared_ptr<const drivers::BusLayout> bus;  // none: the default one
};

/// A cell file, read and checked. SI inside: [m], [rad]; places keep the text for messages.
struct Cell {
  std::filesystem::path file;       // absolute path of cell.toml
  std::filesystem::path directory;  // its folder
  std::string text;                 // as read, for in-place edits and hashes
  std::string name, serial;
  double tolerance_m = 1e-4;
  std::string robot_name;
  std::string length_unit = "mm", angle_unit = "deg";  // as written, for display
  format::Chain nominal;
  std::vector<JointMechanics> mechanics;  // one per joint
  std::vector<bool> assumed_limits;       // joints whose q limits the file does not say
  std::array<double, 3> gravity{0.0, 0.0, -9.81};
  Payload payload;
  MeasurementSettings measurement;
  std::vector<EffectEntry> effects;
  FitSettings fit;
  DeploySettings deploy;
  std::vector<Problem> remarks;  // warnings and notes found while reading
  int joints() const { return static_cast<int>(nominal.joints.size()); }
};

/// Reads and checks a cell file; throws Failure with all problems (exit 3), unknown keys included.
Cell read_cell(const std::filesystem::path& cell_toml);

/// The same for a text that is, or will be, the content of that file.
Cell parse_cell(std::string text, const std::filesystem::path& cell_toml);

/// sha256 of the file, and of what it takes over from a fleet or an earlier run.
std::string hash_of(const Cell& cell);

/// sha256 of what a fit reads of it: the keys as parsed and what is taken over, without comments,
/// order, names, tolerance and [deploy]. Two cells of one such hash and one set of measurements are
/// fitted alike.
std::string fit_hash(const Cell& cell);

/// cell.toml in `start` or the nearest folder above it. Throws Failure (kInput) with help if none.
std::filesystem::path find_cell(const std::filesystem::path& start);

/// A commented cell.toml for `cell`; read_cell of it gives the same cell.
std::string write_cell(const Cell& cell);

/// Names that [effects] may hold.
const std::vector<std::string>& known_effects();

/// "auto", "20%", "kfold:5", "column:set", "file:verify.csv"; nothing if it is none of them.
std::optional<HeldOutRule> parse_held_out(std::string_view text,
                                          const std::filesystem::path& directory);

/// "2%" is 0.02.
std::optional<double> parse_percent(std::string_view text);

}  // namespace plumb::offline

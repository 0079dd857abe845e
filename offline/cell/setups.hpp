// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"

/// Set-ups of a measurement ([[measurement.setup]]): one arm, measured on several days, from
/// several stations, or with several reflectors. A cell that lists none has one, which is
/// [measurement] itself.
namespace plumb::offline {

/// Number of set-ups, at least 1.
int setup_count(const MeasurementSettings& settings);

/// Name of a set-up, "" if it is the only one.
std::string setup_name(const MeasurementSettings& settings, int setup);

/// The set-up that defines the frame of `setup`: itself, or the one whose frame it shares. The same
/// for the reflector.
int frame_root(const MeasurementSettings& settings, int setup);
int target_root(const MeasurementSettings& settings, int setup);

/// The settings of `setup`; those of a shared frame or target are taken from the set-up that
/// defines them.
Setup setup_rule(const MeasurementSettings& settings, int setup);

/// The cell as if `setup` were its only one.
Cell cell_of_setup(const Cell& cell, int setup);

/// The cell and the measurements of one set-up alone, for code that handles only one. The rows keep
/// their order. largest_setup: the set-up with the most rows.
struct OneSetup {
  int setup = 0;
  Cell cell;
  MeasurementFiles measured;
};
OneSetup one_setup(const Cell& cell, const MeasurementFiles& measured, int setup);
int largest_setup(const Cell& cell, const Measurements& measured);

/// Files to read, each once, in the order of the cell file: those of [measurement], those that only
/// a set-up names, the held-out file last.
std::vector<std::filesystem::path> measurement_files(const MeasurementSettings& settings);

/// Assigns each row to its set-up, and separates repeats of a pose that were measured in different
/// set-ups. `files`: where the tables of `measured` were read from. Throws Failure (kInput,
/// E-CSV-SETUP) for rows that belong to no set-up, or to two, and for a set-up without rows.
void assign_setups(const Cell& cell, const std::vector<std::filesystem::path>& files,
                   MeasurementFiles& measured);

/// The same for rows that are to be predicted: by the column `setup`, or because `file`, where they
/// were read from, is one that a set-up names. Throws Failure (kInput, E-CSV-SETUP) if neither says
/// it: a point in the frame of another station would be metres off.
void assign_setups_to_predict(const Cell& cell, const std::filesystem::path& file,
                              MeasurementFiles& rows);

}  // namespace plumb::offline

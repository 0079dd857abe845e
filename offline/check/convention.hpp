// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "cell/measurements.hpp"
#include "check/cell_edit.hpp"
#include "check/measurement_edit.hpp"

namespace plumb::offline {

/// How a left-handed file can be put right: which axis to negate, or which two to swap.
enum class Mirror : int { kNone, kNegateX, kNegateY, kNegateZ, kSwapXY, kSwapYZ, kSwapXZ };

/// How the numbers of a cell and its measurements are meant.
struct Convention {
  format::Convention dh = format::Convention::kStandard;
  std::string length_unit, angle_unit;            // of the cell file
  std::string turn_unit, slide_unit, point_unit;  // of the columns q of turning and of sliding
                                                  // joints, and of x, y, z
  std::vector<bool> reversed;                     // joints that count the other way
  std::vector<int> quarter_turns;                 // joint zeros turned by so many times 90 deg
  std::vector<int> column;                        // per joint: the column q that holds its values
  std::vector<double> zero;                       // added to the joint's position [rad]
  std::vector<double> factor;                     // of the joint's readings, beside their unit
  std::vector<std::string> own_unit;              // of the joint's column alone; empty: as the rest
  std::vector<format::JointCoupling> coupling;    // of the columns, in the order of their joints
  Mirror mirror = Mirror::kNone;                  // the measured coordinates are left-handed
  bool frame_inverted = false;                    // the given frame is the tracker in the base
  bool operator==(const Convention&) const = default;
};

/// What the files say of themselves.
Convention labelled_convention(const Cell& cell, const MeasurementFiles& measured);

/// How much `other` asks to be changed: 1 for each unit, sign or the DH convention, a little more
/// for what is rarer, so that of two explanations with the same points the simpler one wins.
double changes(const Convention& present, const Convention& other);

/// The cell and the measurements read as `meant` instead of as `present`. Cost of the first: one
/// parse of the cell's text.
Cell read_as(const Cell& cell, const Convention& present, const Convention& meant);
Measurements read_as(const Measurements& measured, const Cell& cell, const Convention& present,
                     const Convention& meant);
MeasurementFiles read_as(const MeasurementFiles& measured, const Cell& cell,
                         const Convention& present, const Convention& meant);

/// The same as edits of the files.
CellEdit cell_edit(const Cell& cell, const Convention& present, const Convention& meant);
MeasurementEdit measurement_edit(const Cell& cell, const Convention& present,
                                 const Convention& meant);

/// "joint 2 counts the other way", one sentence part a change; empty if nothing changes.
std::vector<std::string> in_words(const Cell& cell, const Convention& present,
                                  const Convention& meant);

}  // namespace plumb::offline

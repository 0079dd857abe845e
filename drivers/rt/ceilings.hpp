// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "plumb/format/model.hpp"
#include "program/toml_table.hpp"

namespace plumb::drivers::rt {

/// The most that a model may do to the robot, whatever the model says of itself: table [limits] of
/// rt.toml. A model is refused, at the start and at a swap, if its own limits are wider than these.
/// The guard keeps the correction within the limits of the model, and so within the ceilings.
struct Ceilings {
  double correction_m = 0.010;  // largest correction
  double rotation_rad = 0.030;
  double slew_m_s = 0.030;  // its largest rate of change
  double slew_rad_s = 0.100;
  double ramp_s = 0.1;       // the shortest ramp, in and out
  double change_m = 0.0005;  // by how much a swap may change the correction of a pose
  double change_rad = 0.0005;
};

/// Reads max_correction_mm, max_rotation_deg, max_slew_mm_s, max_slew_deg_s, min_ramp_s,
/// max_change_mm and max_change_deg; absent keys change nothing.
void read_ceilings(TomlTable& table, Ceilings& out);

/// A limit of a model that is wider than its ceiling; both numbers in the unit of the key.
struct WiderLimit {
  const char* key;   // of [limits] in rt.toml: "max_correction_mm"
  const char* what;  // "corrections of up to"
  double model;
  double ceiling;
  const char* unit;  // "mm"
  std::string text() const;
};

/// All limits of the model that are wider than the ceilings; those of rotations only for a model
/// that corrects rotations. Pure; cheap.
std::vector<WiderLimit> wider_limits(const format::GuardLimits& model, const Ceilings& ceilings);

}  // namespace plumb::drivers::rt

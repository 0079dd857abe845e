// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cell/cell.hpp"

namespace plumb::offline {

/// Changes to a cell.toml; what is absent stays.
struct CellEdit {
  std::optional<std::string> dh_convention, length_unit, angle_unit;
  std::optional<std::string> coupling;            // of [robot], as TOML
  std::map<int, double> theta, offset;            // of joint (zero-based) [rad]
  std::optional<std::vector<std::string>> files;  // of [measurement], relative to the cell
  std::optional<std::string> held_out;            // of [measurement]
  std::optional<std::string> prior_from;          // empty: nothing is taken over from a fleet
  std::optional<format::Pose> frame;              // of [measurement]
  bool empty() const;
};

/// The text with these values replaced where they stand: comments, order and layout survive. Keys
/// that the file leaves out are added behind their section's first line. Angles are written in
/// the angle unit the edited file has. Throws Failure (kInput) if the text is no TOML.
std::string edited(const std::string& text, const std::string& file, const CellEdit& edit);

}  // namespace plumb::offline

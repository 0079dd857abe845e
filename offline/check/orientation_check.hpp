// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "check/measurement_edit.hpp"
#include "fit/measured_orientations.hpp"
#include "program/problem.hpp"

namespace plumb::offline {

/// What the orientation columns hold.
struct OrientationCheck {
  MeasuredOrientations judged;
  std::vector<std::string> meant;  // the interpretations that fit, in words
  MeasurementEdit edit;            // of the files, where one interpretation fits; else empty

  /// The labels are wrong, and the cell asks for orientations.
  bool stops() const { return !edit.empty() && judged.stated; }
};

OrientationCheck check_orientations(const Cell& cell, const MeasurementFiles& measured);

/// E-CHECK-ORIENTATION if it stops, else W-CHECK-ORIENTATION; nothing if all is well.
std::optional<Problem> orientation_finding(const OrientationCheck& check);

}  // namespace plumb::offline

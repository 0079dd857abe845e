// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "program/problem.hpp"

namespace plumb::offline {

/// The text of a URDF file as its parser wants it: tabs and line ends inside the quotes of an
/// attribute become blanks, as XML prescribes. Throws Failure (kInput, E-URDF) for texts of another
/// kind, with the remedy: UTF-16, xacro that was not run, SDF, MJCF, no XML at all.
std::string urdf_text(std::string text, const std::string& file);

/// W-URDF-UNITS: turns (rpy) or limits of joints that look like degrees. `text`: from urdf_text.
std::vector<Problem> urdf_unit_warnings(const std::string& text, const std::string& file);

}  // namespace plumb::offline

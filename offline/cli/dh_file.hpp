// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "plumb/format/model.hpp"
#include "program/outcome.hpp"

namespace plumb::offline::cli {

/// A DH table as CSV, a row a joint from base to tip: alpha_deg, a_mm, d_mm, theta_deg; optional
/// joint (name), type (revolute or prismatic), q_min_deg and q_max_deg (q_min_mm and q_max_mm for
/// joints that slide). Any unit of the right kind will do. Limits that are not given become
/// -180 .. 180 deg or 0 .. 1000 mm, with a note. Throws Failure (kInput).
format::Chain read_dh(const std::filesystem::path& file, format::Convention convention,
                      Outcome& outcome);

}  // namespace plumb::offline::cli

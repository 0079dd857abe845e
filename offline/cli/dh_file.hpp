// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "plumb/format/model.hpp"
#include "program/outcome.hpp"

namespace plumb::offline::cli {

/// An arm as its table describes it.
struct DhTable {
  format::Chain chain;
  std::vector<bool> assumed_limits;  // joints whose q limits the table does not give
};

/// A DH table as CSV, a row a joint from base to tip: alpha_deg, a_mm, d_mm, theta_deg; optional
/// joint (name), type (revolute or prismatic), q_min_deg and q_max_deg, and for joints that slide
/// q_min_mm and q_max_mm; a cell of the four may be empty. Any unit of the right kind will do.
/// Limits that are not given are assumed wide, with a note. Throws Failure (kInput).
DhTable read_dh(const std::filesystem::path& file, format::Convention convention, Outcome& outcome);

}  // namespace plumb::offline::cli

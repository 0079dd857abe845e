// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cell/cell.hpp"

namespace plumb::offline {

/// Units that a column of joint angles may really have, the labelled one first: radians hardly
/// exceed three turns, and an arm that moves by less than three degrees calibrates nothing.
/// `largest`: largest |angle| as labelled [rad].
std::vector<std::string> plausible_turn_units(double largest, const std::string& labelled);

/// The same for alpha, theta and beta of the DH table. A table of zeros is the same in any unit.
std::vector<std::string> plausible_table_units(const format::Chain& chain,
                                               const std::string& labelled);

/// How odd an arm of that reach is, in changes of a label that it is worth: 0 from 0.2 m to 5 m, 3
/// for each decade beyond.
double oddity(double reach_m);

/// Units of the three lengths that stand in a cell and its measurements.
struct LengthUnits {
  std::string table, slide, point;
};

/// The fewest changes of the labels that make the file's lengths `point_ratio` and sliding joints
/// `slide_ratio` times longer against the table than labelled; among equals the arm of a sensible
/// reach. A slide_ratio of 0: nothing slides. Ratios that no units explain leave the labels.
LengthUnits explain_ratios(const LengthUnits& labelled, double point_ratio, double slide_ratio,
                           double reach_m);

/// How many times longer or larger numbers become that are in `meant` and not in `labelled`.
double unit_ratio(const std::string& meant, const std::string& labelled);

/// Ratios of two units of length, 1 first.
const std::vector<double>& length_ratios();

}  // namespace plumb::offline

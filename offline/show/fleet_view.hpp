// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "fleet/fleet.hpp"
#include "show/json.hpp"
#include "show/table.hpp"

namespace plumb::offline::show {

/// fleet.json, and `result` of `plumb fleet`: cells and, model by model, what is typical. Numbers
/// in the units of the screen, and in SI for `[fit] prior_from`.
Json fleet_json(const fleet::Fleet& fleet);

/// One sentence: how many arms are good, which are unlike their sisters, what failed.
std::string fleet_verdict(const fleet::Fleet& fleet);

/// What is to be said of a cell: its verdict in few words, as fit and report say it, and why it is
/// unlike its sisters; or why it could not be fitted.
std::string state_of(const fleet::Fleet& fleet, const fleet::CellSummary& cell);

/// All cells; of more than `most` only those whose verdict is not good, or that are unlike their
/// sisters.
std::vector<const fleet::CellSummary*> listed_cells(const fleet::Fleet& fleet, std::size_t most);

/// The arm as one that is unlike its sisters; null if it is not.
const fleet::OddArm* odd_arm(const fleet::Fleet& fleet, const std::string& cell);

/// "UR10, 34 arms"
std::string model_name(const fleet::Model& model);

/// Why nothing was learnt of a model.
std::string too_few_words(const fleet::Model& model);

/// In how many arms each effect is modelled, and in how many a diagnosis misses it.
Table effects_table(const fleet::Fleet& fleet);

/// The numbers that are typical of a model; first those that the arms themselves show best.
Table typical_table(const fleet::Model& model);

/// The verdict, a table of the cells (of many only those that need attention), what is typical.
std::string fleet_text(const fleet::Fleet& fleet);

}  // namespace plumb::offline::show

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "fleet/effect_shares.hpp"
#include "fleet/odd_arms.hpp"
#include "fleet/results_folder.hpp"

namespace plumb::offline::fleet {

/// Arms of one nominal chain.
struct Model {
  std::string key, robot;  // robot: as most of its cells call it
  int arms = 0;            // that could be fitted, copies not counted
  Sisters sisters;
  std::vector<EffectShare> shares;
};

struct Fleet {
  std::vector<CellSummary> cells;  // by name
  /// Cells that have the measurements of another one, by name, and that one: they teach nothing.
  std::map<std::string, std::string> copies;
  std::vector<Model> models;  // the one with the most arms first
};

/// What a folder of cells holds, each by name.
struct Folders {
  std::vector<std::filesystem::path> cells;   // with a cell.toml, readable or not
  std::vector<std::filesystem::path> others;  // folders without one
};

/// Throws Failure (kInput): E-READ if it cannot be read, E-FLEET-NONE if it holds no cell.
Folders folders_in(const std::filesystem::path& folder);

/// A share of them: those whose place is `index` modulo `of`.
std::vector<std::filesystem::path> share_of(const std::vector<std::filesystem::path>& cells,
                                            int index, int of);

/// Summaries of these cells, made where none of the present inputs is kept, `jobs` at a time, each
/// by a process of its own: a cell that brings its process down costs that cell alone. `tell` is
/// called with how many are done. What could be made is kept at once, so that a run that is
/// interrupted goes on where it was. Throws Failure (kEnvironment) if results cannot be kept.
std::vector<CellSummary> summaries_of(const std::vector<std::filesystem::path>& cells,
                                      const ResultsFolder& results, Asked asked, int jobs,
                                      const std::function<void(int done)>& tell);

/// An effect in the cells that could be fitted.
struct EffectUse {
  std::string effect;
  int modelled = 0;   // cells whose model has it
  int missing = 0;    // cells whose diagnosis names it as the first thing that is missing
  int diagnosed = 0;  // cells that were diagnosed
};

/// Every effect that a model has or a diagnosis names, by name.
std::vector<EffectUse> effect_uses(const Fleet& fleet);

/// What the cells teach, model by model.
Fleet fleet_of(std::vector<CellSummary> cells);

}  // namespace plumb::offline::fleet

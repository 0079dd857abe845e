// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "fleet/odd_arms.hpp"
#include "fleet/results_folder.hpp"

namespace plumb::offline::fleet {

/// Arms of one nominal chain.
struct Model {
  std::string key, robot;  // robot: as most of its cells call it
  int arms = 0;            // that could be fitted
  Sisters sisters;
};

struct Fleet {
  std::vector<CellSummary> cells;  // by name
  std::vector<Model> models;       // the one with the most arms first
};

/// Every folder in `folder` with a cell.toml, by name. Throws Failure (kInput, E-FLEET-NONE) if
/// there is none.
std::vector<std::filesystem::path> cells_of(const std::filesystem::path& folder);

/// A share of them: those whose place is `index` modulo `of`.
std::vector<std::filesystem::path> share_of(const std::vector<std::filesystem::path>& cells,
                                            int index, int of);

/// Summaries of these cells, made where none of the present inputs is kept, `jobs` at a time, each
/// by a process of its own: a cell that brings its process down costs that cell alone. `tell` is
/// called with how many are done. What could be made is kept at once, so that a run that is
/// interrupted goes on where it was.
std::vector<CellSummary> summaries_of(const std::vector<std::filesystem::path>& cells,
                                      const ResultsFolder& results, int jobs,
                                      const std::function<void(int done)>& tell);

/// What the cells teach, model by model.
Fleet fleet_of(std::vector<CellSummary> cells);

}  // namespace plumb::offline::fleet

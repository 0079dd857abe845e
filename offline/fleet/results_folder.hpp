// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "fleet/cell_summary.hpp"

namespace plumb::offline::fleet {

/// Where the summaries of the cells are kept: cells/NAME.json in this folder, one file a cell, each
/// written whole. Several programs may write there at once; the same cell gives the same bytes.
class ResultsFolder {
 public:
  explicit ResultsFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// The kept summary of a cell, if it is of these inputs and of this version.
  std::optional<CellSummary> kept(const std::string& name,
                                  const std::vector<SummaryInput>& inputs) const;

  /// Throws Failure (kEnvironment) if it cannot be written.
  void keep(const CellSummary& summary) const;

  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path file_of(const std::string& name) const;
  std::filesystem::path folder_;
};

}  // namespace plumb::offline::fleet

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "fleet/cell_summary.hpp"

namespace plumb::offline::fleet {

/// What a summary has to hold.
enum class Asked { kFit, kDiagnosis };

/// Where the summaries of the cells are kept: cells/XY/NAME.json in this folder, one file a cell,
/// each written whole and with its check sum. XY, the first digits of the name's sha256, keeps the
/// folders small. Several programs may write there at once; the same cell gives the same bytes.
class ResultsFolder {
 public:
  explicit ResultsFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// The kept summary of a cell, if it is of these inputs and holds what is asked for.
  std::optional<CellSummary> kept(const std::string& name, const std::vector<SummaryInput>& inputs,
                                  Asked asked) const;

  /// Throws Failure (kEnvironment) if it cannot be written.
  void keep(const CellSummary& summary) const;

  /// Throws Failure (kEnvironment) if the result of this cell could not be kept.
  void check_writable(const std::string& name) const;

  const std::filesystem::path& folder() const { return folder_; }

 private:
  void make_folder_of(const std::string& name) const;
  std::filesystem::path file_of(const std::string& name) const;
  std::filesystem::path folder_;
};

}  // namespace plumb::offline::fleet

// SPDX-License-Identifier: Apache-2.0
#include "fleet/results_folder.hpp"

#include "program/file.hpp"
#include "program/problem.hpp"
#include "program/shell_word.hpp"

namespace plumb::offline::fleet {

namespace fs = std::filesystem;

fs::path ResultsFolder::file_of(const std::string& name) const {
  return folder_ / "cells" / (name + ".json");
}

std::optional<CellSummary> ResultsFolder::kept(const std::string& name,
                                               const std::vector<SummaryInput>& inputs) const {
  std::error_code ignored;
  if (!fs::exists(file_of(name), ignored)) return std::nullopt;
  try {
    CellSummary out = summary_from(Json::parse(read_file(file_of(name))));
    if (out.inputs == inputs) return out;
  } catch (const nlohmann::json::exception&) {
    // Cut off, edited, or of another version: it is made anew.
  } catch (const Failure&) {
  }
  return std::nullopt;
}

void ResultsFolder::keep(const CellSummary& summary) const {
  std::error_code error;
  fs::create_directories(folder_ / "cells", error);
  if (error)
    throw Failure(Exit::kEnvironment,
                  {.code = "E-WRITE",
                   .message = "cannot write " + display_name(folder_) + ": " + error.message(),
                   .help = "another folder for the results: -o DIR"});
  write_file_atomically(file_of(summary.name), to_text(to_json(summary)));
}

}  // namespace plumb::offline::fleet

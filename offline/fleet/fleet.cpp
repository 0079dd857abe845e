// SPDX-License-Identifier: Apache-2.0
#include "fleet/fleet.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <map>
#include <optional>
#include <set>

#include "fleet/summarise.hpp"
#include "program/file.hpp"
#include "program/problem.hpp"
#include "program/shell_word.hpp"

namespace plumb::offline::fleet {
namespace {

namespace fs = std::filesystem;

/// Makes and keeps the summary of one cell; the exit code of a child process.
int summarise_and_keep(const fs::path& cell, const ResultsFolder& results) {
  try {
    results.keep(summarise(cell));
    return 0;
  } catch (...) {
    return 1;
  }
}

/// A cell whose process ended without a summary.
CellSummary unfinished(const fs::path& cell) {
  CellSummary out;
  out.name = cell.filename().string();
  out.error_code = "E-FLEET-CELL";
  out.error = "its fit ended without a result";
  return out;
}

/// Waits for any child; its process number, or -1.
pid_t any_child() {
  int status = 0;
  pid_t child = 0;
  do child = ::waitpid(-1, &status, 0);
  while (child < 0 && errno == EINTR);
  return child;
}

}  // namespace

std::vector<fs::path> cells_of(const fs::path& folder) {
  std::vector<fs::path> out;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    std::error_code ignored;
    if (fs::exists(at->path() / "cell.toml", ignored)) out.push_back(at->path());
  }
  if (error)
    throw Failure(Exit::kInput, {.code = "E-READ",
                                 .message = fmt::format("cannot read {}: {}", display_name(folder),
                                                        error.message()),
                                 .help = "ls -ld " + shell_word(display_name(folder))});
  if (out.empty())
    throw Failure(
        Exit::kInput,
        {.code = "E-FLEET-NONE",
         .message = fmt::format("no folder in {} holds a cell.toml", display_name(folder)),
         .help = "name the folder that holds the cells: plumb fleet cells"});
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<fs::path> share_of(const std::vector<fs::path>& cells, int index, int of) {
  std::vector<fs::path> out;
  for (std::size_t i = static_cast<std::size_t>(index); i < cells.size();
       i += static_cast<std::size_t>(of))
    out.push_back(cells[i]);
  return out;
}

std::vector<CellSummary> summaries_of(const std::vector<fs::path>& cells,
                                      const ResultsFolder& results, int jobs,
                                      const std::function<void(int)>& tell) {
  std::vector<std::optional<CellSummary>> made(cells.size());
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    made[i] = results.kept(cells[i].filename().string(), inputs_of(cells[i]));
    if (!made[i]) missing.push_back(i);
  }
  int done = static_cast<int>(cells.size() - missing.size());
  tell(done);
  std::map<pid_t, std::size_t> running;
  std::size_t next = 0;
  while (next < missing.size() || !running.empty()) {
    if (next < missing.size() && running.size() < static_cast<std::size_t>(jobs)) {
      const std::size_t i = missing[next++];
      const pid_t child = ::fork();
      if (child == 0) ::_exit(summarise_and_keep(cells[i], results));
      if (child > 0) {
        running.emplace(child, i);
        continue;
      }
      // No more processes: wait for one of ours, or do it here.
      if (running.empty()) {
        summarise_and_keep(cells[i], results);
        tell(++done);
        continue;
      }
      --next;
    }
    const pid_t ended = any_child();
    if (running.erase(ended) > 0) tell(++done);
  }
  std::vector<CellSummary> out;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (!made[i]) made[i] = results.kept(cells[i].filename().string(), inputs_of(cells[i]));
    out.push_back(made[i] ? std::move(*made[i]) : unfinished(cells[i]));
  }
  return out;
}

Fleet fleet_of(std::vector<CellSummary> cells) {
  Fleet out;
  out.cells = std::move(cells);
  std::sort(out.cells.begin(), out.cells.end(),
            [](const CellSummary& a, const CellSummary& b) { return a.name < b.name; });
  std::set<std::string> keys;
  for (const auto& cell : out.cells)
    if (cell.ok) keys.insert(cell.model);
  for (const auto& key : keys) {
    std::vector<const CellSummary*> arms;
    std::map<std::string, int> names;
    for (const auto& cell : out.cells)
      if (cell.ok && cell.model == key) {
        arms.push_back(&cell);
        ++names[cell.robot];
      }
    const auto name =
        std::max_element(names.begin(), names.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    out.models.push_back({.key = key,
                          .robot = name->first,
                          .arms = static_cast<int>(arms.size()),
                          .sisters = learn_sisters(std::move(arms))});
  }
  std::stable_sort(out.models.begin(), out.models.end(),
                   [](const Model& a, const Model& b) { return a.arms > b.arms; });
  return out;
}

}  // namespace plumb::offline::fleet

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

/// What the process that fits one cell ends with.
enum ChildExit : int { kKept = 0, kNotKept = 1 };

/// Makes and keeps the summary of one cell.
ChildExit summarise_and_keep(const fs::path& cell, const ResultsFolder& results, Asked asked) {
  try {
    results.keep(summarise(cell, asked));
    return kKept;
  } catch (...) {
    return kNotKept;
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

/// A child process that has ended.
struct Ended {
  pid_t child = -1;
  bool kept = false;  // false as well of one that was killed
  bool killed = false;
};

Ended any_child() {
  int status = 0;
  pid_t child = 0;
  do child = ::waitpid(-1, &status, 0);
  while (child < 0 && errno == EINTR);
  return {.child = child,
          .kept = WIFEXITED(status) && WEXITSTATUS(status) == kKept,
          .killed = WIFSIGNALED(status)};
}

/// Whether a folder holds a cell.toml, readable or not: only what is certainly absent is none.
bool has_cell_file(const fs::path& folder) {
  std::error_code error;
  const auto status = fs::symlink_status(folder / "cell.toml", error);
  return fs::exists(status) || (error && status.type() != fs::file_type::not_found);
}

/// Thrown when results could not be kept: with the reason of the system, if it still is one.
[[noreturn]] void results_lost(const ResultsFolder& results, const fs::path& first, int lost) {
  try {
    results.check_writable(first.filename().string());
  } catch (const Failure& failure) {
    Problem problem = failure.problems().front();
    problem.message = fmt::format("{} result{} could not be kept, the first: {}", lost,
                                  lost == 1 ? "" : "s", problem.message);
    throw Failure(Exit::kEnvironment, problem);
  }
  throw Failure(Exit::kEnvironment,
                {.code = "E-WRITE",
                 .message = fmt::format("{} result{} could not be kept in {}", lost,
                                        lost == 1 ? "" : "s", display_name(results.folder())),
                 .help = "the disk was full for a while, perhaps: give the command again"});
}

/// Equal for two cells with the same measurements.
std::string measurements_of(const CellSummary& cell) {
  std::string out;
  for (const auto& input : cell.inputs)
    if (input.of_measurement) out += input.sha256 + "\n";
  return out;
}

std::map<std::string, std::string> copies_among(const std::vector<CellSummary>& cells) {
  std::map<std::string, std::string> first, out;
  for (const auto& cell : cells) {
    if (!cell.ok) continue;
    const auto [at, is_first] = first.emplace(measurements_of(cell), cell.name);
    if (!is_first) out.emplace(cell.name, at->second);
  }
  return out;
}

}  // namespace

Folders folders_in(const fs::path& folder) {
  Folders out;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    std::error_code ignored;
    if (has_cell_file(at->path()))
      out.cells.push_back(at->path());
    else if (at->is_directory(ignored))
      out.others.push_back(at->path());
  }
  if (error)
    throw Failure(Exit::kInput, {.code = "E-READ",
                                 .message = fmt::format("cannot read {}: {}", display_name(folder),
                                                        error.message()),
                                 .help = "ls -ld " + shell_word(display_name(folder))});
  if (out.cells.empty())
    throw Failure(
        Exit::kInput,
        {.code = "E-FLEET-NONE",
         .message = fmt::format("no folder in {} holds a cell.toml", display_name(folder)),
         .help = "name the folder that holds the cells: plumb fleet cells"});
  std::sort(out.cells.begin(), out.cells.end());
  std::sort(out.others.begin(), out.others.end());
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
                                      const ResultsFolder& results, Asked asked, int jobs,
                                      const std::function<void(int)>& tell) {
  std::vector<std::optional<CellSummary>> made(cells.size());
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    made[i] = results.kept(cells[i].filename().string(), inputs_of(cells[i]), asked);
    if (!made[i]) missing.push_back(i);
  }
  int done = static_cast<int>(cells.size() - missing.size());
  std::vector<std::size_t> lost;
  tell(done);
  if (!missing.empty()) results.check_writable(cells[missing.front()].filename().string());
  std::map<pid_t, std::size_t> running;
  std::size_t next = 0;
  while (next < missing.size() || !running.empty()) {
    if (next < missing.size() && running.size() < static_cast<std::size_t>(jobs)) {
      const std::size_t i = missing[next++];
      const pid_t child = ::fork();
      if (child == 0) ::_exit(summarise_and_keep(cells[i], results, asked));
      if (child > 0) {
        running.emplace(child, i);
        continue;
      }
      // No more processes: wait for one of ours, or do it here.
      if (running.empty()) {
        if (summarise_and_keep(cells[i], results, asked) != kKept) lost.push_back(i);
        tell(++done);
        continue;
      }
      --next;
    }
    const Ended ended = any_child();
    const auto at = running.find(ended.child);
    if (at == running.end()) continue;
    const std::size_t i = at->second;
    running.erase(at);
    if (!ended.kept && !ended.killed) lost.push_back(i);
    tell(++done);
  }
  if (!lost.empty()) results_lost(results, cells[lost.front()], static_cast<int>(lost.size()));
  std::vector<CellSummary> out;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (!made[i]) made[i] = results.kept(cells[i].filename().string(), inputs_of(cells[i]), asked);
    out.push_back(made[i] ? std::move(*made[i]) : unfinished(cells[i]));
  }
  return out;
}

std::vector<EffectUse> effect_uses(const Fleet& fleet) {
  std::map<std::string, EffectUse> uses;
  int diagnosed = 0;
  for (const auto& cell : fleet.cells) {
    if (!cell.ok) continue;
    for (const auto& effect : std::set(cell.effects.begin(), cell.effects.end()))
      ++uses[effect].modelled;
    if (!cell.diagnosis) continue;
    ++diagnosed;
    if (!cell.diagnosis->effect.empty()) ++uses[cell.diagnosis->effect].missing;
  }
  std::vector<EffectUse> out;
  for (auto& [name, use] : uses) {
    use.effect = name;
    use.diagnosed = diagnosed;
    out.push_back(use);
  }
  return out;
}

Fleet fleet_of(std::vector<CellSummary> cells) {
  Fleet out;
  out.cells = std::move(cells);
  std::sort(out.cells.begin(), out.cells.end(),
            [](const CellSummary& a, const CellSummary& b) { return a.name < b.name; });
  out.copies = copies_among(out.cells);
  std::set<std::string> keys;
  for (const auto& cell : out.cells)
    if (cell.ok) keys.insert(cell.model);
  for (const auto& key : keys) {
    std::vector<const CellSummary*> arms;
    std::map<std::string, int> names;
    for (const auto& cell : out.cells)
      if (cell.ok && cell.model == key && !out.copies.contains(cell.name)) {
        arms.push_back(&cell);
        ++names[cell.robot];
      }
    const auto name =
        std::max_element(names.begin(), names.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    out.models.push_back({.key = key,
                          .robot = name->first,
                          .arms = static_cast<int>(arms.size()),
                          .sisters = learn_sisters(arms),
                          .shares = learn_shares(arms)});
  }
  std::stable_sort(out.models.begin(), out.models.end(),
                   [](const Model& a, const Model& b) { return a.arms > b.arms; });
  return out;
}

}  // namespace plumb::offline::fleet

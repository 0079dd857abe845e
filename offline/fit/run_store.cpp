// SPDX-License-Identifier: Apache-2.0
#include "fit/run_store.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>

#include "cell/formula_reader.hpp"
#include "fit/run_json.hpp"
#include "program/file.hpp"

namespace plumb::offline {
namespace {

namespace fs = std::filesystem;

fs::path runs_folder(const Cell& cell) { return cell.directory / "runs"; }
fs::path run_folder(const Cell& cell, int number) {
  return runs_folder(cell) / fmt::format("{:04}", number);
}

std::string now_utc() {
  const auto now = std::chrono::system_clock::now();
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}",
                     fmt::gmtime(std::chrono::system_clock::to_time_t(now)));
}

std::vector<format::InputHash> inputs_of(const Measurements& measured) {
  std::vector<format::InputHash> out;
  for (const auto& table : measured.tables)
    out.push_back({fs::path(table.file).filename().string(), table.sha256});
  return out;
}

[[noreturn]] void damaged(const fs::path& folder, const std::string& why) {
  throw Failure(Exit::kInput,
                {.code = "E-RUN-DAMAGED",
                 .message = fmt::format("{} cannot be read: {}", folder.string(), why),
                 .help = "delete this run and fit again: plumb fit"});
}

[[noreturn]] void cannot_write(const fs::path& what, const std::string& why,
                               const fs::path& folder) {
  throw Failure(Exit::kEnvironment,
                {.code = "E-WRITE",
                 .message = fmt::format("cannot write {}: {}", display_name(what), why),
                 .help = "check free space and permissions: df -h && ls -ld " + folder.string()});
}

/// The folder in which a run is made before it gets its number. What denies it is the folder that
/// is there: runs/, or the cell's own.
fs::path make_draft(const Cell& cell) {
  const fs::path runs = runs_folder(cell), draft = runs / fmt::format(".draft-{}", getpid());
  std::error_code error;
  fs::create_directories(runs, error);
  if (error)
    cannot_write(runs, error.message(), fs::exists(runs) ? runs : fs::path(cell.directory));
  fs::create_directories(draft, error);
  if (error) cannot_write(runs, error.message(), runs);
  return draft;
}

}  // namespace

Run draft_run(const Cell& cell, const Measurements& measured, Fit fit) {
  Run run;
  run.created = now_utc();
  run.cell_sha256 = sha256(cell.text);
  run.inputs = inputs_of(measured);
  for (const auto& effect : cell.effects)
    run.effects.push_back(
        effect.name != "formula" ? effect.name : "formula." + formula_label(formula_text(effect)));
  run.fit = std::move(fit);
  return run;
}

Run save_run(const Cell& cell, const Measurements& measured, Fit fit) {
  Run run = draft_run(cell, measured, std::move(fit));
  const fs::path draft = make_draft(cell);
  std::error_code error;
  const auto numbers = list_runs(cell);
  // Another fit may take the number between the look and the rename: then the next one is ours.
  for (run.number = numbers.empty() ? 1 : numbers.back() + 1;; ++run.number) {
    run.directory = run_folder(cell, run.number);
    write_file_atomically(draft / "predictions.csv", predictions_to_csv(measured, run.fit));
    write_file_atomically(draft / "run.json", run_to_json(run).dump(1) + "\n");
    fs::rename(draft, run.directory, error);
    if (!error) return run;
    if (!fs::exists(run.directory)) break;
  }
  fs::remove_all(draft);
  cannot_write(run.directory, error.message(), runs_folder(cell));
}

std::vector<int> list_runs(const Cell& cell) {
  std::vector<int> out;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(runs_folder(cell), error)) {
    const std::string name = entry.path().filename().string();
    int number = 0;
    const auto end = std::from_chars(name.data(), name.data() + name.size(), number);
    if (end.ec == std::errc{} && end.ptr == name.data() + name.size()) out.push_back(number);
  }
  std::sort(out.begin(), out.end());
  return out;
}

Run load_run(const Cell& cell, int number) {
  const fs::path folder = run_folder(cell, number);
  if (!fs::exists(folder))
    throw Failure(Exit::kInput, {.code = "E-RUN-MISSING",
                                 .message = fmt::format("there is no run {}", number),
                                 .help = "list them: plumb runs"});
  try {
    Run run = run_from_json(nlohmann::ordered_json::parse(read_file(folder / "run.json")));
    run.directory = folder;
    predictions_from_csv(folder / "predictions.csv", run.fit);
    return run;
  } catch (const nlohmann::json::exception& e) {
    damaged(folder, e.what());
  } catch (const Failure& e) {
    damaged(folder, e.what());
  }
}

std::optional<Run> current_run(const Cell& cell, const Measurements& measured) {
  const auto numbers = list_runs(cell);
  const std::string hash = sha256(cell.text);
  const auto inputs = inputs_of(measured);
  for (auto it = numbers.rbegin(); it != numbers.rend(); ++it) {
    try {
      Run run = load_run(cell, *it);
      if (run.cell_sha256 == hash && run.inputs == inputs) return run;
    } catch (const Failure&) {
      // A damaged run is not the current one; `plumb runs` reports it.
    }
  }
  return std::nullopt;
}

}  // namespace plumb::offline

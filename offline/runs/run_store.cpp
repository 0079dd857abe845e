// SPDX-License-Identifier: Apache-2.0
#include "runs/run_store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "arm/parameter.hpp"
#include "cell/earlier_arm.hpp"
#include "cell/formula_reader.hpp"
#include "cell/iso_time.hpp"
#include "cell/run_checksum.hpp"
#include "effects/registry.hpp"
#include "program/file.hpp"
#include "program/process_number.hpp"
#include "runs/run_json.hpp"

namespace plumb::offline {
namespace {

namespace fs = std::filesystem;

fs::path runs_folder(const Cell& cell) { return cell.directory / "runs"; }
fs::path run_folder(const Cell& cell, int number) {
  return runs_folder(cell) / fmt::format("{:04}", number);
}

std::vector<format::InputHash> inputs_of(const MeasurementFiles& measured) {
  std::vector<format::InputHash> out;
  for (const auto& table : measured.tables)
    out.push_back({fs::path(table.file).filename().string(), table.sha256});
  return out;
}

[[noreturn]] void damaged(const fs::path& file, const std::string& why) {
  throw Failure(Exit::kInput, {.code = "E-RUN-DAMAGED",
                               .message = fmt::format("{} {}", display_name(file), why),
                               .help = "fit again: plumb fit; or delete this run: rm -r " +
                                       display_name(file.parent_path())});
}

/// Describes a syntax error with its line, in place of the message of the parser.
std::string unreadable(const std::string& text, const nlohmann::json::parse_error& error) {
  const std::size_t at = std::min(error.byte > 0 ? error.byte - 1 : 0, text.size());
  const auto line =
      1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) return "is empty";
  return at >= text.size()
             ? fmt::format("was cut off: it ends in the middle of line {}", line)
             : fmt::format("was changed after it was written: line {} is no JSON", line);
}

/// Describes a member that is missing or holds another kind of value than a run does.
std::string unexpected(const nlohmann::json::exception& error) {
  const std::string what = error.what();
  const auto open = what.find('\''), close = what.rfind('\'');
  if (error.id == 403 && open < close)
    return fmt::format("lacks '{}': it was changed, or written by another version of plumb",
                       what.substr(open + 1, close - open - 1));
  return "holds other values than a run does: it was changed, or written by another version of "
         "plumb";
}

constexpr const char* kChanged =
    "was changed or cut off after it was written: its check sum is not the one of this run";

[[noreturn]] void cannot_write(const fs::path& what, const std::string& why,
                               const fs::path& folder) {
  throw Failure(Exit::kEnvironment,
                {.code = "E-WRITE",
                 .message = fmt::format("cannot write {}: {}", display_name(what), why),
                 .help = "check free space and permissions: df -h && ls -ld " + folder.string()});
}

nlohmann::ordered_json parsed(const fs::path& file, const std::string& text) {
  try {
    return nlohmann::ordered_json::parse(text);
  } catch (const nlohmann::json::parse_error& e) {
    damaged(file, unreadable(text, e));
  }
}

constexpr const char* kNoiseFloor = "noise_floor.json";
constexpr std::string_view kDraft = ".draft-";

/// Number of the process that is writing a run in that folder; 0 if the folder is no draft.
int maker_of(const fs::path& folder) {
  const std::string name = folder.filename().string();
  int maker = 0;
  if (!name.starts_with(kDraft)) return 0;
  const char* end = name.data() + name.size();
  const auto read = std::from_chars(name.data() + kDraft.size(), end, maker);
  return read.ec == std::errc{} && read.ptr == end && maker > 0 ? maker : 0;
}

/// Removes drafts of processes that have ended, or that had our own number before us.
void remove_dead_drafts(const fs::path& runs) {
  std::error_code error;
  std::vector<fs::path> dead;
  for (fs::directory_iterator it(runs, error), end; !error && it != end; it.increment(error)) {
    const int maker = maker_of(it->path());
    if (maker == own_process_number() || (maker > 0 && !process_exists(maker)))
      dead.push_back(it->path());
  }
  for (const auto& draft : dead) fs::remove_all(draft, error);
}

/// The folder in which a run is written before it is renamed to its number. The destructor removes
/// it if that did not happen. If it cannot be created, the error names the existing folder above
/// it: runs/, or that of the cell.
class DraftFolder {
 public:
  explicit DraftFolder(const Cell& cell) {
    const fs::path runs = runs_folder(cell);
    std::error_code error;
    fs::create_directories(runs, error);
    if (error)
      cannot_write(runs, error.message(), fs::exists(runs) ? runs : fs::path(cell.directory));
    remove_dead_drafts(runs);
    folder_ = runs / fmt::format("{}{}", kDraft, own_process_number());
    fs::create_directory(folder_, error);
    if (error) cannot_write(runs, error.message(), runs);
  }
  ~DraftFolder() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  DraftFolder(const DraftFolder&) = delete;
  DraftFolder& operator=(const DraftFolder&) = delete;
  const fs::path& folder() const { return folder_; }

 private:
  fs::path folder_;
};

/// Writes a file of the draft. The message of an error names the folder of the run instead of that
/// of the draft.
void write_part(const fs::path& draft, const fs::path& run, const char* name,
                const std::string& bytes) {
  try {
    write_file_atomically(draft / name, bytes);
  } catch (const Failure& failure) {
    auto problems = failure.problems();
    const std::string made = display_name(draft), meant = display_name(run);
    for (auto& problem : problems)
      for (std::string* text : {&problem.message, &problem.help})
        for (const auto& from : {made, draft.string()})
          if (const auto at = text->find(from); at != std::string::npos)
            text->replace(at, from.size(),
                          text == &problem.help ? display_name(run.parent_path()) : meant);
    throw Failure(failure.exit_code(), std::move(problems));
  }
}

}  // namespace

Run draft_run(const Cell& cell, const MeasurementFiles& measured, Fit fit) {
  Run run;
  run.created = iso_utc(std::time(nullptr));
  run.cell_sha256 = hash_of(cell);
  run.fit_sha256 = fit_hash(cell);
  run.inputs = inputs_of(measured);
  for (const auto& effect : cell.effects)
    run.effects.push_back(
        !is_formula(effect.name) ? effect.name : "formula." + formula_label(formula_text(effect)));
  run.fit = std::move(fit);
  if (const auto& earlier = cell.fit.earlier; earlier && run.fit.calibration.likeness)
    run.from = TakenOver{.check_sum = earlier->check_sum, .inputs = earlier->inputs};
  return run;
}

namespace {

Run saved(const Cell& cell, const MeasurementFiles& measured, Run run) {
  const DraftFolder draft(cell);
  const std::string predictions = predictions_to_csv(measured, run.fit);
  std::error_code error;
  const auto numbers = list_runs(cell);
  // Another process may take the number before the rename; the next number is tried then.
  for (run.number = numbers.empty() ? 1 : numbers.back() + 1;; ++run.number) {
    run.directory = run_folder(cell, run.number);
    write_part(draft.folder(), run.directory, "predictions.csv", predictions);
    write_part(draft.folder(), run.directory, "run.json",
               with_checksums(run_to_json(run), predictions));
    fs::rename(draft.folder(), run.directory, error);
    if (!error) return run;
    if (!fs::exists(run.directory)) break;
  }
  cannot_write(run.directory, error.message(), runs_folder(cell));
}

}  // namespace

Run save_run(const Cell& cell, const MeasurementFiles& measured, Fit fit) {
  return saved(cell, measured, draft_run(cell, measured, std::move(fit)));
}

Run save_recheck(const Cell& cell, const MeasurementFiles& measured, Fit fit, RecheckOf recheck) {
  Run run = draft_run(cell, measured, std::move(fit));
  run.recheck = std::move(recheck);
  return saved(cell, measured, std::move(run));
}

void save_floor(const Run& run, const NoiseFloor& floor) {
  write_file_atomically(run.directory / kNoiseFloor, floor_to_json(floor).dump(2) + "\n");
}

std::optional<NoiseFloor> diagnosed_floor(const Run& run) {
  const fs::path file = run.directory / kNoiseFloor;
  if (run.directory.empty() || !fs::exists(file)) return std::nullopt;
  return floor_from_json(parsed(file, read_file(file)));
}

namespace {

/// The parameters of the estimates of a run that was read, in their order; empty if the cell no
/// longer has one of them.
std::vector<Parameter> parameters_by_name(const Cell& cell, const Calibration& c) {
  auto known = candidate_parameters(cell, Orientation::kUsed);
  const auto of_effects = effect_parameters(c.state.arm);
  known.insert(known.end(), of_effects.begin(), of_effects.end());
  std::vector<Parameter> out;
  for (const Estimate& estimate : c.estimates) {
    const auto at = std::find_if(known.begin(), known.end(),
                                 [&](const Parameter& p) { return p.name == estimate.name; });
    // A recheck may have fitted a bent link, or the frame of a tracker that the cell gives.
    auto number = at == known.end() ? robot_parameter(cell.nominal, estimate.name)
                                    : std::optional<Parameter>(*at);
    if (!number) number = placing_parameter(estimate.name);
    if (!number) return {};
    out.push_back(*number);
  }
  return out;
}

void read_predictions(const fs::path& file, const nlohmann::ordered_json& json, Fit& fit) {
  try {
    if (!is_predictions_sum(json, predictions_from_csv(file, fit))) damaged(file, kChanged);
  } catch (const Failure&) {
    if (!predictions_sum_holds(json, read_file(file))) damaged(file, kChanged);
    throw;
  }
}

}  // namespace

std::vector<int> list_runs(const Cell& cell) {
  std::vector<int> out;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(runs_folder(cell), error)) {
    const std::string name = entry.path().filename().string();
    int number = 0;
    const auto end = std::from_chars(name.data(), name.data() + name.size(), number);
    const bool whole = end.ec == std::errc{} && end.ptr == name.data() + name.size();
    if (whole && number > 0 && entry.path() == run_folder(cell, number)) out.push_back(number);
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
  fs::path file = folder / "run.json";
  try {
    const std::string text = read_file(file);
    const auto json = parsed(file, text);
    if (!json_sum_holds(text)) damaged(file, kChanged);
    Run run = run_from_json(json);
    run.directory = folder;
    file = folder / "predictions.csv";
    read_predictions(file, json, run.fit);
    run.fit.calibration.parameters = parameters_by_name(cell, run.fit.calibration);
    file = folder / kNoiseFloor;
    if (const auto floor = diagnosed_floor(run)) run.fit.floor.inferred_m = floor->inferred_m;
    return run;
  } catch (const nlohmann::json::exception& e) {
    damaged(file, unexpected(e));
  } catch (const Failure& e) {
    if (e.problems().front().code == "E-RUN-DAMAGED") throw;
    damaged(file, fmt::format("cannot be read: {}", e.what()));
  }
}

bool is_of_cell(const Run& run, const Cell& cell) {
  return run.fit_sha256 == fit_hash(cell) || run.fit_sha256 == hash_of(cell);
}

std::optional<Run> current_run(const Cell& cell, const MeasurementFiles& measured) {
  const auto numbers = list_runs(cell);
  const auto inputs = inputs_of(measured);
  for (auto it = numbers.rbegin(); it != numbers.rend(); ++it) {
    Run run = load_run(cell, *it);
    if (!run.recheck && run.inputs == inputs && is_of_cell(run, cell)) return run;
  }
  return std::nullopt;
}

bool joins_line(const Run& later, std::vector<int>& line) {
  if (!later.recheck) return false;
  if (std::find(line.begin(), line.end(), later.recheck->parent) == line.end()) return false;
  line.push_back(later.number);
  return true;
}

Run latest_recheck(const Cell& cell, Run run) {
  std::vector<int> line{run.number};
  for (const int number : list_runs(cell)) {
    if (number <= line.front()) continue;
    Run later = load_run(cell, number);
    if (joins_line(later, line)) run = std::move(later);
  }
  return run;
}

std::optional<Run> left_out_recheck(const Cell& cell, const Run& run) {
  std::vector<int> known{run.number};  // numbers of this run and of those it goes back to
  Run start = run;
  for (; start.recheck; known.push_back(start.number))
    start = load_run(cell, start.recheck->parent);
  const auto numbers = list_runs(cell);
  for (auto it = numbers.rbegin(); it != numbers.rend(); ++it) {
    if (run.recheck && *it <= run.number) break;  // `run` itself was made after it
    if (std::find(known.begin(), known.end(), *it) != known.end()) continue;
    try {
      Run other = load_run(cell, *it);
      if (other.recheck && other.recheck->verdict == "changed" &&
          calibrated_run(cell, other).inputs == start.inputs)
        return other;
    } catch (const Failure&) {
      continue;  // a damaged run is passed over
    }
  }
  return std::nullopt;
}

Run calibrated_run(const Cell& cell, Run run) {
  while (run.recheck) run = load_run(cell, run.recheck->parent);
  return run;
}

}  // namespace plumb::offline

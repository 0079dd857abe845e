// SPDX-License-Identifier: Apache-2.0
#include "workbench/live_cell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <set>

#include "figures/registry.hpp"
#include "fit/cell_data.hpp"
#include "fit/controller_base.hpp"
#include "program/bounded_file.hpp"
#include "program/file.hpp"
#include "program/folder_lock.hpp"
#include "program/guarded.hpp"
#include "program/shell_word.hpp"
#include "runs/earlier_runs.hpp"
#include "runs/run_store.hpp"
#include "show/fit_view.hpp"
#include "show/runs_view.hpp"
#include "show/units.hpp"
#include "workbench/folder_watch.hpp"
#include "workbench/names.hpp"
#include "workbench/pose_columns.hpp"

namespace plumb::offline::workbench {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMostKept = std::size_t{32} << 20;  // [bytes]
constexpr std::size_t kMostViews = 2;
constexpr std::chrono::seconds kLongestLockWait{5};

std::int64_t now_ms() {
  return std::chrono::duration_cast<std::chrono::milliseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

/// What went wrong in `work`; nothing if it went well.
std::optional<Problem> problem_in(const std::function<void()>& work) {
  Outcome outcome;
  guarded("plumb", work, outcome);
  if (outcome.errors.empty()) return std::nullopt;
  return outcome.errors.front();
}

Json page_problem(const std::optional<Problem>& problem) {
  if (!problem) return nullptr;
  Json out{{"code", problem->code},
           {"message", problem->message},
           {"help", problem->help},
           {"file", nullptr},
           {"line", nullptr}};
  if (problem->place) {
    out["file"] = problem->place->file;
    if (problem->place->line > 0) out["line"] = problem->place->line;
  }
  return out;
}

std::vector<std::string> sha256_of(const MeasurementFiles& data) {
  std::vector<std::string> out;
  for (const auto& table : data.tables) out.push_back(table.sha256);
  return out;
}

std::vector<fs::path> files_of(const Cell& cell) {
  std::vector<fs::path> out = cell.measurement.files;
  for (const auto& setup : cell.measurement.setups)
    out.insert(out.end(), setup.files.begin(), setup.files.end());
  if (cell.measurement.held_out.kind == HeldOutRule::Kind::kFile)
    out.push_back(cell.measurement.held_out.file);
  return out;
}

Json joints_json(const Cell& cell) {
  Json out = Json::array();
  for (const auto& joint : cell.nominal.joints) {
    const bool slides = show::slides(joint);
    Json one{{"name", joint.name},
             {"type", slides ? "prismatic" : "revolute"},
             {"unit", show::unit(slides)}};
    put(one, "lower", show::shown(joint.q_min, slides));
    put(one, "upper", show::shown(joint.q_max, slides));
    out.push_back(std::move(one));
  }
  return out;
}

/// The lock that the verbs take; a file system without locks is worked in without one.
FolderLock locked(const fs::path& folder) {
  FolderLock lock(folder);
  if (lock.wait(kLongestLockWait) == FolderLock::State::kBusy)
    throw Failure(Exit::kEnvironment, {.code = "E-CELL-BUSY",
                                       .message = "another plumb is changing the cell",
                                       .help = "wait until it has ended, and save again"});
  return lock;
}

}  // namespace

LiveCell::LiveCell(fs::path cell_toml, SlowFigure slow_figure)
    : file_(std::move(cell_toml)),
      folder_(file_.parent_path()),
      slow_figure_(std::move(slow_figure)),
      state_(now_ms()) {}

std::vector<fs::path> LiveCell::data_files() const {
  return cell_ ? files_of(*cell_) : std::vector<fs::path>{};
}

void LiveCell::read_cell_again() {
  cell_.reset();
  text_.clear();
  cell_problem_ = problem_in([&] {
    text_ = read_file_up_to(file_, kMostCellBytes);
    cell_ = std::make_shared<const Cell>(parse_cell(text_, file_));
  });
  cell_sha256_ = cell_ ? hash_of(*cell_) : "";
  fit_sha256_ = cell_ ? fit_hash(*cell_) : "";
}

void LiveCell::read_data_again() {
  data_.reset();
  data_problem_.reset();
  data_sha256_.clear();
  if (!cell_) return;
  data_problem_ = problem_in([&] {
    Cell cell = *cell_;
    data_ = read_cell_measurements(cell);
    cell_ = std::make_shared<const Cell>(std::move(cell));
  });
  if (data_) data_sha256_ = sha256_of(*data_);
}

/// Reads again what has changed. Stamps are taken before the files are read: what changes in
/// between differs from its stamp, and is read again the next time.
void LiveCell::look() {
  const std::string folder_stamps =
      stamps_of({file_}) + stamps_inside(folder_) + stamps_of_runs(folder_);
  const bool folder_changed = folder_stamps != folder_stamps_;
  if (folder_changed) read_cell_again();
  const std::string data_stamps = stamps_of(data_files());
  if (!folder_changed && data_stamps == data_stamps_) return;
  folder_stamps_ = folder_stamps;
  data_stamps_ = data_stamps;
  read_data_again();
  views_.clear();
  answers_.clear();
  answer_bytes_ = 0;
  ++state_;
}

std::int64_t LiveCell::state() {
  const std::lock_guard lock(mutex_);
  look();
  return state_;
}

const Cell& LiveCell::present_cell() const {
  if (!cell_) throw Failure(Exit::kInput, *cell_problem_);
  return *cell_;
}

const MeasurementFiles& LiveCell::present_data() const {
  (void)present_cell();
  if (!data_) throw Failure(Exit::kInput, *data_problem_);
  return *data_;
}

/// The rows of the history, read only where a run has changed.
void LiveCell::look_at_runs() {
  const Cell& cell = present_cell();
  std::map<int, RunRow> rows;
  for (const int number : list_runs(cell)) {
    const fs::path folder = folder_ / "runs" / fmt::format("{:04}", number);
    const std::string stamp = stamps_of({folder / "run.json", folder / "predictions.csv"});
    if (const auto old = rows_.find(number); old != rows_.end() && old->second.stamp == stamp) {
      rows.emplace(number, std::move(old->second));
      continue;
    }
    RunRow row{.stamp = stamp, .row = nullptr, .fit_sha256 = {}, .data = {}, .problem = {}};
    row.problem = problem_in([&] {
      Run run = load_run(cell, number);
      row.fit_sha256 = run.fit_sha256;
      for (const auto& input : run.inputs) row.data.push_back(input.sha256);
      row.row = show::runs_json({{std::move(run), show::ListedRun::State::kOther}})["runs"][0];
    });
    rows.emplace(number, std::move(row));
  }
  rows_ = std::move(rows);
}

bool LiveCell::is_current(const RunRow& row) const {
  const bool of_cell = row.fit_sha256 == fit_sha256_ || row.fit_sha256 == cell_sha256_;
  return data_ && !row.problem && of_cell && row.data == data_sha256_;
}

/// The latest run of the present cell and data; 0 if there is none.
int LiveCell::current() const {
  for (auto at = rows_.rbegin(); at != rows_.rend(); ++at)
    if (is_current(at->second)) return at->first;
  return 0;
}

int LiveCell::number_or_current(int number) const {
  if (number > 0) return number;
  if (const int found = current(); found > 0) return found;
  throw Failure(Exit::kInput, {.code = "E-PLOT-RUN",
                               .message = "there is no run of the present cell and data",
                               .help = "plumb fit"});
}

Json LiveCell::run_list() {
  look_at_runs();
  Json out = Json::array();
  for (const auto& [number, row] : rows_) {
    if (row.problem) {
      out.push_back({{"run", number}, {"current", false}, {"damaged", page_problem(row.problem)}});
      continue;
    }
    out.push_back(row.row);
    out.back()["current"] = is_current(row);
  }
  return out;
}

Json LiveCell::cell_json() const {
  if (!cell_) return nullptr;
  return {{"name", cell_->name},
          {"serial", cell_->serial},
          {"robot", cell_->robot_name},
          {"folder", folder_.string()},
          {"tolerance_mm", show::to_mm(cell_->tolerance_m)},
          {"joints", joints_json(*cell_)},
          {"contexts", data_ ? context_names(data_->context) : std::vector<std::string>{}}};
}

Json LiveCell::data_json() const {
  if (!data_) return nullptr;
  Json files = Json::array();
  for (const auto& table : data_->tables)
    files.push_back({{"name", fs::path(table.file).filename().string()}, {"rows", table.rows()}});
  const auto ignored = std::count(data_->set.begin(), data_->set.end(), SetMark::kIgnore);
  return {
      {"files", std::move(files)},
      {"rows", data_->size()},
      {"poses", std::set<int>(data_->replicate_group.begin(), data_->replicate_group.end()).size()},
      {"used", data_->size() - ignored}};
}

/// The answer under this key in this state, made once.
Bytes LiveCell::kept(const std::string& key, const std::function<std::string()>& make) {
  if (const auto found = answers_.find(key); found != answers_.end()) return found->second;
  Bytes out = bytes(make());
  if (answer_bytes_ + out->size() > kMostKept) {
    answers_.clear();
    answer_bytes_ = 0;
  }
  answer_bytes_ += out->size();
  answers_[key] = out;
  return out;
}

/// What people ask first, of a run; null without one, and where it cannot be judged.
Json LiveCell::finding_of(int run) {
  Json out = nullptr;
  if (run <= 0) return out;
  (void)problem_in([&] { out = to_json(view(run).answers); });
  return out;
}

Bytes LiveCell::cell() {
  const std::lock_guard lock(mutex_);
  look();
  return kept("cell", [&] {
    Json runs = Json::array();
    if (cell_) runs = run_list();
    const int now = cell_ ? current() : 0;
    return json_line({{"cell", cell_json()},
                      {"folder", folder_.string()},
                      {"toml", text_},
                      {"state", state_},
                      {"data", data_json()},
                      {"runs", std::move(runs)},
                      {"current_run", now > 0 ? Json(now) : Json(nullptr)},
                      {"finding", finding_of(now)},
                      {"command", "plumb -C " + shell_word(folder_.string())},
                      {"problem", page_problem(cell_problem_ ? cell_problem_ : data_problem_)}});
  });
}

Bytes LiveCell::runs() {
  const std::lock_guard lock(mutex_);
  look();
  return kept("runs", [&] { return json_line({{"runs", run_list()}}); });
}

/// A run of the present data with its results, on the base that it was fitted to.
const LiveCell::RunView& LiveCell::view(int number) {
  (void)present_data();
  look_at_runs();
  number = number_or_current(number);
  for (auto at = views_.begin(); at != views_.end(); ++at) {
    if ((*at)->run.number != number) continue;
    auto found = std::move(*at);
    views_.erase(at);
    views_.push_front(std::move(found));
    return *views_.front();
  }
  Run run = load_run(*cell_, number);
  if (rows_.at(number).data != data_sha256_)
    throw Failure(Exit::kInput, {.code = "E-RUN-DATA",
                                 .message = fmt::format(
                                     "run {} was made from other measurements than the present "
                                     "ones",
                                     number),
                                 .help = "fit again: plumb fit"});
  auto made = std::make_unique<RunView>(RunView{cell_, *data_, std::move(run), std::nullopt, {}});
  if (made->run.fit.base == Base::kController) stand_on_controller(*cell_, made->measured);
  made->results.emplace(
      plumb::offline::figures::results_of(*made->cell, made->measured, made->run));
  made->answers = answers_of(*made->cell, made->measured, made->run);
  views_.push_front(std::move(made));
  if (views_.size() > kMostViews) views_.pop_back();
  return *views_.front();
}

Bytes LiveCell::run(int number) {
  const std::lock_guard lock(mutex_);
  look();
  return kept(fmt::format("run {}", number), [&] {
    const RunView& of = view(number);
    Json out = show::fit_json(*of.cell, of.measured, of.run.fit, of.answers);
    out["blocks"] = to_json(show::fit_blocks(*of.cell, of.measured, of.run.fit, of.answers));
    out["run"] = of.run.number;
    out["created"] = of.run.created;
    out["current"] = is_current(rows_.at(of.run.number));
    return json_line(out);
  });
}

Bytes LiveCell::poses(int number) {
  const std::lock_guard lock(mutex_);
  look();
  return kept(fmt::format("poses {}", number), [&] {
    const RunView& of = view(number);
    return json_line(pose_columns(*of.results, of.answers));
  });
}

Bytes LiveCell::frames(int number, int row) {
  const std::lock_guard lock(mutex_);
  look();
  return bytes(json_line(arm_frames(*view(number).results, row)));
}

Bytes LiveCell::figures(int number) {
  const std::lock_guard lock(mutex_);
  look();
  return kept(fmt::format("figures {}", number), [&] {
    const Cell& cell = present_cell();
    Json list = Json::array();
    for (const auto& [name, shows] : plumb::offline::figures::figures_of(cell))
      list.push_back({{"name", name}, {"title", name}, {"shows", shows}});
    return json_line({{"figures", std::move(list)}});
  });
}

/// Runs before this one that are of the same data and can be read.
Bytes LiveCell::figure(const std::string& name, int number, int width) {
  using Needs = plumb::offline::figures::FigureRow::Needs;
  std::unique_lock lock(mutex_);
  look();
  const std::string key = fmt::format("figure {} {} {}", name, number, width);
  const auto names = plumb::offline::figures::figure_names(present_cell());
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw Failure(Exit::kUsage, {.code = "E-PLOT-NAME",
                                 .message = fmt::format("this cell has no figure '{}'", name),
                                 .help = "list them: plumb plot --list"});
  const Needs needs = plumb::offline::figures::needs_of(name);
  if (needs == Needs::kRun || needs == Needs::kEarlierRuns)
    return kept(key, [&] {
      const RunView& of = view(number);
      const auto earlier =
          needs == Needs::kEarlierRuns ? earlier_runs(of.run, *cell_, *data_) : std::vector<Run>{};
      return plumb::offline::figures::drawn(name, *of.results, width, earlier).value();
    });
  if (needs == Needs::kDiagnosis && number > 0)
    throw Failure(Exit::kUsage, {.code = "E-USAGE",
                                 .message = "evidence is of the present cell, not of a run",
                                 .help = "leave run out"});
  if (const auto found = answers_.find(key); found != answers_.end()) return found->second;
  const std::int64_t before = state_;
  lock.unlock();
  std::string drawn = slow_figure_(name, number, width);
  lock.lock();
  if (state_ != before) return bytes(std::move(drawn));
  return kept(key, [&] { return std::move(drawn); });
}

void LiveCell::replace_text(const std::string& toml, std::int64_t if_state) {
  const std::lock_guard lock(mutex_);
  const FolderLock alone = locked(folder_);
  look();
  if (state_ != if_state)
    throw Failure(Exit::kInput, {.code = "E-SERVE-STATE",
                                 .message = "the cell was changed after this page had read it",
                                 .help = "look at what changed, and save again"});
  const auto known = data_files();
  for (const auto& file : files_of(parse_cell(toml, file_)))
    if (!lies_inside(file, folder_) && std::find(known.begin(), known.end(), file) == known.end())
      throw Failure(Exit::kUsage,
                    {.code = "E-SERVE-OUTSIDE",
                     .message = "a measurement file outside the folder of the cell can only be "
                                "named from a shell",
                     .help = "copy the file into the folder, or edit cell.toml by hand"});
  write_file_atomically(file_, toml);
}

}  // namespace plumb::offline::workbench

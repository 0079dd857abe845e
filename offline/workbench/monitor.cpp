// SPDX-License-Identifier: Apache-2.0
#include "workbench/monitor.hpp"

#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <charconv>
#include <numbers>
#include <thread>
#include <variant>

#include "plumb/format/reader.hpp"
#include "program/bounded_file.hpp"
#include "program/file.hpp"
#include "program/printable.hpp"
#include "program/shell_word.hpp"
#include "program/toml_table.hpp"
#include "workbench/folder_watch.hpp"

namespace plumb::offline::workbench {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

namespace {

constexpr std::size_t kMostSaid = std::size_t{64} << 10;
constexpr std::size_t kMostStopBytes = std::size_t{1} << 20;
constexpr const char* kStops = "twin-stops.csv";
constexpr const char* kStations = "500";  // about five minutes

/// Folders in that of the cell that hold an rt.toml, sorted.
std::vector<std::string> deployed_in(const fs::path& cell_folder) {
  std::vector<std::string> out;
  std::error_code error;
  for (fs::directory_iterator at(cell_folder, error), end; !error && at != end; at.increment(error))
    if (fs::is_regular_file(at->path() / "rt.toml", error))
      out.push_back(at->path().filename().string());
  std::sort(out.begin(), out.end());
  return out;
}

/// What rt.toml says of the bus and of the cycle.
struct RtFile {
  std::string kind = "can", interface = "can0", role = "client", address = "127.0.0.1";
  std::string model = "robot.plumb", mode = "shadow";
  int port = 502;
  double cycle_us = 4000.0, limited_mm = 0.5, limited_scale = 0.5;
};

RtFile read_rt_file(const fs::path& file) {
  TomlSource source(file.string(), read_file_up_to(file, kMostCellBytes), "E-RT");
  const toml::table parsed = source.parse();
  TomlTable top(parsed, "", source);
  RtFile out;
  if (auto table = top.table("source")) {
    out.kind = table->text_or("kind", out.kind);
    out.interface = table->text_or("interface", out.interface);
    out.role = table->text_or("role", out.role);
    out.address = table->text_or("address", out.address);
    out.port = static_cast<int>(table->number_or("port", out.port));
  }
  if (auto table = top.table("model")) out.model = table->text_or("file", out.model);
  if (auto table = top.table("limits")) {
    out.mode = table->text_or("mode", out.mode);
    out.limited_mm = table->number_or("limited_mm", out.limited_mm);
    out.limited_scale = table->number_or("limited_scale", out.limited_scale);
  }
  if (auto table = top.table("cycle")) out.cycle_us = table->number_or("cycle_us", out.cycle_us);
  return out;
}

Json short_problem(const Json& problem) {
  Json out = Json::object();
  for (const char* key : {"code", "message", "help"})
    out[key] = problem.contains(key) ? problem[key] : Json("");
  return out;
}

/// What a child said last, for a message.
std::string last_line(const std::string& said) {
  const auto end = said.find_last_not_of('\n');
  if (end == std::string::npos) return "";
  const auto begin = said.find_last_of('\n', end);
  return printable_line(valid_utf8(said.substr(begin + 1, end - begin)));
}

/// Reads what a child printed; true while it runs.
bool runs(std::unique_ptr<Child>& child, std::string& says) {
  if (!child) return false;
  const bool ended = child->has_ended();
  if (says.size() > kMostSaid / 2) says.erase(0, says.size() - kMostSaid / 4);
  std::string unused;
  (void)read_some(child->out(), unused, kMostSaid);
  (void)read_some(child->err(), says, kMostSaid);
  return !ended;
}

/// The largest correction that the guard of a model allows; nulls if it cannot be read.
Json guard_limits(const fs::path& file) {
  const auto read = format::read_model(file);
  const auto* model = std::get_if<format::Model>(&read);
  if (!model) return {{"max_correction_mm", nullptr}, {"max_rotation_deg", nullptr}};
  return {{"max_correction_mm", 1e3 * model->guard.max_correction_m},
          {"max_rotation_deg", 180.0 / std::numbers::pi * model->guard.max_rotation_rad}};
}

/// The number in a cell of a line of CSV; null if it is empty.
Json number_in(std::string_view cell) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return error == std::errc() && end == cell.data() + cell.size() ? Json(value) : Json(nullptr);
}

/// Mean of the numbers of a column; null if one is missing.
Json mean_of(const Json& column) {
  double sum = 0.0;
  for (const auto& value : column) {
    if (!value.is_number()) return nullptr;
    sum += value.get<double>();
  }
  if (column.empty()) return nullptr;
  return sum / static_cast<double>(column.size());
}

/// The whole lines of what plumb-twin --stops has written so far, by columns.
Json stops_in(const fs::path& file) {
  constexpr const char* kColumns[] = {"station",       "path_s",      "settled",
                                      "correction_mm", "true_off_mm", "true_on_mm"};
  Json out = Json::object();
  for (const char* name : kColumns) out[name] = Json::array();
  std::error_code error;
  const std::string text =
      fs::exists(file, error) ? read_file_up_to(file, kMostStopBytes) : std::string();
  std::size_t begin = text.find('\n') + 1;  // behind the names
  for (std::size_t end; begin > 0 && (end = text.find('\n', begin)) != std::string::npos;
       begin = end + 1) {
    std::string_view line(text.data() + begin, end - begin);
    for (const char* name : kColumns) {
      const auto comma = std::min(line.find(','), line.size());
      out[name].push_back(number_in(line.substr(0, comma)));
      line.remove_prefix(std::min(comma + 1, line.size()));
    }
  }
  out["off_mean_mm"] = mean_of(out["true_off_mm"]);
  out["on_mean_mm"] = mean_of(out["true_on_mm"]);
  return out;
}

/// The command that drives the twin of a cell on the bus of a deployed folder. Throws Failure
/// (kUsage, E-SERVE-TWIN) if the twin does not speak what rt.toml names.
std::vector<std::string> twin_words(const fs::path& cell_folder, const fs::path& deployed) {
  const RtFile file = read_rt_file(deployed / "rt.toml");
  std::vector<std::string> out{"plumb-twin",
                               "run",
                               cell_folder.string(),
                               "--layout",
                               (deployed / "rt.toml").string(),
                               "--stations",
                               kStations,
                               "--stops",
                               (deployed / kStops).string(),
                               "--force",
                               "--json"};
  if (file.kind == "can")
    out.insert(out.end(), {"--can", file.interface});
  else if (file.kind == "modbus" && file.role == "client")
    out.insert(out.end(), {"--modbus-serve", fmt::format("{}:{}", file.address, file.port)});
  else if (file.kind == "modbus")
    out.insert(out.end(), {"--modbus", fmt::format("{}:{}", file.address, file.port)});
  else
    throw Failure(Exit::kUsage, {.code = "E-SERVE-TWIN",
                                 .message = "the twin speaks CAN and Modbus, and rt.toml names "
                                            "neither",
                                 .help = "[deploy] in cell.toml, then plumb deploy"});
  // No correction comes in this mode: nothing to wait for, and the arm shows what it misses.
  if (file.mode == "shadow") out.insert(out.end(), {"--wait-s", "0"});
  return out;
}

/// As one types it.
std::string shell_line(const std::vector<std::string>& words) {
  std::string out;
  for (const auto& word : words) out += (out.empty() ? "" : " ") + shell_word(word);
  return out;
}

void end_child(std::unique_ptr<Child>& child) {
  if (!child) return;
  child->signal(SIGTERM);
  for (int i = 0; i < 100 && !child->has_ended(); ++i) std::this_thread::sleep_for(20ms);
  child.reset();
}

}  // namespace

Monitor::Monitor(fs::path cell_folder, const std::atomic<bool>& stop)
    : cell_folder_(std::move(cell_folder)), stop_(stop) {}

Monitor::~Monitor() {
  end_child(twin_);
  end_child(rt_);
}

std::string Monitor::look(const std::string& asked) {
  const std::lock_guard lock(mutex_);
  const auto folders = deployed_in(cell_folder_);
  const std::string folder = !asked.empty() ? asked : folders.empty() ? "" : folders.front();
  Json out{{"running", false},  {"twin", runs(twin_, twin_says_)},
           {"folder", folder},  {"folders", folders},
           {"status", nullptr}, {"limits", nullptr},
           {"stops", nullptr},  {"twin_command", nullptr},
           {"problem", nullptr}};
  const bool ours = runs(rt_, rt_says_);
  const auto say = [&](const char* code, std::string message, const char* help) {
    out["problem"] = {{"code", code}, {"message", std::move(message)}, {"help", help}};
    return json_line(out);
  };
  if (std::find(folders.begin(), folders.end(), folder) == folders.end())
    return say("E-SERVE-DEPLOYED", "there is no deployed folder of that name in the cell",
               "plumb deploy -o deploy");
  try {
    out["limits"] = limits_of(cell_folder_ / folder);
    if (std::error_code error; fs::is_regular_file(cell_folder_ / "twin.toml", error))
      out["twin_command"] = shell_line(twin_words(cell_folder_, cell_folder_ / folder));
    if (stops_ == cell_folder_ / folder / kStops) out["stops"] = stops_in(stops_);
    const ShortRun asked_rt = finished({{beside_own_program("plumb-rt").string(), "status",
                                         (cell_folder_ / folder).string(), "--json"},
                                        cell_folder_},
                                       5s, stop_);
    const Json answer = Json::parse(asked_rt.out, nullptr, false);
    if (answer.is_object() && answer.value("ok", false)) {
      out["running"] = true;
      out["status"] = answer["result"];
    } else if (answer.is_object() && answer.contains("error") && answer["error"].is_object()) {
      out["problem"] = short_problem(answer["error"]);
    }
  } catch (const Failure& failure) {
    out["problem"] = short_problem(problem_json(failure.problems().front()));
  }
  if (rt_ && !ours && !out["running"].get<bool>() && !rt_says_.empty())
    return say("E-SERVE-RT", "plumb-rt has ended: " + last_line(rt_says_), "plumb-rt doctor");
  if (twin_ && !out["twin"].get<bool>() && twin_->exit_code() > 0 && !twin_says_.empty())
    return say("E-SERVE-TWIN", "plumb-twin has ended: " + last_line(twin_says_),
               "plumb-twin run --help");
  return json_line(out);
}

/// What rt.toml and the guard of the model allow.
Json Monitor::limits_of(const fs::path& deployed) {
  const RtFile file = read_rt_file(deployed / "rt.toml");
  const fs::path model = deployed / file.model;
  if (const std::string stamp = stamps_of({model}); stamp != model_stamp_) {
    model_limits_ = guard_limits(model);
    model_stamp_ = stamp;
  }
  Json out = model_limits_;
  out["cycle_us"] = file.cycle_us;
  out["mode"] = file.mode;
  out["limited_mm"] = file.limited_mm;
  out["limited_scale"] = file.limited_scale;
  return out;
}

std::string Monitor::drive(const std::string& folder, Services::Drive what) {
  {
    const std::lock_guard lock(mutex_);
    end_child(twin_);
    end_child(rt_);
    if (what == Services::Drive::kStart) start(folder);
  }
  return look(folder);
}

void Monitor::start(const std::string& folder) {
  const fs::path deployed = cell_folder_ / folder;
  std::error_code error;
  if (!fs::is_regular_file(deployed / "rt.toml", error))
    throw Failure(Exit::kUsage, {.code = "E-SERVE-DEPLOYED",
                                 .message = fmt::format("{} holds no rt.toml", folder),
                                 .help = "plumb deploy -o " + folder});
  if (!fs::is_regular_file(cell_folder_ / "twin.toml", error))
    throw Failure(Exit::kUsage,
                  {.code = "E-SERVE-TWIN",
                   .message = "the cell has no twin.toml: there is no simulated robot to drive",
                   .help = "plumb-twin new mytwin, or start plumb-rt beside your robot"});
  ChildCommand twin{twin_words(cell_folder_, deployed), cell_folder_};
  twin.words.front() = beside_own_program("plumb-twin").string();
  rt_says_.clear();
  twin_says_.clear();
  stops_ = deployed / kStops;
  fs::remove(stops_, error);
  rt_ = started(
      {{beside_own_program("plumb-rt").string(), "run", deployed.string(), "--priority", "0"},
       cell_folder_});
  twin_ = started(twin);
}

}  // namespace plumb::offline::workbench

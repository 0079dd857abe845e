// SPDX-License-Identifier: Apache-2.0
#include "workbench/monitor.hpp"

#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <optional>
#include <thread>

#include "program/bounded_file.hpp"
#include "program/file.hpp"
#include "program/printable.hpp"
#include "program/toml_table.hpp"

namespace plumb::offline::workbench {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

namespace {

constexpr std::size_t kMostSaid = std::size_t{64} << 10;

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
  std::string kind = "can", interface = "can0", role = "client", address = "127.0.0.1", mode;
  int port = 502;
  double cycle_us = 4000.0;
  std::optional<double> max_correction_mm, max_rotation_deg;  // ceilings of every model
};

Json number_or_null(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

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
  if (auto table = top.table("limits")) {
    out.mode = table->text_or("mode", "");
    out.max_correction_mm = table->number("max_correction_mm");
    out.max_rotation_deg = table->number("max_rotation_deg");
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
    const RtFile file = read_rt_file(cell_folder_ / folder / "rt.toml");
    out["limits"] = {{"max_correction_mm", number_or_null(file.max_correction_mm)},
                     {"max_rotation_deg", number_or_null(file.max_rotation_deg)},
                     {"cycle_us", file.cycle_us},
                     {"mode", file.mode}};
    const ShortRun asked_rt = run_to_end({{beside_own_program("plumb-rt").string(), "status",
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
  const RtFile file = read_rt_file(deployed / "rt.toml");
  std::vector<std::string> link;
  if (file.kind == "can")
    link = {"--can", file.interface};
  else if (file.kind == "modbus" && file.role == "client")
    link = {"--modbus-serve", fmt::format("{}:{}", file.address, file.port)};
  else if (file.kind == "modbus")
    link = {"--modbus", fmt::format("{}:{}", file.address, file.port)};
  else
    throw Failure(Exit::kUsage, {.code = "E-SERVE-TWIN",
                                 .message = "the twin speaks CAN and Modbus, and rt.toml names "
                                            "neither",
                                 .help = "[deploy] in cell.toml, then plumb deploy"});
  rt_says_.clear();
  twin_says_.clear();
  rt_ = std::make_unique<Child>(ChildCommand{
      {beside_own_program("plumb-rt").string(), "run", deployed.string(), "--priority", "0"},
      cell_folder_});
  ChildCommand twin{
      {beside_own_program("plumb-twin").string(), "run", cell_folder_.string(), "--layout",
       (deployed / "rt.toml").string(), "--correction", "on", "--stations", "10000", "--json"},
      cell_folder_};
  twin.words.insert(twin.words.end(), link.begin(), link.end());
  twin_ = std::make_unique<Child>(twin);
}

}  // namespace plumb::offline::workbench

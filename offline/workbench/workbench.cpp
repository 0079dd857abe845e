// SPDX-License-Identifier: Apache-2.0
#include "workbench/workbench.hpp"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <system_error>
#include <thread>

#include "program/bounded_file.hpp"
#include "program/file.hpp"
#include "program/problem.hpp"
#include "program/scratch_folder.hpp"
#include "workbench/cell_files.hpp"
#include "workbench/child.hpp"
#include "workbench/job_runner.hpp"
#include "workbench/live_cell.hpp"
#include "workbench/monitor.hpp"
#include "workbench/page_files.hpp"
#include "workbench/router.hpp"
#include "workbench/server.hpp"

namespace plumb::offline::workbench {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

namespace {

constexpr auto kLongestFigure = 900s;
constexpr auto kBetweenLooks = 500ms;

ScratchFolder temporary_folder() {
  try {
    return ScratchFolder("plumb-serve-");
  } catch (const std::system_error&) {
    throw Failure(Exit::kEnvironment, {.code = "E-WRITE",
                                       .message = "no temporary folder can be made",
                                       .help = "df -h " + fs::temp_directory_path().string()});
  }
}

/// A figure that needs more than a run (a diagnosis, a plan, a benchmark), drawn by a child: that
/// keeps its memory and its time apart. `number` is 0 for the run of the present cell.
std::string drawn_by_child(const fs::path& folder, const std::string& name, int number, int width,
                           const std::atomic<bool>& stop) {
  const ScratchFolder scratch = temporary_folder();
  const fs::path file = scratch.path() / "figure.svg";
  std::vector<std::string> command{
      own_program().string(), "-C", folder.string(), "plot",  name, "--width",
      std::to_string(width),  "-o", file.string(),   "--json"};
  if (number > 0) command.insert(command.end(), {"--run", std::to_string(number)});
  const ShortRun run = finished({std::move(command), folder}, kLongestFigure, stop);
  if (run.exit_code == 0) return read_file_up_to(file, kMostCellBytes);
  const Json said = Json::parse(run.out, nullptr, false);
  Problem problem{.code = "E-SERVE-CHILD",
                  .message = "the figure could not be drawn",
                  .help = "plumb plot " + name};
  if (said.is_object() && said.contains("error") && said["error"].is_object()) {
    problem.code = said["error"].value("code", problem.code);
    problem.message = said["error"].value("message", problem.message);
    problem.help = said["error"].value("help", problem.help);
  }
  throw Failure(Exit::kInput, problem);
}

/// Looks at the cell every half second and says when it is another one.
class Watch {
 public:
  Watch(LiveCell& cell, std::function<void(std::int64_t)> changed)
      : cell_(cell), changed_(std::move(changed)), thread_([this] { run(); }) {}
  ~Watch() {
    {
      const std::lock_guard lock(mutex_);
      ending_ = true;
    }
    wake_.notify_one();
    thread_.join();
  }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

 private:
  void run() {
    std::int64_t told = cell_.state();
    std::unique_lock lock(mutex_);
    while (!wake_.wait_for(lock, kBetweenLooks, [this] { return ending_; })) {
      const std::int64_t now = cell_.state();
      if (now != told) changed_(now);
      told = now;
    }
  }

  LiveCell& cell_;
  std::function<void(std::int64_t)> changed_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool ending_ = false;
  std::thread thread_;
};

std::string state_message(std::int64_t state) {
  return fmt::format(R"({{"type":"state","state":{}}})", state);
}

class CellServices final : public Services {
 public:
  CellServices(const fs::path& cell_toml, JobRunner::Changed tell)
      : folder_(cell_toml.parent_path()),
        cell_(cell_toml,
              [this](const std::string& name, int number, int width) {
                return drawn_by_child(folder_, name, number, width, stop_);
              }),
        jobs_(folder_, tell),
        monitor_(folder_, stop_),
        watch_(cell_, [tell](std::int64_t now) { tell(state_message(now)); }) {}

  void stop() { stop_ = true; }

  std::optional<Response> page(const std::string& name) override { return page_file(name); }
  std::int64_t state() override { return cell_.state(); }
  Bytes cell() override { return cell_.cell(); }
  Bytes runs() override { return cell_.runs(); }
  Bytes run(int number) override { return cell_.run(number); }
  Bytes poses(int run) override { return cell_.poses(run); }
  Bytes frames(int run, int row) override { return cell_.frames(run, row); }
  Bytes figures(int run) override { return cell_.figures(run); }
  Bytes figure(const std::string& name, int run, int width) override {
    return cell_.figure(name, run, width);
  }

  std::string files() override { return list_files(folder_); }
  Response file(const std::string& name) override { return read_cell_file(folder_, name); }
  std::string put_file(const std::string& name, const std::string& content,
                       Replace replace) override {
    return store_file(folder_, name, content, replace);
  }
  std::string put_cell(const std::string& toml, std::int64_t if_state) override {
    cell_.replace_text(toml, if_state);
    return Json{{"state", cell_.state()}}.dump();
  }

  std::string jobs() override { return jobs_.jobs(); }
  std::string job(int number) override { return jobs_.job(number); }
  std::string start_job(const JobRequest& job) override { return jobs_.start(job); }
  std::string stop_job(int number) override { return jobs_.stop(number); }

  std::string monitor(const std::string& folder) override { return monitor_.look(folder); }
  std::string drive(const std::string& folder, Drive what) override {
    return monitor_.drive(folder, what);
  }

 private:
  const fs::path folder_;
  std::atomic<bool> stop_{false};
  LiveCell cell_;
  JobRunner jobs_;
  Monitor monitor_;
  Watch watch_;
};

}  // namespace

void serve(const ServeSettings& settings,
           const std::function<void(const std::string& url)>& ready) {
  Server server(settings.port);
  const Access access{.port = server.port(), .token = new_token()};
  CellServices services(fs::absolute(settings.cell_toml).lexically_normal(),
                        [&](const std::string& message) { server.broadcast(message); });
  ready(fmt::format("http://127.0.0.1:{}/?token={}", access.port, access.token));
  server.run({.answer = [&](const Request& r) { return answer(r, access, services); },
              .refuse = [&](const Request& r) { return refusal(r, access); },
              .refuse_socket = [&](const Request& r) { return socket_refusal(r, access); },
              .greeting = [&] { return state_message(services.state()); },
              .stopping = [&] { services.stop(); }});
}

}  // namespace plumb::offline::workbench

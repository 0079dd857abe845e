// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "workbench/child.hpp"
#include "workbench/response.hpp"
#include "workbench/services.hpp"

namespace plumb::offline::workbench {

/// Runs the actions of the page as child processes: one that writes at a time, in their order, and
/// up to two that only read beside it. Every function may be called from any thread.
///
/// Bounds: 32 jobs wait at most; the last 100 are remembered, 48 MB of their output, and 200 lines
/// of each one's messages.
class JobRunner {
 public:
  /// `changed`: called with {"job": ...} of a job whose state or progress is another one now.
  using Changed = std::function<void(const std::string& json)>;
  JobRunner(std::filesystem::path folder, Changed changed);
  ~JobRunner();  // ends the children
  JobRunner(const JobRunner&) = delete;
  JobRunner& operator=(const JobRunner&) = delete;

  /// Returns {"job": K, "command": "..."}. Throws Failure: E-SERVE-JOB, E-SERVE-QUEUE.
  std::string start(const JobRequest& request);

  // As JSON. Throw Failure E-SERVE-MISSING if there is no such job.
  std::string job(int number);
  std::string jobs();
  std::string stop(int number);

 private:
  using Clock = std::chrono::steady_clock;
  enum class State { kWaiting, kRunning, kDone, kFailed, kStopped };
  struct Job {
    int number = 0;
    JobRequest request;
    std::string command;
    State state = State::kWaiting;
    std::deque<std::string> progress = {};
    std::string unfinished_line = {};
    std::string output = {};
    int exit = -1;
    bool stop_asked = false, too_much = false;
    Clock::time_point began = {}, ended = {}, killed_at = {};
    std::unique_ptr<Child> child = {};
  };

  static const char* name_of(State state);
  Json summary(const Job& job) const;
  Job& find(int number);
  void run();
  void start_waiting();
  void serve(Job& job);
  void finish(Job& job);
  void take_lines(Job& job, const std::string& text);
  void forget_old();
  void tell(const Job& job);
  void wake() const;
  std::size_t running(bool reading) const;

  const std::filesystem::path folder_;
  const Changed changed_;
  std::mutex mutex_;
  std::map<int, Job> jobs_;
  int last_ = 0;
  int wake_ = -1;  // an eventfd
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace plumb::offline::workbench

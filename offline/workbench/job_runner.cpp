// SPDX-License-Identifier: Apache-2.0
#include "workbench/job_runner.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>

#include "program/printable.hpp"
#include "program/problem.hpp"
#include "workbench/job.hpp"

namespace plumb::offline::workbench {

using namespace std::chrono_literals;

namespace {

constexpr std::size_t kMostWaiting = 32, kMostJobs = 100, kMostLines = 200, kLongestLine = 500;
constexpr std::size_t kMostOutput = std::size_t{32} << 20, kMostOutputs = std::size_t{48} << 20;
constexpr std::size_t kMostReading = 2;
constexpr auto kUntilKilled = 5s;

double seconds_between(std::chrono::steady_clock::time_point from,
                       std::chrono::steady_clock::time_point to) {
  return 1e-3 * static_cast<double>(
                    std::chrono::duration_cast<std::chrono::milliseconds>(to - from).count());
}

}  // namespace

const char* JobRunner::name_of(State state) {
  switch (state) {
    case State::kWaiting:
      return "waiting";
    case State::kRunning:
      return "running";
    case State::kDone:
      return "done";
    case State::kFailed:
      return "failed";
    default:
      return "stopped";
  }
}

JobRunner::JobRunner(std::filesystem::path folder, Changed changed)
    : folder_(std::move(folder)),
      changed_(std::move(changed)),
      wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  thread_ = std::thread([this] { run(); });
}

JobRunner::~JobRunner() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  wake();
  thread_.join();
  ::close(wake_);
}

void JobRunner::wake() const {
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = ::write(wake_, &one, sizeof one);
}

/// All of a job but its output.
Json JobRunner::summary(const Job& job) const {
  const bool ended = job.state != State::kWaiting && job.state != State::kRunning;
  const auto until = ended ? job.ended : Clock::now();
  return {{"job", job.number},
          {"verb", job.request.verb},
          {"args", job.request.args},
          {"command", job.command},
          {"state", name_of(job.state)},
          {"progress", job.progress},
          {"exit", ended && job.exit >= 0 ? Json(job.exit) : Json(nullptr)},
          {"seconds", job.began == Clock::time_point{} ? 0.0 : seconds_between(job.began, until)}};
}

JobRunner::Job& JobRunner::find(int number) {
  if (const auto found = jobs_.find(number); found != jobs_.end()) return found->second;
  throw Failure(Exit::kUsage, {.code = "E-SERVE-MISSING",
                               .message = fmt::format("there is no job {}", number),
                               .help = "the server was started again, or the job is long past"});
}

std::string JobRunner::start(const JobRequest& request) {
  check_job(request, folder_);
  const std::lock_guard lock(mutex_);
  const auto waiting = std::count_if(jobs_.begin(), jobs_.end(), [](const auto& one) {
    return one.second.state == State::kWaiting;
  });
  if (static_cast<std::size_t>(waiting) >= kMostWaiting)
    throw Failure(Exit::kEnvironment, {.code = "E-SERVE-QUEUE",
                                       .message = "too many jobs are waiting",
                                       .help = "wait until some have ended, or stop them"});
  Job job{.number = ++last_, .request = request, .command = job_command(request, folder_)};
  const int number = job.number;
  const Json out{{"job", number}, {"command", job.command}};
  jobs_.emplace(number, std::move(job));
  forget_old();
  wake();
  return json_line(out);
}

std::string JobRunner::job(int number) {
  const std::lock_guard lock(mutex_);
  const Job& job = find(number);
  std::string out = json_line(summary(job));
  const bool ended = job.state != State::kWaiting && job.state != State::kRunning;
  out.pop_back();
  return out + ",\"output\":" + (ended && !job.output.empty() ? job.output : "null") + '}';
}

std::string JobRunner::jobs() {
  const std::lock_guard lock(mutex_);
  Json out = Json::array();
  for (const auto& [number, job] : jobs_) out.push_back(summary(job));
  return json_line({{"jobs", std::move(out)}});
}

std::string JobRunner::stop(int number) {
  const std::lock_guard lock(mutex_);
  Job& job = find(number);
  if (job.state == State::kWaiting) {
    job.state = State::kStopped;
    job.began = job.ended = Clock::now();
    tell(job);
  } else if (job.state == State::kRunning && !job.stop_asked) {
    job.stop_asked = true;
    job.killed_at = Clock::now() + kUntilKilled;
    job.child->signal(SIGINT);
  }
  return json_line(summary(job));
}

void JobRunner::tell(const Job& job) {
  Json message{{"type", "job"}};
  message.update(summary(job));
  changed_(json_line(message));
}

std::size_t JobRunner::running(bool reading) const {
  return static_cast<std::size_t>(std::count_if(jobs_.begin(), jobs_.end(), [&](const auto& one) {
    return one.second.state == State::kRunning && only_reads(one.second.request) == reading;
  }));
}

/// From this thread alone, because a child ends with the thread that made it.
void JobRunner::start_waiting() {
  for (auto& [number, job] : jobs_) {
    if (job.state != State::kWaiting) continue;
    const bool reading = only_reads(job.request);
    if (running(reading) >= (reading ? kMostReading : 1)) continue;
    job.began = Clock::now();
    try {
      job.child = started(job_process(job.request, folder_));
      job.state = State::kRunning;
    } catch (const Failure& failure) {
      job.state = State::kFailed;
      job.ended = job.began;
      job.progress.emplace_back(failure.what());
    }
    tell(job);
  }
}

void JobRunner::take_lines(Job& job, const std::string& text) {
  job.unfinished_line += text;
  bool more = false;
  for (std::size_t at; (at = job.unfinished_line.find('\n')) != std::string::npos;) {
    std::string line = job.unfinished_line.substr(0, std::min(at, kLongestLine));
    job.unfinished_line.erase(0, at + 1);
    job.progress.push_back(printable_line(valid_utf8(line)));
    if (job.progress.size() > kMostLines) job.progress.pop_front();
    more = true;
  }
  if (job.unfinished_line.size() > kLongestLine) job.unfinished_line.resize(kLongestLine);
  if (more && job.state == State::kRunning) tell(job);
}

void JobRunner::finish(Job& job) {
  job.exit = job.child->exit_code();
  job.child.reset();
  job.ended = Clock::now();
  if (!job.unfinished_line.empty()) take_lines(job, "\n");
  job.state = job.stop_asked ? State::kStopped : job.exit == 0 ? State::kDone : State::kFailed;
  if (job.too_much) {
    job.progress.emplace_back("its output is longer than 32 MB and was left out");
    job.state = State::kFailed;
  }
  if (job.too_much || !Json::accept(job.output)) job.output.clear();
  forget_old();
  tell(job);
}

void JobRunner::serve(Job& job) {
  const bool ended = job.child->has_ended();  // what it wrote before is in the pipes by now
  job.too_much =
      read_some(job.child->out(), job.output, kMostOutput) == Pipe::kTooMuch || job.too_much;
  std::string lines;
  (void)read_some(job.child->err(), lines, kMostOutput);
  if (!lines.empty()) take_lines(job, lines);
  if (ended) return finish(job);
  if (job.stop_asked && Clock::now() > job.killed_at) job.child->signal(SIGKILL);
}

/// Outputs of the oldest jobs go first, then the jobs.
void JobRunner::forget_old() {
  std::size_t total = 0;
  for (const auto& [number, job] : jobs_) total += job.output.size();
  for (auto at = jobs_.begin(); at != jobs_.end();) {
    Job& job = at->second;
    const bool ended = job.state != State::kWaiting && job.state != State::kRunning;
    if (ended && total > kMostOutputs) {
      total -= job.output.size();
      job.output = {};
    }
    at = ended && jobs_.size() > kMostJobs ? jobs_.erase(at) : std::next(at);
  }
}

void JobRunner::run() {
  for (;;) {
    std::vector<pollfd> files{{wake_, POLLIN, 0}};
    {
      const std::lock_guard lock(mutex_);
      if (ending_) break;
      start_waiting();
      for (auto& [number, job] : jobs_)
        if (job.state == State::kRunning) {
          files.push_back({job.child->out(), POLLIN, 0});
          files.push_back({job.child->err(), POLLIN, 0});
        }
    }
    // A closed pipe is ready at once, so the end of a child is looked for in small steps.
    ::poll(files.data(), files.size(), files.size() > 1 ? 50 : -1);
    std::uint64_t count = 0;
    [[maybe_unused]] const auto cleared = ::read(wake_, &count, sizeof count);
    const bool hung_up = std::any_of(files.begin(), files.end(), [](const pollfd& file) {
      return (file.revents & POLLHUP) != 0 && (file.revents & POLLIN) == 0;
    });
    if (hung_up) std::this_thread::sleep_for(2ms);
    const std::lock_guard lock(mutex_);
    for (auto& [number, job] : jobs_)
      if (job.state == State::kRunning) serve(job);
  }
  const std::lock_guard lock(mutex_);
  for (auto& [number, job] : jobs_)
    if (job.child) job.child->signal(SIGTERM);
  const auto end = Clock::now() + 2s;
  for (auto& [number, job] : jobs_) {
    while (job.child && !job.child->has_ended() && Clock::now() < end)
      std::this_thread::sleep_for(10ms);
    job.child.reset();
  }
}

}  // namespace plumb::offline::workbench

// SPDX-License-Identifier: Apache-2.0
#include "twin/stop_log.hpp"

#include <fmt/format.h>

#include "program/problem.hpp"
#include "twin/tracker.hpp"

namespace plumb::offline::twin {
namespace {

constexpr double kMm = 1e3;

[[noreturn]] void refuse(const std::filesystem::path& file) {
  throw Failure(Exit::kEnvironment, {.code = "E-WRITE",
                                     .message = "cannot write " + file.string(),
                                     .help = "check the folder and its free space: df -h"});
}

}  // namespace

StopLog::StopLog(const std::filesystem::path& file, const Arm& arm) : file_(file), arm_(arm) {
  (void)true_errors(arm.cell, arm.hidden, arm.truth, arm.stations, {});  // throws here, if at all
  out_.open(file, std::ios::trunc);
  out_ << "station,path_s,settled,correction_mm,true_off_mm,true_on_mm\n" << std::flush;
  if (!out_) refuse(file_);
  thread_ = std::thread([this] { run(); });
}

StopLog::~StopLog() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  news_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void StopLog::look(const std::vector<Stop>& stops) {
  {
    const std::lock_guard lock(mutex_);
    if (stops.size() == stops_.size()) return;
    for (std::size_t k = stops_.size(); k < stops.size(); ++k) stops_.push_back(stops[k]);
  }
  news_.notify_one();
}

void StopLog::finish() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  news_.notify_one();
  thread_.join();
  if (!out_) refuse(file_);
}

void StopLog::run() {
  std::unique_lock lock(mutex_);
  for (std::size_t written = 0;;) {
    news_.wait(lock, [&] { return ended_ || stops_.size() > written; });
    if (stops_.size() == written) return;
    const std::vector<Stop> now = stops_;
    lock.unlock();
    write(now, written);
    written = now.size();
    lock.lock();
  }
}

/// The error of a stop depends on those before it, where the arm has a memory: all are computed.
void StopLog::write(const std::vector<Stop>& stops, std::size_t written) {
  const TrueErrors errors = true_errors(arm_.cell, arm_.hidden, arm_.truth, arm_.stations, stops);
  std::string lines;
  for (std::size_t k = written; k < stops.size(); ++k) {
    const auto off = static_cast<std::size_t>(stops[k].station);
    lines += fmt::format(
        "{},{:.3f},{},{:.6f},{},{:.6f}\n", stops[k].station, stops[k].path_s,
        stops[k].settled ? 1 : 0, kMm * stops[k].offset.translation.norm(),
        off < arm_.off_m.size() ? fmt::format("{:.6f}", kMm * arm_.off_m[off]) : std::string(),
        kMm * errors.each_m[k]);
  }
  out_ << lines << std::flush;
}

}  // namespace plumb::offline::twin

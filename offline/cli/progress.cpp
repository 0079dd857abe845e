// SPDX-License-Identifier: Apache-2.0
#include "cli/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "program/interrupt.hpp"

namespace plumb::offline::cli {

using namespace std::chrono_literals;

namespace {

/// Whether a line can be overwritten, as on a terminal.
bool is_terminal() {
  const char* const term = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) != 0 && term != nullptr && std::string_view(term) != "dumb";
}

}  // namespace

Progress::Progress(std::string what) : what_(std::move(what)) {
  const Writing no_signals;  // a thread inherits the mask
  thread_ = std::thread([this] { run(); });
}

Progress::~Progress() {
  {
    const std::lock_guard lock(mutex_);
    done_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void Progress::at(const std::string& step) {
  {
    const std::lock_guard lock(mutex_);
    step_ = step;
  }
  changed_.notify_one();
}

std::string Progress::now() const { return step_.empty() ? what_ : what_ + ": " + step_; }

void Progress::run() {
  std::unique_lock lock(mutex_);
  if (changed_.wait_for(lock, 1s, [this] { return done_; })) return;
  if (is_terminal())
    run_clock(lock);
  else
    run_lines(lock);
}

void Progress::run_clock(std::unique_lock<std::mutex>& lock) {
  for (int seconds = 1; !done_; ++seconds) {
    fmt::print(stderr, "\r\x1b[K{} ... {} s", now(), seconds);
    std::fflush(stderr);
    changed_.wait_for(lock, 1s, [this] { return done_; });
  }
  fmt::print(stderr, "\r\x1b[K");
  std::fflush(stderr);
}

void Progress::run_lines(std::unique_lock<std::mutex>& lock) {
  while (!done_) {
    const std::string said = now();
    fmt::print(stderr, "{} ...\n", said);
    changed_.wait(lock, [&] { return done_ || now() != said; });
  }
}

}  // namespace plumb::offline::cli

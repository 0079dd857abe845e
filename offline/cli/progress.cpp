// SPDX-License-Identifier: Apache-2.0
#include "cli/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>

#include "program/interrupt.hpp"

namespace plumb::offline::cli {

using namespace std::chrono_literals;

Progress::Progress(std::string what) : what_(std::move(what)) {
  const Writing no_signals;  // a thread inherits the mask
  thread_ = std::thread([this] { run(); });
}

Progress::~Progress() {
  {
    const std::lock_guard lock(mutex_);
    done_ = true;
  }
  ended_.notify_one();
  thread_.join();
}

void Progress::run() {
  std::unique_lock lock(mutex_);
  const auto done = [this] { return done_; };
  if (ended_.wait_for(lock, 1s, done)) return;
  if (::isatty(STDERR_FILENO) == 0) {
    fmt::print(stderr, "{} ...\n", what_);
    return;
  }
  for (int seconds = 1;; ++seconds) {
    fmt::print(stderr, "\r{} ... {} s", what_, seconds);
    std::fflush(stderr);
    if (ended_.wait_for(lock, 1s, done)) break;
  }
  fmt::print(stderr, "\r\x1b[K");
  std::fflush(stderr);
}

}  // namespace plumb::offline::cli

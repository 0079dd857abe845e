// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace plumb::offline::cli {

/// Says on stderr what takes so long, and how far it is, once it has taken more than a second: a
/// running clock on a terminal, elsewhere a line for every step and no control characters. Ends
/// with the scope. Its thread takes no signals.
class Progress {
 public:
  explicit Progress(std::string what);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// What it is at: "step 2 of 4, trying every effect". From any thread.
  void at(const std::string& step);

 private:
  void run();
  void run_clock(std::unique_lock<std::mutex>& lock);
  void run_lines(std::unique_lock<std::mutex>& lock);
  std::string now() const;

  std::string what_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::string step_;
  bool done_ = false;
  std::thread thread_;
};

}  // namespace plumb::offline::cli

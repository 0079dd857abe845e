// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <future>
#include <thread>
#include <vector>

namespace plumb::offline {

/// Runs job(0) .. job(count - 1) on all processors; each job writes only its own result, so the
/// outcome does not depend on the number of threads. Exceptions of the jobs are thrown again here.
template <class Job>
void run_jobs(int count, const Job& job) {
  std::atomic<int> next = 0;
  const auto work = [&] {
    for (int i = next++; i < count; i = next++) job(i);
  };
  const int helpers = std::min(count, static_cast<int>(std::thread::hardware_concurrency())) - 1;
  std::vector<std::future<void>> running;
  for (int i = 0; i < helpers; ++i) running.push_back(std::async(std::launch::async, work));
  work();
  for (auto& helper : running) helper.get();
}

}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#include "tests/blind/study.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>

namespace plumb::tests {

std::vector<Score> run_study(std::uint64_t seed, int cases, const std::function<void(int)>& done) {
  return run_study([seed](int number) { return draw_case(seed, number); }, cases, done);
}

std::vector<Score> run_study(const std::function<HiddenCase(int)>& draw, int cases,
                             const std::function<void(int)>& done) {
  std::vector<Score> scores(static_cast<std::size_t>(cases));
  std::atomic<int> next{0};
  std::mutex telling;
  int finished = 0;
  const auto work = [&] {
    for (int i = next++; i < cases; i = next++) {
      scores[static_cast<std::size_t>(i)] = run_case(draw(i));
      const std::lock_guard lock(telling);
      done(++finished);
    }
  };
  std::vector<std::jthread> others;
  for (unsigned k = 1; k < std::max(1U, std::thread::hardware_concurrency()); ++k)
    others.emplace_back(work);
  work();
  others.clear();
  return scores;
}

}  // namespace plumb::tests

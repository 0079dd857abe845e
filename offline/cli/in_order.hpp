// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <deque>
#include <future>
#include <optional>
#include <thread>
#include <utility>

namespace plumb::offline::cli {

/// Threads worth starting: one for each core that this program may use, up to eight.
inline unsigned usable_threads() { return std::clamp(std::thread::hardware_concurrency(), 1U, 8U); }

/// Works on items side by side and takes the results in the order of the items, so that the outcome
/// does not depend on the number of threads.
///
/// next: the next item, std::optional, empty at the end; called by this thread
/// work: item to result; called by any thread; not more than `threads` at a time
/// take: of each result, in order, by this thread. False: no further items
/// An exception of `work` is thrown where its result would be taken.
template <class Next, class Work, class Take>
void in_order(unsigned threads, Next next, Work work, Take take) {
  using Item = typename decltype(next())::value_type;
  using Result = decltype(work(std::declval<Item>()));
  std::deque<std::future<Result>> running;
  bool more = true;
  while (more || !running.empty()) {
    while (more && running.size() < threads) {
      auto item = next();
      more = item.has_value();
      if (more) running.push_back(std::async(std::launch::async, work, std::move(*item)));
    }
    if (running.empty()) return;
    Result result = running.front().get();
    running.pop_front();
    if (!take(std::move(result))) more = false;
  }
}

}  // namespace plumb::offline::cli

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <ctime>
#include <functional>
#include <thread>

namespace plumb::drivers {

/// The thread of a link. It has a name, never a real-time priority, and all signals blocked, so
/// that they reach the program's own thread. It is asked to stop through a descriptor, which it
/// also watches whenever it waits.
///
/// start() and stop() must be called from one other thread.
class LinkThread {
 public:
  LinkThread();
  ~LinkThread();
  LinkThread(const LinkThread&) = delete;
  LinkThread& operator=(const LinkThread&) = delete;

  /// Starts the thread. `name` has at most 15 characters. Returns 0 or an errno.
  int start(const char* name, std::function<void()> work);
  void stop();  // returns when `work` has returned; may be called twice

  bool stopping() const noexcept { return stopping_.load(std::memory_order_relaxed); }
  int stop_event() const noexcept { return event_; }  // readable once the thread shall stop

  /// Returns false if the thread shall stop.
  bool sleep_until_ns(std::int64_t time_ns) const noexcept;

 private:
  int event_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

/// The time from now until `time_ns` as ppoll takes it; 0 if that is past.
timespec wait_until(std::int64_t time_ns) noexcept;

constexpr std::int64_t to_ns(double time_s) noexcept {
  return static_cast<std::int64_t>(time_s * 1e9);
}

}  // namespace plumb::drivers

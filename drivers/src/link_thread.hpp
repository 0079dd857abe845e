// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <ctime>
#include <functional>
#include <thread>

namespace plumb::drivers {

/// The thread of a link: named, of no real-time priority whoever starts it, and deaf to signals, so
/// that those reach the program's own thread. It is asked to stop through a descriptor, which its
/// waits also watch.
///
/// start(), stop(): one thread, not its own.
class LinkThread {
 public:
  LinkThread();
  ~LinkThread();
  LinkThread(const LinkThread&) = delete;
  LinkThread& operator=(const LinkThread&) = delete;

  /// `name`: 15 characters at most. 0, or an errno.
  int start(const char* name, std::function<void()> work);
  void stop();  // returns when `work` has; may be called twice

  bool stopping() const noexcept { return stopping_.load(std::memory_order_relaxed); }
  int stop_event() const noexcept { return event_; }  // readable once it is to stop

  /// False: it is to stop.
  bool sleep_until_ns(std::int64_t time_ns) const noexcept;

 private:
  int event_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

/// `time_ns` from now on, as ppoll takes it: 0 if past.
timespec wait_until(std::int64_t time_ns) noexcept;

constexpr std::int64_t to_ns(double time_s) noexcept {
  return static_cast<std::int64_t>(time_s * 1e9);
}

}  // namespace plumb::drivers

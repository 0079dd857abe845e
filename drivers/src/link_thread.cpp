// SPDX-License-Identifier: Apache-2.0
#include "link_thread.hpp"

#include <poll.h>
#include <pthread.h>
#include <sched.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <system_error>
#include <utility>

#include "plumb/drivers/time_source.hpp"

namespace plumb::drivers {
namespace {

/// Blocks all signals while it exists. A new thread inherits priority and signal mask of the thread
/// that starts it.
class WithoutSignals {
 public:
  WithoutSignals() {
    sigset_t all;
    sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~WithoutSignals() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  WithoutSignals(const WithoutSignals&) = delete;
  WithoutSignals& operator=(const WithoutSignals&) = delete;

 private:
  sigset_t before_{};
};

void be_ordinary(const char* name) {
  const sched_param ordinary{};
  ::pthread_setschedparam(::pthread_self(), SCHED_OTHER, &ordinary);
  ::pthread_setname_np(::pthread_self(), name);
}

}  // namespace

timespec wait_until(std::int64_t time_ns) noexcept {
  const std::int64_t left = std::max<std::int64_t>(0, time_ns - MonotonicTime::now_ns());
  timespec wait{};
  wait.tv_sec = static_cast<time_t>(left / 1'000'000'000);
  wait.tv_nsec = static_cast<long>(left % 1'000'000'000);
  return wait;
}

LinkThread::LinkThread() : event_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}

LinkThread::~LinkThread() {
  stop();
  if (event_ >= 0) ::close(event_);
}

int LinkThread::start(const char* name, std::function<void()> work) {
  if (event_ < 0) return EMFILE;
  if (thread_.joinable()) return EBUSY;
  stopping_ = false;
  std::uint64_t old = 0;
  [[maybe_unused]] const auto drained = ::read(event_, &old, sizeof old);
  const WithoutSignals blocked;
  try {
    thread_ = std::thread([name, work = std::move(work)] {
      be_ordinary(name);
      work();
    });
  } catch (const std::system_error& error) {
    return error.code().value();
  }
  return 0;
}

void LinkThread::stop() {
  if (!thread_.joinable()) return;
  stopping_ = true;
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = ::write(event_, &one, sizeof one);
  thread_.join();
}

bool LinkThread::sleep_until_ns(std::int64_t time_ns) const noexcept {
  pollfd event{.fd = event_, .events = POLLIN, .revents = 0};
  const timespec wait = wait_until(time_ns);
  ::ppoll(&event, 1, &wait, nullptr);
  return !stopping();
}

}  // namespace plumb::drivers

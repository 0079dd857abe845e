// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/rt_process.hpp"

#include <alloca.h>
#include <fcntl.h>
#include <malloc.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>

namespace plumb::drivers {
namespace {

constexpr std::size_t kPage = 4096;  // the smallest; larger pages are touched several times
constexpr std::size_t kStackLeft = 64 << 10;  // for functions that are called meanwhile

std::int64_t limit_of(auto resource) noexcept {
  rlimit limit{};
  if (::getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return -1;
  return static_cast<std::int64_t>(limit.rlim_cur);
}

RtStep granted_if(RtStep step, bool success, int error) noexcept {
  step.grant = success ? Grant::kGranted : Grant::kDenied;
  step.error = success ? 0 : error;
  return step;
}

RtStep granted_if(const RtStep& step, bool success) noexcept {
  return granted_if(step, success, errno);
}

void touch(volatile char* begin, std::size_t bytes) noexcept {
  for (std::size_t i = 0; i < bytes; i += kPage) begin[i] = 0;
}

RtStep keep_heap(const RtRequest& request) noexcept {
  const RtStep step{.kind = RtStepKind::kHeapKept};
  if (request.heap_bytes == 0) return step;
  const bool kept = ::mallopt(M_TRIM_THRESHOLD, -1) == 1 && ::mallopt(M_MMAP_MAX, 0) == 1;
  return granted_if(step, kept, ENOTSUP);
}

RtStep lock_memory(const RtRequest& request) noexcept {
  const RtStep step{.kind = RtStepKind::kMemoryLocked, .limit = limit_of(RLIMIT_MEMLOCK)};
  if (request.lock == RtRequest::Lock::kNone) return step;
  return granted_if(step, ::mlockall(MCL_CURRENT | MCL_FUTURE) == 0);
}

RtStep touch_heap(const RtRequest& request) noexcept {
  const RtStep step{.kind = RtStepKind::kHeapTouched,
                    .asked = static_cast<std::int64_t>(request.heap_bytes),
                    .limit = limit_of(RLIMIT_DATA)};
  if (request.heap_bytes == 0) return step;
  // NOLINTBEGIN(cppcoreguidelines-no-malloc): the allocator itself is to keep these pages.
  void* const heap = std::malloc(request.heap_bytes);
  if (heap != nullptr) touch(static_cast<char*>(heap), request.heap_bytes);
  std::free(heap);
  // NOLINTEND(cppcoreguidelines-no-malloc)
  return granted_if(step, heap != nullptr, ENOMEM);
}

/// The number of bytes that the calling thread can still use of its stack.
std::size_t stack_left() noexcept {
  pthread_attr_t attributes;
  void* begin = nullptr;
  std::size_t bytes = 0;
  if (::pthread_getattr_np(::pthread_self(), &attributes) != 0) return 0;
  ::pthread_attr_getstack(&attributes, &begin, &bytes);
  ::pthread_attr_destroy(&attributes);
  return static_cast<std::size_t>(static_cast<char*>(__builtin_frame_address(0)) -
                                  static_cast<char*>(begin));
}

[[gnu::noinline]] void touch_below(std::size_t bytes) noexcept {
  touch(static_cast<char*>(alloca(bytes)), bytes);
}

RtStep touch_stack(const RtRequest& request) noexcept {
  const RtStep step{.kind = RtStepKind::kStackTouched,
                    .asked = static_cast<std::int64_t>(request.stack_bytes),
                    .limit = limit_of(RLIMIT_STACK)};
  if (request.stack_bytes == 0) return step;
  const bool fits = request.stack_bytes + kStackLeft <= stack_left();
  if (fits) touch_below(request.stack_bytes);
  return granted_if(step, fits, ENOMEM);
}

RtStep end_slack() noexcept {
  const RtStep step{.kind = RtStepKind::kTimerSlack, .asked = 1};
  return granted_if(step, ::prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL) == 0);
}

RtStep stay(const RtRequest& request) noexcept {
  const RtStep step{.kind = RtStepKind::kAffinity,
                    .asked = static_cast<std::int64_t>(request.processors.size())};
  if (request.processors.empty()) return step;
  cpu_set_t set;
  CPU_ZERO(&set);
  for (const int processor : request.processors) {
    if (processor < 0 || processor >= CPU_SETSIZE) return granted_if(step, false, EINVAL);
    CPU_SET(static_cast<std::size_t>(processor), &set);
  }
  return granted_if(step, ::sched_setaffinity(0, sizeof(set), &set) == 0);
}

/// Limits the wake-up latency of the processor's idle states. The limit holds as long as `file`
/// stays open.
RtStep hold_idle_states(const RtRequest& request, int& file) noexcept {
  const RtStep step{.kind = RtStepKind::kIdleStates, .asked = request.idle_latency_us};
  if (request.idle_latency_us < 0 || request.idle_latency_file == nullptr) return step;
  file = ::open(request.idle_latency_file, O_WRONLY | O_CLOEXEC);
  if (file < 0) return granted_if(step, false);
  const auto* const value = &request.idle_latency_us;
  return granted_if(step, ::write(file, value, sizeof(*value)) == sizeof(*value));
}

RtStep rise(const RtRequest& request) noexcept {
  const RtStep step{
      .kind = RtStepKind::kPriority, .asked = request.priority, .limit = limit_of(RLIMIT_RTPRIO)};
  if (request.priority == 0) return step;
  sched_param parameter{};
  parameter.sched_priority = request.priority;
  return granted_if(step, ::sched_setscheduler(0, SCHED_FIFO, &parameter) == 0);
}

}  // namespace

RtProcess::RtProcess(const RtRequest& request) noexcept
    : steps_{keep_heap(request),
             touch_heap(request),
             touch_stack(request),
             lock_memory(request),
             end_slack(),
             stay(request),
             hold_idle_states(request, idle_states_),
             rise(request)} {}

RtProcess::~RtProcess() {
  if (idle_states_ >= 0) ::close(idle_states_);
}

bool RtProcess::complete() const noexcept {
  return std::none_of(steps_.begin(), steps_.end(),
                      [](const RtStep& step) { return step.grant == Grant::kDenied; });
}

}  // namespace plumb::drivers

// SPDX-License-Identifier: Apache-2.0
// With a CAN link the thread of the real loop allocates nothing, takes no lock and makes no system
// calls but those of the bus and the clock.
#include <gtest/gtest.h>

#include <mutex>
#include <shared_mutex>

#include "plumb/drivers/can_port.hpp"
#include "tests/drivers/linked_loop.hpp"
#include "tests/drivers/socket_pair.hpp"
#include "tests/drivers/watched_locks.hpp"

namespace plumb::tests {
namespace {

/// A bus that does something forbidden whenever a message is asked for.
class Planted final : public BusPort {
 public:
  Planted(BusPort& port, std::function<void()> violation)
      : port_(port), violation_(std::move(violation)) {}

  bool receive(BusMessage& message) noexcept override {
    violation_();
    return port_.receive(message);
  }
  bool send(const BusMessage& message) noexcept override { return port_.send(message); }
  LinkState state() const noexcept override { return port_.state(); }
  PortCounters counters() const noexcept override { return port_.counters(); }

 private:
  BusPort& port_;
  std::function<void()> violation_;
};

Ended run_on_can(CanFrame::Format format, const Watched& how, WatchedCalls*& calls,
                 const std::function<void()>& violation = {}) {
  return run_watched(calls, [&](WatchedCalls& seen) {
    BusLayout layout = default_layout(6, 1e-9 * static_cast<double>(kBeat_ns));
    layout.can_format = format;
    SocketPair sockets;
    CanPort plumb(CanLink(sockets.link_end(), can_link_options(layout)), layout, Sender::kPlumb);
    CanPort controller(CanLink(sockets.release(), can_link_options(layout)), layout,
                       Sender::kController);
    Planted planted(plumb, violation);
    BusPort& used = violation ? static_cast<BusPort&>(planted) : plumb;
    return run_linked_loop(used, controller, how, seen);
  });
}

Watched can_calls() {
  Watched out{.allowed = kClockCalls};
  out.allowed.insert(out.allowed.end(), {SYS_recvmsg, SYS_sendto});
  return out;
}

class LoopOnCan : public testing::TestWithParam<CanFrame::Format> {};
INSTANTIATE_TEST_SUITE_P(Calls, LoopOnCan,
                         testing::Values(CanFrame::Format::kClassic, CanFrame::Format::kFd),
                         [](const auto& one) {
                           return one.param == CanFrame::Format::kFd ? "Fd" : "Classic";
                         });

TEST_P(LoopOnCan, NeverAllocatesLocksOrAsksTheSystemForMoreThanFramesAndTime) {
  WatchedCalls* calls = nullptr;
  const Watched how = can_calls();
  const Ended ended = run_on_can(GetParam(), how, calls);
  if (ended == Ended::kNoFilter) GTEST_SKIP() << kNoFilterHere;
  ASSERT_EQ(ended, Ended::kWell);
  expect_clean(*calls, how);
}

struct Violation {
  const char* name;
  std::function<void()> act;
  enum class Of { kHeap, kLocks, kSystem } of;
};

void* volatile sink = nullptr;
std::mutex mutex;
std::shared_mutex shared_mutex;
pthread_spinlock_t spin;
pthread_cond_t condition = PTHREAD_COND_INITIALIZER;
sem_t semaphore;
std::uint32_t word = 0;

const Violation kViolations[] = {
    {"New", [] { sink = new int(1), std::free(sink); }, Violation::Of::kHeap},
    {"Malloc", [] { sink = std::malloc(8), std::free(sink); }, Violation::Of::kHeap},
    {"Free", [] { std::free(nullptr); }, Violation::Of::kHeap},
    {"Mutex", [] { const std::lock_guard held(mutex); }, Violation::Of::kLocks},
    {"TryLock",
     [] {
       if (mutex.try_lock()) mutex.unlock();
     },
     Violation::Of::kLocks},
    {"SharedMutex", [] { const std::shared_lock held(shared_mutex); }, Violation::Of::kLocks},
    {"Spin",
     [] {
       if (pthread_spin_trylock(&spin) == 0) pthread_spin_unlock(&spin);
     },
     Violation::Of::kLocks},
    {"Condition", [] { pthread_cond_broadcast(&condition); }, Violation::Of::kLocks},
    {"Semaphore", [] { sem_trywait(&semaphore); }, Violation::Of::kLocks},
    {"Futex", [] { syscall(SYS_futex, &word, 1, 1, nullptr, nullptr, 0); }, Violation::Of::kSystem},
    {"Write", [] { std::ignore = ::write(STDERR_FILENO, "", 0); }, Violation::Of::kSystem},
};

class PlantedInTheLoop : public testing::TestWithParam<Violation> {};
INSTANTIATE_TEST_SUITE_P(Calls, PlantedInTheLoop, testing::ValuesIn(kViolations),
                         [](const auto& one) { return std::string(one.param.name); });

TEST_P(PlantedInTheLoop, IsCaught) {
  WatchedCalls* calls = nullptr;
  Watched how = can_calls();
  how.cycles = how.answers = 10;
  const Ended ended = run_on_can(CanFrame::Format::kClassic, how, calls, GetParam().act);
  if (ended == Ended::kNoFilter) GTEST_SKIP() << kNoFilterHere;
  ASSERT_EQ(ended, Ended::kWell);
  using Of = Violation::Of;
  EXPECT_EQ(calls->heap > 0, GetParam().of == Of::kHeap);
  EXPECT_EQ(calls->locks > 0, GetParam().of == Of::kLocks);
  EXPECT_EQ(calls->system_call >= 0, GetParam().of == Of::kSystem) << calls->system_call;
}

}  // namespace
}  // namespace plumb::tests

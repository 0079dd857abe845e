// SPDX-License-Identifier: Apache-2.0
// Two cycles over a CAN bus: the controller sends its targets, joints and all the rest of the
// layout; plumb-rt's side answers each target with a correction of the same counter. Run by
// tests/can_machine/can_rates under virtual time.
//   can_rates INTERFACE fd|classic SECONDS [none|slow]
// fd: poses at 1 kHz; classic: offsets at 500 Hz. The last word plants a violation: a cycle that
// takes longer than its period, once. Exit code 1 when a cycle was missed or a message lost.
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <tuple>

#include "plumb/drivers/can_port.hpp"
#include "plumb/drivers/cycle_clock.hpp"
#include "plumb/drivers/rt_process.hpp"

namespace {

using namespace plumb::drivers;

struct Options {
  std::string interface;
  BusLayout layout;
  std::int64_t period_ns = 0;
  long cycles = 0;
  bool slow = false;
};

/// For printf, whatever the width of long.
unsigned long long wide(std::uint64_t count) { return count; }

/// One end, its clock, and what it saw.
class End {
 public:
  End(const Options& options, Sender self)
      : options_(options),
        self_(self),
        opening_(CanPort::open(options.interface, options.layout, self)) {
    if (opening_.port) return;
    const Finding said = describe(opening_.step);
    std::fprintf(stderr, "error: %s\nhelp: %s\n", said.why.c_str(), said.remedy.c_str());
  }

  bool open() const { return opening_.port.has_value(); }

  /// Cycles from `begin_ns` on.
  void run(std::int64_t begin_ns) {
    std::ignore = MonotonicTime::sleep_until_ns(begin_ns);
    CycleClock<> clock(options_.period_ns);
    for (long i = 0; i < options_.cycles; ++i) {
      std::ignore = clock.wait();
      receive(i);
      send(static_cast<std::uint16_t>(i));
      if (options_.slow && i == options_.cycles / 2)
        ::usleep(3 * static_cast<useconds_t>(options_.period_ns / 1000));
    }
    missed_ = clock.counters().missed;
    std::ignore = MonotonicTime::sleep_until_ns(clock_end(begin_ns));  // what is on its way
    receive(options_.cycles);
  }

  /// Every target or answer came, and no cycle was missed.
  bool verdict() const {
    const PortCounters c = opening_.port->counters();
    std::printf(
        "%s: %ld cycles, %llu missed; %ld of the other's heard, the latest %ld cycles late; "
        "%llu sent, %llu not; %llu skipped, %llu corrupt, %llu overflowed\n",
        self_ == Sender::kPlumb ? "plumb-rt  " : "controller", options_.cycles, wide(missed_),
        heard_, latest_, wide(c.sent), wide(c.not_sent), wide(c.skipped), wide(c.corrupt),
        wide(c.overflowed));
    return missed_ == 0 && heard_ == options_.cycles && c.not_sent == 0 && c.skipped == 0 &&
           c.corrupt == 0 && c.overflowed == 0;
  }

 private:
  std::int64_t clock_end(std::int64_t begin_ns) const {
    return begin_ns + (options_.cycles + 50) * options_.period_ns;
  }

  void receive(long cycle) {
    BusMessage message;
    while (opening_.port->receive(message)) {
      const bool target = message.kind == MessageKind::kTarget;
      const bool answer =
          message.kind == MessageKind::kCorrected || message.kind == MessageKind::kOffset;
      if (!target && !answer) continue;
      latest_ = std::max(latest_, cycle - heard_);
      ++heard_;
      if (target) answer_to(message);
    }
  }

  void answer_to(const BusMessage& target) {
    const bool offset = options_.layout.correction == CorrectionForm::kOffset;
    BusMessage out = target;
    out.kind = offset ? MessageKind::kOffset : MessageKind::kCorrected;
    opening_.port->send(out);
  }

  /// What this end says by itself; answers are not.
  void send(std::uint16_t counter) {
    for (const auto& entry : options_.layout.messages) {
      const auto every = static_cast<long>(1e9 * entry.period_s + 0.5) / options_.period_ns;
      const bool answer =
          entry.kind == MessageKind::kCorrected || entry.kind == MessageKind::kOffset;
      if (entry.sender != self_ || answer || counter % every != 0) continue;
      BusMessage message{.kind = entry.kind,
                         .size = static_cast<std::uint8_t>(entry.signals.size())};
      message.counter = counter;
      message.values.fill(1e-3);
      opening_.port->send(message);
    }
  }

  const Options& options_;
  Sender self_;
  CanPortOpening opening_;
  std::uint64_t missed_ = 0;
  long heard_ = 0;
  long latest_ = 0;  // cycles from a target's counter to when it was heard
};

/// The controller in a process of its own.
pid_t start_controller(const Options& options, std::int64_t begin_ns) {
  std::fflush(stdout);
  const pid_t child = ::fork();
  if (child != 0) return child;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  End end(options, Sender::kController);
  if (!end.open()) ::_exit(5);
  const RtProcess process({.priority = 79});
  end.run(begin_ns);
  const bool good = end.verdict();
  std::fflush(stdout);
  ::_exit(good ? 0 : 1);
}

int measure(const Options& options) {
  std::printf("%s: worst bus load %.0f %%\n", options.interface.c_str(),
              100.0 * worst_bus_load(options.layout));
  const std::int64_t begin_ns = MonotonicTime::now_ns() + 500'000'000;
  Options steady = options;
  steady.slow = false;
  const pid_t child = start_controller(steady, begin_ns);
  End end(options, Sender::kPlumb);
  if (!end.open()) return 5;
  const RtProcess process({.priority = 80});
  if (process.step(RtStepKind::kPriority).grant != Grant::kGranted) return 5;
  end.run(begin_ns + options.period_ns / 2);
  int status = 0;
  ::waitpid(child, &status, 0);
  const bool good = end.verdict();
  if (!WIFEXITED(status)) return 1;
  return good ? WEXITSTATUS(status) : 1;
}

int usage() {
  std::fprintf(stderr, "usage: can_rates INTERFACE fd|classic SECONDS [none|slow]\n");
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) return usage();
  const bool fd = std::string(argv[2]) == "fd";
  Options options;
  options.interface = argv[1];
  options.period_ns = fd ? 1'000'000 : 2'000'000;
  options.layout = default_layout(6, 1e-9 * static_cast<double>(options.period_ns), 0,
                                  fd ? CorrectionForm::kPose : CorrectionForm::kOffset);
  options.layout.can_format = fd ? CanFrame::Format::kFd : CanFrame::Format::kClassic;
  options.cycles = static_cast<long>(std::atoll(argv[3]) * 1'000'000'000 / options.period_ns);
  options.slow = argc > 4 && std::string(argv[4]) == "slow";
  return options.cycles > 0 ? measure(options) : usage();
}

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

#include "plumb/drivers/run_shared.hpp"
#include "plumb/drivers/session.hpp"

namespace plumb::drivers {

struct RunSettings {
  std::int64_t give_up_ns = 0;  // the run ends if the bus is down for so long; 0: never
  enum class Answers : std::uint8_t { kToPort, kRecordOnly } answers = Answers::kToPort;
};

/// The loop of the cycle's thread. In every cycle it waits for the clock, takes the received
/// messages, steps the session, sends its messages and records all of this. Told to stop, it ends
/// when the correction is out, a second after Session::ramp_out_s() at the latest.
///
/// Times, including those of messages, are truncated to whole microseconds, the resolution of the
/// record. A replay of the record therefore gives the same results to the bit.
///
/// Heap, locks: none. System calls: those of the clock and of the port. Thread: one.
template <TimeSource Time = MonotonicTime>
class RunLoop {
 public:
  enum class Next : std::uint8_t { kGoOn, kDone, kBusLost, kClockFailed };

  /// The most messages taken in one cycle; further ones wait for the next cycle.
  static constexpr int kMostMessages = 64;

  RunLoop(Session& session, BusPort& port, RunShared& shared, CycleClock<Time>& clock, Time time,
          const RunSettings& settings) noexcept
      : session_(session),
        port_(port),
        shared_(shared),
        clock_(clock),
        time_(time),
        settings_(settings),
        snapshot_every_(std::max<std::int64_t>(1, kSnapshot_ns / clock.period_ns())) {}

  Next cycle() noexcept {
    const Tick tick = clock_.wait();
    if (tick.error != 0) return Next::kClockFailed;
    const std::int64_t begin_ns = tick.time_ns + tick.latency_ns;
    drain();
    step(begin_ns);
    give_copy(begin_ns);
    work_.add(time_.now_ns() - begin_ns);
    shared_.beats.store(++cycles_, std::memory_order_relaxed);
    if (cycles_ % static_cast<std::uint64_t>(snapshot_every_) == 0) publish(begin_ns);
    return next(tick);
  }

  /// Publishes a snapshot. cycle() does so periodically; to be called once more at the end of a
  /// run, from the same thread.
  void publish(std::int64_t now_ns) noexcept {
    snapshot_.now_ns = now_ns;
    snapshot_.session = session_.report();
    snapshot_.port = port_.counters();
    snapshot_.link = port_.state();
    snapshot_.refusal = port_.refusal();
    snapshot_.packing = port_.packing();
    snapshot_.clock = clock_.counters();
    snapshot_.wake = clock_.latency();
    snapshot_.work = work_;
    snapshot_.model = session_.model();
    shared_.snapshots.put(snapshot_);
  }

 private:
  using What = RecordEntry::What;
  static constexpr std::int64_t kSnapshot_ns = 50'000'000, kMicro_ns = 1'000;
  static constexpr std::int64_t kSlept_ns = 100'000'000;  // an input's limit
  static constexpr std::int64_t kSpare_ns = 1'000'000'000;

  static std::int64_t whole_us(std::int64_t time_ns) noexcept {
    return time_ns - time_ns % kMicro_ns;
  }

  void drain() noexcept {
    BusMessage message;
    for (int i = 0; i < kMostMessages && port_.receive(message); ++i) {
      message.time_ns = whole_us(message.time_ns);
      write_down(What::kReceived, message);
      session_.hear(message);
    }
  }

  void step(std::int64_t now_ns) noexcept {
    using Run = SessionTick::Run;
    using Peer = SessionTick::Peer;
    using Answers = SessionTick::Answers;
    const PortCounters counters = port_.counters();
    const SessionTick tick{
        .now_ns = whole_us(now_ns),
        .foreign_senders = counters.foreign_senders,
        .run = shared_.stop.load(std::memory_order_relaxed) ? Run::kStop : Run::kGoOn,
        .host = host(),
        .peer = counters.restarts == restarts_ ? Peer::kSame : Peer::kRestarted,
        .answers = port_.refusal().any() ? Answers::kRefused : Answers::kTaken};
    restarts_ = counters.restarts;
    const SessionOutput out = session_.step(tick);
    note_stop(tick);
    note_change(tick.now_ns);
    const SessionReport& report = session_.report();
    shared_.record.put({.what = What::kTick,
                        .tick = tick,
                        .model = session_.model(),
                        .state = report.state,
                        .cause = report.cause,
                        .lost = report.lost});
    for (BusMessage message : out.sent()) {
      message.time_ns = tick.now_ns;
      write_down(send(message) ? What::kSent : What::kNotSent, message);
    }
  }

  /// Gives a copy of the session to the record, if it asks for one and its ring has room.
  void give_copy(std::int64_t now_ns) noexcept {
    if (!shared_.copy.asked()) return;
    shared_.copy.put(session_);
    if (shared_.record.put({.what = What::kState,
                            .tick = {.now_ns = whole_us(now_ns)},
                            .model = session_.model(),
                            .cycles = session_.report().counters.cycles}))
      shared_.copy.given();
  }

  /// Whether the machine was suspended since the last cycle. The two clocks are not read at once,
  /// so a thread that loses the processor between them for so long seems suspended, which it is.
  SessionTick::Host host() noexcept {
    using Host = SessionTick::Host;
    if constexpr (requires { time_.suspended_ns(); }) {
      const std::int64_t suspended_ns = time_.suspended_ns();
      const bool slept = cycles_ > 0 && suspended_ns - suspended_ns_ > kSlept_ns;
      suspended_ns_ = suspended_ns;
      return slept ? Host::kSlept : Host::kAwake;
    }
    return Host::kAwake;
  }

  /// A stop waits for the ramp, and for no more: a controller that asks on in a way that is never
  /// answered would hold it up for ever.
  void note_stop(const SessionTick& tick) noexcept {
    stopping_ = tick.run == SessionTick::Run::kStop;
    if (!stopping_ || stop_by_ns_ != 0) return;
    stop_by_ns_ = tick.now_ns + static_cast<std::int64_t>(1e9 * session_.ramp_out_s()) + kSpare_ns;
  }

  /// Passes what an operator wants to know to the journal, if it has changed.
  void note_change(std::int64_t now_ns) noexcept {
    const SessionReport& report = session_.report();
    const SessionMoment now{.time_ns = now_ns,
                            .state = report.state,
                            .cause = report.cause,
                            .mode = report.mode,
                            .status = report.status,
                            .lost = report.lost,
                            .link = port_.state(),
                            .refusal = port_.refusal(),
                            .model = session_.model(),
                            .applied_m = report.applied_m,
                            .difference_m = report.sync.last_m};
    if (now.differs(moment_)) shared_.events.put(now);
    moment_ = now;
  }

  bool send(const BusMessage& message) noexcept {
    return settings_.answers == RunSettings::Answers::kRecordOnly || port_.send(message);
  }

  void write_down(What what, const BusMessage& message) noexcept {
    shared_.record.put({.what = what, .tick = {}, .message = message});
  }

  Next next(const Tick& tick) noexcept {
    if (stopping_ && (session_.at_rest() || tick.time_ns >= stop_by_ns_)) return Next::kDone;
    down_ns_ = port_.state() == LinkState::kDown ? down_ns_ + tick.elapsed_ns : 0;
    const bool given_up = settings_.give_up_ns > 0 && down_ns_ >= settings_.give_up_ns;
    return given_up ? Next::kBusLost : Next::kGoOn;
  }

  Session& session_;
  BusPort& port_;
  RunShared& shared_;
  CycleClock<Time>& clock_;
  Time time_;
  RunSettings settings_;
  std::int64_t snapshot_every_;
  std::uint64_t cycles_ = 0;
  std::int64_t down_ns_ = 0;
  bool stopping_ = false;
  std::int64_t stop_by_ns_ = 0;  // 0: not told to stop
  std::int64_t suspended_ns_ = 0;
  std::uint64_t restarts_ = 0;  // of the controller, as the port counted them a cycle before
  SessionMoment moment_;        // of the cycle before
  LatencyHistogram work_;
  RunSnapshot snapshot_;
};

}  // namespace plumb::drivers

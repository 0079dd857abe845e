// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "rt/status_text.hpp"

namespace plumb::drivers::rt {
namespace {

class Metrics {
 public:
  void counter(const char* name, const char* help, std::uint64_t value) {
    text_ += fmt::format(
        "# HELP plumb_{0}_total {1}\n# TYPE plumb_{0}_total counter\n"
        "plumb_{0}_total {2}\n",
        name, help, value);
  }
  void gauge(const char* name, const char* help, double value) {
    text_ += fmt::format("# HELP plumb_{0} {1}\n# TYPE plumb_{0} gauge\nplumb_{0} {2}\n", name,
                         help, number(value));
  }
  void histogram(const char* name, const char* help, const LatencyHistogram& of) {
    text_ += fmt::format("# HELP plumb_{0} {1}\n# TYPE plumb_{0} summary\n", name, help);
    for (const double share : {0.5, 0.99, 0.999, 1.0})
      text_ += fmt::format("plumb_{}{{quantile=\"{}\"}} {}\n", name, share,
                           1e-9 * static_cast<double>(of.percentile_ns(share)));
    text_ += fmt::format("plumb_{}_count {}\n", name, of.count());
  }
  std::string text() && { return std::move(text_); }

 private:
  static std::string number(double value) {
    if (value != value) return "NaN";
    return value > 1e300 ? "+Inf" : fmt::format("{}", value);
  }
  std::string text_;
};

void add_session(const SessionReport& report, Metrics& out) {
  out.gauge("state", "0 init, 1 sync, 2 shadow, 3 active, 4 hold, 5 fault",
            static_cast<double>(report.state));
  out.gauge("mode", "0 shadow, 1 limited, 2 full", static_cast<double>(report.mode));
  out.gauge("fault_cause", "0 none, 1 pose-mismatch, 2 other-robot, 3 foreign-sender",
            static_cast<double>(report.cause));
  out.gauge("status", "below 0: refused", static_cast<double>(report.status));
  out.gauge("correction_applied_meters", "On the target", report.applied_m);
  out.gauge("correction_wanted_meters", "As the model asks, guarded", report.wanted_m);
  out.gauge("target_age_seconds", "Since the last sound target", report.target_age_s);
  out.gauge("joints_age_seconds", "Since the last joint state", report.joints_age_s);
  out.gauge("pose_difference_meters", "Controller's pose against the nominal arm, last",
            report.sync.last_m);
  out.counter("targets", "Accepted", report.counters.targets);
  out.counter("answered", "Corrected targets or offsets given to the link",
              report.counters.answered);
  out.counter("targets_too_far", "Beyond the limit of step", report.counters.too_far);
  out.counter("targets_too_fast", "Beyond the limit of speed", report.counters.too_fast);
  out.counter("holds", "ACTIVE left for HOLD", report.counters.holds);
  out.counter("faults", "FAULT entered", report.counters.faults);
  out.counter("refused", "Cycles in which the correction was refused", report.guard.refused);
  out.counter("limited", "Cycles in which it was limited", report.guard.limited);
  out.counter("stale", "Cycles without fresh inputs", report.guard.stale);
  out.counter("swaps", "Models swapped", report.guard.swaps);
}

}  // namespace

std::string metrics_text(const RunSnapshot& snapshot, const RunFacts& facts) {
  Metrics out;
  add_session(snapshot.session, out);
  const PortCounters& port = snapshot.port;
  out.gauge("model", "Number of the running model, as on the bus",
            static_cast<double>(snapshot.model));
  out.counter("events_lost", "Changes that the journal had no room for", facts.events_lost);
  out.gauge("link", "0 up, 1 degraded, 2 down", static_cast<double>(snapshot.link));
  out.counter("received", "Messages", port.received);
  out.counter("sent", "Messages", port.sent);
  out.counter("corrupt", "Messages with a wrong check sum, length or value", port.corrupt);
  out.counter("not_sent", "Messages that the link did not take", port.not_sent);
  out.counter("restarts", "Times the controller was seen to have been restarted", port.restarts);
  out.counter("foreign_senders", "Our identifiers, sent by someone else", port.foreign_senders);
  out.counter("cycles", "Ticks of the clock", snapshot.clock.ticks);
  out.counter("cycles_missed", "Points of the grid skipped", snapshot.clock.missed);
  out.counter("record_lost", "Entries that the record had no room for", facts.record_lost);
  out.gauge("record_failed", "1: the disk or record_max_mb ended the record",
            facts.record_failure.empty() ? 0 : 1);
  out.histogram("wake_up_seconds", "How late the cycle began", snapshot.wake);
  out.histogram("cycle_seconds", "How long the cycle took", snapshot.work);
  return std::move(out).text();
}

}  // namespace plumb::drivers::rt

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
  /// One sample for each value of a label.
  void labelled(const char* name, const char* help, const char* label,
                const std::vector<std::pair<std::string, bool>>& values) {
    text_ += fmt::format("# HELP plumb_{0} {1}\n# TYPE plumb_{0} gauge\n", name, help);
    for (const auto& [value, on] : values)
      text_ += fmt::format("plumb_{}{{{}=\"{}\"}} {}\n", name, label, value, on ? 1 : 0);
  }
  void model(const RunFacts& facts, std::uint32_t number) {
    text_ += fmt::format(
        "# HELP plumb_model_info The running model\n# TYPE plumb_model_info gauge\n"
        "plumb_model_info{{name=\"{}\",file=\"{}\",sha256=\"{}\",number=\"{}\"}} 1\n",
        escaped(facts.model_name), escaped(facts.model_file), facts.model_sha256, number);
  }
  void version(const RunOrigin& origin) {
    text_ += fmt::format(
        "# HELP plumb_version_info What was installed, and who signed it\n"
        "# TYPE plumb_version_info gauge\n"
        "plumb_version_info{{place=\"{}\",version=\"{}\",made=\"{}\",signed_by=\"{}\"}} 1\n",
        escaped(origin.place), origin.version, escaped(origin.made), escaped(origin.key));
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
  /// The text as the value of a label, with quotes, backslashes and line ends escaped.
  static std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
      if (c == '\\' || c == '"') out += '\\';
      out += c == '\n' ? "\\n" : std::string(1, c);
    }
    return out;
  }
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
  std::vector<std::pair<std::string, bool>> faults, lost;
  for (int i = 1; i < kFaultCauses; ++i) {
    const auto one = static_cast<FaultCause>(i);
    faults.emplace_back(to_string(one),
                        report.state == SessionState::kFault && report.cause == one);
  }
  for (int i = 0; i < kLostBits; ++i) {
    const auto one = static_cast<Lost>(1U << static_cast<unsigned>(i));
    lost.emplace_back(to_string(one), has(report.lost, one));
  }
  out.labelled("fault", "1: the session is in FAULT for this cause", "cause", faults);
  out.labelled("lost", "1: this input holds the correction now", "input", lost);
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
  out.model(facts, snapshot.model);
  out.version(facts.origin);
  out.gauge("unsigned", "1: no key that this machine trusts has signed what runs",
            facts.origin.key.empty() ? 1 : 0);
  out.gauge("restart_needed", "1: another version is installed than runs",
            facts.origin.restart_needed() ? 1 : 0);
  out.counter("events_lost", "Changes that the journal had no room for", facts.events_lost);
  out.gauge("link", "0 up, 1 degraded, 2 down", static_cast<double>(snapshot.link));
  out.counter("received", "Messages", port.received);
  out.counter("sent", "Messages", port.sent);
  out.counter("corrupt", "Messages with a wrong check sum, length or value", port.corrupt);
  out.counter("not_sent", "Messages that the link did not take", port.not_sent);
  out.counter("restarts", "Times the controller was seen to have been restarted", port.restarts);
  out.counter("foreign_senders", "Our identifiers, sent by someone else", port.foreign_senders);
  out.counter("refused_writes", "Writes that the controller answered with an exception",
              port.refused_writes);
  out.gauge("packing", "1: the controller packs its registers otherwise than the layout says",
            facts.packing.empty() ? 0 : 1);
  out.counter("cycles", "Ticks of the clock", snapshot.clock.ticks);
  out.counter("cycles_missed", "Points of the grid skipped", snapshot.clock.missed);
  const RecordFacts& record = facts.record;
  out.counter("record_lost", "Entries that the record had no room for", record.lost);
  out.gauge("record_failed", "1: the record pauses, because it cannot be written",
            record.failure.empty() ? 0 : 1);
  out.gauge("record_files", "Files of the record", static_cast<double>(record.files));
  out.gauge("record_bytes", "Of all of them", static_cast<double>(record.bytes));
  out.counter("snapshots", "Made of faults and holds", record.snapshots);
  out.gauge("snapshot_failed", "1: the last snapshot could not be written",
            record.snapshot_failure.empty() ? 0 : 1);
  out.gauge("events_failed", "1: the journal cannot be written",
            facts.events_failure.empty() ? 0 : 1);
  out.histogram("wake_up_seconds", "How late the cycle began", snapshot.wake);
  out.histogram("cycle_seconds", "How long the cycle took", snapshot.work);
  return std::move(out).text();
}

}  // namespace plumb::drivers::rt

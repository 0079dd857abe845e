// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "rt/lost_words.hpp"
#include "rt/screen_units.hpp"
#include "rt/status_text.hpp"

namespace plumb::drivers::rt {
namespace {

const char* to_string(LinkState state) {
  switch (state) {
    case LinkState::kUp:
      return "up";
    case LinkState::kDegraded:
      return "degraded";
    case LinkState::kDown:
      return "down";
  }
  return "unknown";
}

Json limits_json(const RunFacts& facts) {
  const auto both = [](double model, double ceiling) {
    return Json{{"model", model}, {"ceiling", ceiling}};
  };
  const format::GuardLimits& m = facts.model_limits;
  const Ceilings& c = facts.ceilings;
  return {{"correction_mm", both(1e3 * m.max_correction_m, 1e3 * c.correction_m)},
          {"rotation_deg", both(m.max_rotation_rad / kDegree, c.rotation_rad / kDegree)},
          {"slew_mm_s", both(1e3 * m.slew_m_per_s, 1e3 * c.slew_m_s)},
          {"slew_deg_s", both(m.slew_rad_per_s / kDegree, c.slew_rad_s / kDegree)},
          {"ramp_s", both(m.ramp_s, c.ramp_s)},
          {"change_mm", 1e3 * c.change_m}};
}

Json ages_json(const SessionReport& report) {
  Json out;
  const auto add = [&out](const char* key, double age_s) {
    put(out, key, 1e3 * age_s, "never heard");
  };
  add("target_ms", report.target_age_s);
  add("joints_ms", report.joints_age_s);
  add("controller_ms", report.controller_age_s);
  add("robot_ms", report.robot_age_s);
  return out;
}

Json sync_json(const SyncCounters& sync) {
  return {{"agreed", sync.agreed},          {"distinct", sync.distinct},
          {"compared", sync.compared},      {"mismatched", sync.mismatched},
          {"last_um", 1e6 * sync.last_m},   {"last_urad", 1e6 * sync.last_rad},
          {"worst_um", 1e6 * sync.worst_m}, {"worst_urad", 1e6 * sync.worst_rad}};
}

Json counters_json(const SessionReport& report) {
  const SessionCounters& c = report.counters;
  const GuardCounters& g = report.guard;
  return {{"cycles", c.cycles},
          {"targets", c.targets},
          {"answered", c.answered},
          {"repeated", c.repeated},
          {"out_of_order", c.out_of_order},
          {"no_pose", c.no_pose},
          {"too_far", c.too_far},
          {"too_fast", c.too_fast},
          {"too_old", c.too_old},
          {"no_joints", c.no_joints},
          {"stalls", c.stalls},
          {"holds", c.holds},
          {"faults", c.faults},
          {"refused", g.refused},
          {"limited", g.limited},
          {"stale", g.stale},
          {"swaps", g.swaps}};
}

Json link_json(const RunSnapshot& snapshot, const RunFacts& facts) {
  const PortCounters& p = snapshot.port;
  return {{"bus", facts.bus},
          {"state", to_string(snapshot.link)},
          {"received", p.received},
          {"sent", p.sent},
          {"corrupt", p.corrupt},
          {"repeated", p.repeated},
          {"skipped", p.skipped},
          {"overflowed", p.overflowed},
          {"not_sent", p.not_sent},
          {"reconnects", p.reconnects},
          {"restarts", p.restarts},
          {"foreign_senders", p.foreign_senders},
          {"refused_writes", p.refused_writes},
          {"refusal", refusal_text(snapshot.refusal)},
          {"packing", facts.packing}};
}

Json record_json(const RecordFacts& record) {
  return {{"file", record.file},
          {"failure", record.failure},
          {"lost", record.lost},
          {"files", record.files},
          {"mb", 1e-6 * static_cast<double>(record.bytes)},
          {"snapshots",
           {{"folder", record.snapshot_folder},
            {"made", record.snapshots},
            {"last", record.snapshot},
            {"failure", record.snapshot_failure}}}};
}

Json histogram_json(const LatencyHistogram& histogram) {
  const auto us = [&](double share) {
    return 1e-3 * static_cast<double>(histogram.percentile_ns(share));
  };
  Json bins = Json::array();
  constexpr std::size_t kOctave = LatencyHistogram::kBinsPerOctave;
  for (std::size_t i = 0; i < LatencyHistogram::kBins; i += kOctave) {
    std::uint64_t count = 0;
    for (std::size_t k = i; k < i + kOctave; ++k) count += histogram.in_bin(k);
    if (count > 0)
      bins.push_back({{"from_us", 1e-3 * static_cast<double>(LatencyHistogram::lower_ns(i))},
                      {"count", count}});
  }
  return {{"median_us", us(0.5)}, {"p99_us", us(0.99)}, {"worst_us", us(1.0)}, {"bins", bins}};
}

}  // namespace

Json status_json(const RunSnapshot& snapshot, const RunFacts& facts) {
  const SessionReport& report = snapshot.session;
  return {
      {"state", drivers::to_string(report.state)},
      {"mode", drivers::to_string(report.mode)},
      {"cause", facts.cause},
      {"fault", drivers::to_string(report.cause)},
      {"status", plumb::to_string(report.status)},
      {"lost", lost_words(report.lost)},
      {"acknowledge", facts.acknowledge},
      {"shortage", facts.shortage},
      {"has_output", report.has_output},
      {"correction",
       {{"wanted_um", 1e6 * report.wanted_m},
        {"wanted_urad", 1e6 * report.wanted_rad},
        {"applied_um", 1e6 * report.applied_m},
        {"applied_urad", 1e6 * report.applied_rad}}},
      {"limits", limits_json(facts)},
      {"ages", ages_json(report)},
      {"sync", sync_json(report.sync)},
      {"counters", counters_json(report)},
      {"link", link_json(snapshot, facts)},
      {"clock",
       {{"ticks", snapshot.clock.ticks},
        {"missed", snapshot.clock.missed},
        {"overruns", snapshot.clock.overruns},
        {"late_wakes", snapshot.clock.late_wakes}}},
      {"wake", histogram_json(snapshot.wake)},
      {"work", histogram_json(snapshot.work)},
      {"model",
       {{"file", facts.model_file},
        {"name", facts.model_name},
        {"sha256", facts.model_sha256},
        {"fingerprint", snapshot.model}}},
      {"install", to_json(facts.origin)},
      {"record", record_json(facts.record)},
      {"events",
       {{"file", facts.events}, {"failure", facts.events_failure}, {"lost", facts.events_lost}}}};
}

}  // namespace plumb::drivers::rt

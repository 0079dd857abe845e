// SPDX-License-Identifier: Apache-2.0
#include "rt/status_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "rt/lost_words.hpp"

namespace plumb::drivers::rt {
namespace {

double number(const Json& json, const char* key) {
  return json.contains(key) && json[key].is_number() ? json[key].get<double>() : 0.0;
}

std::string age(const Json& ages, const char* key) {
  return ages[key].is_number() ? fmt::format("{:.1f} ms", ages[key].get<double>()) : "never";
}

std::string all(const Json& object) {
  std::string out;
  for (const auto& [key, value] : object.items())
    if (value.is_number())
      out += fmt::format("{}{} {}", out.empty() ? "" : ", ", value.dump(), key);
  return out;
}

std::string latency(const Json& histogram) {
  return fmt::format("median {:.1f} us, p99 {:.1f} us, worst {:.1f} us",
                     number(histogram, "median_us"), number(histogram, "p99_us"),
                     number(histogram, "worst_us"));
}

std::string bars(const Json& histogram) {
  double most = 1.0;
  for (const auto& bin : histogram["bins"]) most = std::max(most, number(bin, "count"));
  std::string out;
  for (const auto& bin : histogram["bins"])
    out +=
        fmt::format("  {:>10.1f} us {:>10} {}\n", number(bin, "from_us"), bin["count"].dump(),
                    std::string(static_cast<std::size_t>(40.0 * number(bin, "count") / most), '#'));
  return out;
}

std::string reasons(const Json& status) {
  std::string out;
  for (const auto& one : status["lost"])
    out += (out.empty() ? ", waits for: " : ", ") + one.get<std::string>();
  const std::string cause = status.value("cause", "");
  const bool held = status["state"] == "hold" || status["state"] == "fault";
  return out + (held && !cause.empty() ? ", because of: " + cause : "");
}

/// Where the record and the last snapshot stand, and what is wrong with them; empty: there are
/// none.
std::string record_text(const Json& record) {
  const auto word = [](const Json& of, const char* key) { return of.value(key, ""); };
  std::string out;
  if (!word(record, "file").empty())
    out += fmt::format("record      {}, {} files, {:.1f} MB\n", word(record, "file"),
                       record["files"].dump(), number(record, "mb"));
  if (!word(record, "failure").empty())
    out += fmt::format("record      PAUSED: {}\n", word(record, "failure"));
  const Json& snapshots = record["snapshots"];
  if (!word(snapshots, "last").empty())
    out += fmt::format("snapshot    {}\n", word(snapshots, "last"));
  if (!word(snapshots, "failure").empty())
    out += fmt::format("snapshot    NOT WRITTEN: {}\n", word(snapshots, "failure"));
  return out;
}

/// What an operator is asked to do, and why; empty: nothing.
std::string request_to_operator(const Json& status) {
  const std::string why = status.value("acknowledge", "");
  if (why.empty()) return "";
  const bool fault = status["state"] == "fault";
  return fmt::format("acknowledge {}; hold the button for 0.2 s, then release it: {}\n",
                     fault ? "at the controller, once the cause is gone"
                           : "at the controller in state shadow, before the first correction",
                     why);
}

}  // namespace

std::string cause_text(const SessionMoment& moment) {
  std::string lost = fmt::format("{}", fmt::join(lost_words(moment.lost), ", "));
  const bool shadow = moment.mode == CorrectionMode::kShadow;
  switch (moment.state) {
    case SessionState::kFault:
      return to_string(moment.cause);
    case SessionState::kSync:
      return "compares poses";
    case SessionState::kActive:
      return "";
    case SessionState::kHold:
      return !lost.empty() ? lost : shadow ? "mode shadow" : "told to stop";
    case SessionState::kShadow:
      return !lost.empty() ? lost : shadow ? "mode shadow" : "inputs have come only now";
    case SessionState::kInit:
      break;
  }
  return lost;
}

std::string status_text(const Json& status) {
  const Json& correction = status["correction"];
  std::string out = fmt::format("{}, mode {}, {}{}\n", status["state"].get<std::string>(),
                                status["mode"].get<std::string>(),
                                status["status"].get<std::string>(), reasons(status));
  out += request_to_operator(status);
  if (const std::string lacks = status.value("shortage", ""); !lacks.empty())
    out += fmt::format("shortage    {}\n", lacks);
  out += fmt::format(
      "correction  {:.1f} um, {:.1f} urad on the target; the model asks for {:.1f} um\n",
      number(correction, "applied_um"), number(correction, "applied_urad"),
      number(correction, "wanted_um"));
  const Json& limits = status["limits"];
  out += fmt::format(
      "limits      the model's {:.4g} mm, {:.4g} mm/s, ramp {:.4g} s; rt.toml allows {:.4g} mm, "
      "{:.4g} mm/s, ramp {:.4g} s\n",
      number(limits["correction_mm"], "model"), number(limits["slew_mm_s"], "model"),
      number(limits["ramp_s"], "model"), number(limits["correction_mm"], "ceiling"),
      number(limits["slew_mm_s"], "ceiling"), number(limits["ramp_s"], "ceiling"));
  const Json& ages = status["ages"];
  out += fmt::format("ages        target {}, joints {}, controller {}, robot {}\n",
                     age(ages, "target_ms"), age(ages, "joints_ms"), age(ages, "controller_ms"),
                     age(ages, "robot_ms"));
  const Json& sync = status["sync"];
  out += fmt::format(
      "poses       {} compared and in agreement, {} of them different poses; last {:.1f} um, "
      "worst {:.1f} um\n",
      sync["agreed"].dump(), sync["distinct"].dump(), number(sync, "last_um"),
      number(sync, "worst_um"));
  out += fmt::format("counters    {}\n", all(status["counters"]));
  out += fmt::format("link        {} {}: {}\n", status["link"]["bus"].get<std::string>(),
                     status["link"]["state"].get<std::string>(), all(status["link"]));
  if (const std::string refused = status["link"].value("refusal", ""); !refused.empty())
    out += fmt::format("refused     the controller refuses what is written to {}\n", refused);
  if (const std::string packed = status["link"].value("packing", ""); !packed.empty())
    out += fmt::format("registers   {}\n", packed);
  out += fmt::format("clock       {}\n", all(status["clock"]));
  out += fmt::format("model       {}, {} {}\n", status["model"]["name"].get<std::string>(),
                     status["model"]["file"].get<std::string>(),
                     status["model"]["sha256"].get<std::string>().substr(0, 12));
  out += run_origin_text(status["install"]);
  out += record_text(status["record"]);
  if (const std::string failed = status["events"].value("failure", ""); !failed.empty())
    out += fmt::format("journal     NOT WRITTEN: {}\n", failed);
  out += fmt::format("wake-up     {}\n{}", latency(status["wake"]), bars(status["wake"]));
  out += fmt::format("cycle       {}\n{}", latency(status["work"]), bars(status["work"]));
  return out;
}

}  // namespace plumb::drivers::rt

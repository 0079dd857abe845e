// SPDX-License-Identifier: Apache-2.0
#include "rt/verb_control.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <iostream>
#include <memory>

#include "plumb/drivers/time_source.hpp"
#include "rt/control_path.hpp"
#include "rt/status_text.hpp"
#include "rt/swap_request.hpp"

namespace plumb::drivers::rt {
namespace {

/// Longest wait for an answer. A swap answers at the latest after 5 s of loading and 2 s in which
/// the cycle takes the model (service.cpp).
constexpr int kAnswer_ms = 10'000;

struct ControlOptions {
  std::string dir = ".";
  std::string file;
  double change_mm = 0.0;  // largest change of a correction allowed to this swap; 0: as in rt.toml
  bool once = false;
  double every_s = 0.5;
};

/// The result of a request; a refusal becomes a Failure with the daemon's own words.
Json asked(const std::string& dir, const std::string& request) {
  const std::string answer = ask_control(dir, request + "\n", kAnswer_ms);
  const Json json = Json::parse(answer, nullptr, false);
  if (json.is_object() && json.value("ok", false)) return json["result"];
  if (json.is_object() && json.contains("error"))
    throw Failure(Exit::kInput, {.code = json["error"]["code"].get<std::string>(),
                                 .message = json["error"]["message"].get<std::string>(),
                                 .help = "plumb-rt status " + dir});
  throw Failure(Exit::kEnvironment, {.code = "E-RT-CONTROL",
                                     .message = "the answer of plumb-rt is no answer",
                                     .help = "plumb-rt --version"});
}

void show(const std::string& dir, Outcome& outcome) {
  outcome.result = asked(dir, "status");
  outcome.text = status_text(outcome.result);
}

double rate(const Json& now, const Json& before, const char* group, const char* key, double s) {
  const auto of = [&](const Json& at) { return at[group][key].get<double>(); };
  return s > 0.0 ? (of(now) - of(before)) / s : 0.0;
}

std::string rates(const Json& now, const Json& before, double s) {
  return fmt::format(
      "rates       {:.0f} cycles/s, {:.0f} targets/s, {:.0f} answers/s, {:.0f} "
      "received/s, {:.0f} sent/s\n",
      rate(now, before, "clock", "ticks", s), rate(now, before, "counters", "targets", s),
      rate(now, before, "counters", "answered", s), rate(now, before, "link", "received", s),
      rate(now, before, "link", "sent", s));
}

void watch(const ControlOptions& options, Outcome& outcome) {
  const auto pause_ns = static_cast<std::int64_t>(1e9 * options.every_s);
  Json before = asked(options.dir, "status");
  for (;;) {
    const std::int64_t begin_ns = MonotonicTime::now_ns();
    std::ignore = MonotonicTime::sleep_until_ns(begin_ns + pause_ns);
    const Json now = asked(options.dir, "status");
    const double s = 1e-9 * static_cast<double>(MonotonicTime::now_ns() - begin_ns);
    const std::string text = status_text(now) + rates(now, before, s);
    if (options.once) {
      outcome.result = now;
      outcome.text = text;
      return;
    }
    std::cout << (::isatty(STDOUT_FILENO) == 1 ? "\x1b[H\x1b[2J" : "\n") << text << std::flush;
    before = now;
  }
}

void swap(const ControlOptions& options, Outcome& outcome) {
  const std::string file = std::filesystem::absolute(options.file).string();
  outcome.result =
      asked(options.dir, swap_line({.file = file, .change_m = 1e-3 * options.change_mm}));
  outcome.text = fmt::format("{} runs now; it changes corrections by {:.3f} mm at most\n",
                             options.file, outcome.result["change_mm"].get<double>());
}

}  // namespace

void add_status(Program& program) {
  const auto options = std::make_shared<ControlOptions>();
  VerbOptions verb =
      program.verb({.name = "status",
                    .summary = "How the plumb-rt that runs a folder stands",
                    .examples = "  plumb-rt status /var/lib/plumb/cell4\n"
                                "  plumb-rt status /var/lib/plumb/cell4 --json"},
                   [options](const Globals&, Outcome& outcome) { show(options->dir, outcome); });
  verb.add_option("DIR", options->dir, "The folder that runs").shows_default();
}

void add_swap(Program& program) {
  const auto options = std::make_shared<ControlOptions>();
  VerbOptions verb =
      program.verb({.name = "swap",
                    .summary = "Another model of the same robot, without missing a cycle",
                    .examples = "  plumb-rt swap better.plumb --dir /var/lib/plumb/cell4\n"
                                "  plumb-rt swap better.plumb --json"},
                   [options](const Globals&, Outcome& outcome) { swap(*options, outcome); });
  verb.add_option("FILE", options->file, "The model").required();
  verb.add_option("--dir", options->dir, "The folder that runs").shows_default();
  verb.add_option("--allow-change-mm", options->change_mm,
                  "Let this swap change corrections by as much, beyond max_change_mm of rt.toml")
      .check(number_between(0.001, 50.0));
}

void add_monitor(Program& program) {
  const auto options = std::make_shared<ControlOptions>();
  VerbOptions verb = program.verb(
      {.name = "monitor",
       .summary = "Rates, ages, counters, correction and latency of a run, as they change",
       .examples = "  plumb-rt monitor /var/lib/plumb/cell4          # until interrupted\n"
                   "  plumb-rt monitor /var/lib/plumb/cell4 --once   # for a script"},
      [options](const Globals&, Outcome& outcome) { watch(*options, outcome); });
  verb.add_option("DIR", options->dir, "The folder that runs").shows_default();
  verb.add_flag("--once", options->once, "Once, and end");
  verb.add_option("--every", options->every_s, "Seconds from one look to the next")
      .check(number_between(0.05, 3600.0))
      .shows_default();
}

}  // namespace plumb::drivers::rt

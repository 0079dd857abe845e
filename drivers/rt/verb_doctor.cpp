// SPDX-License-Identifier: Apache-2.0
#include "rt/verb_doctor.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "plumb/drivers/can_interface.hpp"
#include "rt/doctor_report.hpp"
#include "rt/rt_probe.hpp"
#include "rt/signing_rules.hpp"

namespace plumb::drivers::rt {
namespace {

constexpr int kShortest_us = 100, kLongest_us = 1'000'000;

struct DoctorOptions {
  int cycle_us = 4000;
  std::string root = "/";
  std::string etc = kEtc;
  bool strict = false;
};

void refuse_root(const std::string& root, Outcome& outcome) {
  outcome.exit = Exit::kEnvironment;
  outcome.errors = {{.code = "E-ROOT",
                     .message = fmt::format("'{}' holds no folder 'proc'", root),
                     .help = "plumb-rt doctor"}};
}

void look(const DoctorOptions& options, Outcome& outcome) {
  const std::filesystem::path root = options.root;
  std::error_code ignored;
  if (!std::filesystem::is_directory(root / "proc", ignored))
    return refuse_root(options.root, outcome);
  const MachineFiles files(root);
  const bool this_machine = options.root == "/";
  const auto steps = this_machine ? try_rt_process({}) : std::vector<RtStep>{};
  const auto can = this_machine ? read_can_interfaces() : can_interfaces(files);
  Examination seen{.cycle_us = options.cycle_us, .checks = examine(files, steps, can), .can = can};
  const std::filesystem::path etc = this_machine
                                        ? std::filesystem::path(options.etc)
                                        : root / std::filesystem::path(options.etc).relative_path();
  for (Check& check : signing_checks(etc)) seen.checks.push_back(std::move(check));
  outcome.result = to_json(seen);
  outcome.text = to_text(seen);
  if (!options.strict || seen.fit()) return;
  outcome.exit = Exit::kEnvironment;
  outcome.errors = {{.code = "E-UNFIT", .message = verdict(seen), .help = "plumb-rt doctor"}};
}

}  // namespace

void add_doctor(Program& program) {
  const auto options = std::make_shared<DoctorOptions>();
  VerbOptions verb =
      program.verb({.name = "doctor",
                    .summary = "What this machine grants a real-time cycle, and what it denies",
                    .examples = "  plumb-rt doctor                   # every check, and a verdict\n"
                                "  plumb-rt doctor --strict --json   # for a script: exit code 5 "
                                "if not fit"},
                   [options](const Globals&, Outcome& outcome) { look(*options, outcome); });
  verb.add_option("--cycle-us", options->cycle_us, "The cycle to be fit for, in microseconds")
      .check(whole_number_between(kShortest_us, kLongest_us))
      .shows_default();
  verb.add_option("--root", options->root,
                  "Look at the copy of another machine's /proc and /sys in DIR; nothing is tried")
      .type_name("DIR");
  add_etc_option(verb, options->etc);
  verb.add_flag("--strict", options->strict, "Exit code 5 when the machine is not fit");
}

}  // namespace plumb::drivers::rt

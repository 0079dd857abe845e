// SPDX-License-Identifier: Apache-2.0
#include "rt/verb_doctor.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "plumb/drivers/can_interface.hpp"
#include "program/output_files.hpp"
#include "rt/doctor_report.hpp"
#include "rt/firewall.hpp"
#include "rt/machine_settings.hpp"
#include "rt/place.hpp"
#include "rt/processor_variant.hpp"
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
  bool fix = false;
  WriteOptions write = {};
};

void refuse_root(const std::string& root, Outcome& outcome) {
  outcome.exit = Exit::kEnvironment;
  outcome.errors = {{.code = "E-ROOT",
                     .message = fmt::format("'{}' holds no folder 'proc'", root),
                     .help = "plumb-rt doctor"}};
}

FixMode mode_of(const WriteOptions& options) {
  if (options.dry_run) return FixMode::kDryRun;
  return options.force ? FixMode::kForce : FixMode::kWrite;
}

/// Lets the kernel take the rules, which stand last among the files.
void load(const std::vector<MachineSetting>& firewall, Fix& done, Outcome& outcome) {
  auto file = done.files.end() - static_cast<std::ptrdiff_t>(firewall.size());
  for (; file != done.files.end(); ++file) {
    const auto refusal = load_firewall(file->path);
    if (!refusal) {
      file->then = "in force; plumb-rt@NAME loads it at every start";
      continue;
    }
    outcome.exit = Exit::kEnvironment;
    outcome.errors.push_back({.code = "E-FIX-FIREWALL",
                              .message = fmt::format("{} is written and not in force: {}",
                                                     file->path.string(), *refusal),
                              .help = fmt::format("{}; until then plumb-rt@NAME does not start; to "
                                                  "do without the rule: sudo rm {}",
                                                  file->then, file->path.string())});
  }
}

/// Writes the settings, and adds to the outcome what was written and what no file can change.
void fix(const DoctorOptions& options, const MachineFiles& files, const Examination& seen,
         const FirewallRules& found, Outcome& outcome) {
  std::vector<MachineSetting> settings = machine_settings(files);
  const bool loads = options.root == "/";
  // A rule that is there and not loaded keeps the service from starting.
  const bool without = loads && !can_load_firewall();
  const auto firewall = without ? std::vector<MachineSetting>{} : firewall_settings(found.rules);
  settings.insert(settings.end(), firewall.begin(), firewall.end());
  Fix done{.files = write_settings(options.root, settings, mode_of(options.write)),
           .beyond = beyond_settings(files, seen.checks)};
  if (without && !found.rules.empty()) {
    const FirewallInForce now = read_firewall();
    done.beyond.push_back(fmt::format("firewall: {}; {}", now.why_not, now.remedy));
  }
  if (loads && !options.write.dry_run) load(firewall, done, outcome);
  outcome.result["fix"] = to_json(done);
  outcome.text += to_text(done);
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
  if (this_machine) seen.checks.push_back(machine_code_check());
  const std::filesystem::path etc = this_machine
                                        ? std::filesystem::path(options.etc)
                                        : root / std::filesystem::path(options.etc).relative_path();
  for (Check& check : signing_checks(etc)) seen.checks.push_back(std::move(check));
  const FirewallRules found = firewall_rules(root / std::filesystem::path(kStore).relative_path());
  const FirewallInForce now =
      this_machine ? read_firewall()
                   : FirewallInForce{.why_not = "another machine's firewall cannot be asked"};
  for (Check& check : firewall_checks(found, now)) seen.checks.push_back(std::move(check));
  if (this_machine)
    for (Check& check : packing_checks(kStore)) seen.checks.push_back(std::move(check));
  outcome.result = to_json(seen);
  outcome.text = to_text(seen);
  if (options.fix) fix(options, files, seen, found, outcome);
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
                                "  plumb-rt doctor --fix --dry-run   # and the settings that it "
                                "would write"},
                   [options](const Globals&, Outcome& outcome) { look(*options, outcome); });
  verb.add_option("--cycle-us", options->cycle_us, "The cycle to be fit for, in microseconds")
      .check(whole_number_between(kShortest_us, kLongest_us))
      .shows_default();
  verb.add_option("--root", options->root,
                  "Look at the copy of another machine's /proc and /sys in DIR; nothing is tried")
      .type_name("DIR");
  add_etc_option(verb, options->etc);
  verb.add_flag("--strict", options->strict, "Exit code 5 when the machine is not fit");
  verb.add_flag(
      "--fix", options->fix,
      "Write settings for this machine below /etc, and let its firewall keep the buses of "
      "installed places for plumb-rt; with --root below DIR/etc only");
  options->write.add_to(verb);
  for (const char* name : {"--force", "--dry-run"})
    verb.get_option(name).needs(verb.get_option("--fix"));
}

}  // namespace plumb::drivers::rt

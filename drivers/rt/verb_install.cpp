// SPDX-License-Identifier: Apache-2.0
#include "rt/verb_install.hpp"

#include <fmt/format.h>

#include <memory>

#include "program/file.hpp"
#include "program/shell_word.hpp"
#include "rt/installing.hpp"
#include "rt/signing_rules.hpp"

namespace plumb::drivers::rt {
namespace {

constexpr int kMostKept = 1000;

struct InstallOptions {
  std::string dir, to, version;
  std::string etc = kEtc;
  int keep = InstallRequest{}.keep;
  double change_mm = 0.0;
  bool older = false, at_restart = false;
};

ChangeRequest change_of(const InstallOptions& options) {
  return {.place = find_place(options.to, kStore),
          .etc = options.etc,
          .change_m = 1e-3 * options.change_mm,
          .running = options.at_restart ? ChangeRequest::Running::kRestart
                                        : ChangeRequest::Running::kSwap};
}

Json changed_json(const InstallPlace& place, const Changed& changed) {
  return {
      {"place", place.folder.string()},     {"version", changed.line.version},
      {"previous", changed.line.previous},  {"how", changed.nothing ? "nothing" : changed.line.how},
      {"made", changed.line.made},          {"by", changed.line.by},
      {"signed_by", changed.line.key},      {"key_id", changed.line.key_id},
      {"model_number", changed.line.model}, {"change_mm", changed.change_mm},
      {"removed", changed.removed}};
}

std::string effect_text(const InstallPlace& place, const Changed& changed) {
  const std::string name = shell_word(display_name(place.folder));
  if (changed.nothing) return "It was so already; nothing was changed.\n";
  if (changed.line.how == "swapped")
    return fmt::format("It runs now, and changes corrections by {:.3f} mm at most.\n",
                       changed.change_mm);
  if (changed.line.how == "at-restart")
    return fmt::format("What runs runs on as it is. RESTART NEEDED: start plumb-rt of {} again.\n",
                       name);
  return fmt::format("No plumb-rt runs it.\n\nNext:\n  plumb-rt run {} --check\n", name);
}

void report_change(const InstallPlace& place, const Changed& changed, Outcome& outcome) {
  const std::string& key = changed.line.key;
  outcome.result = changed_json(place, changed);
  outcome.text = fmt::format(
      "{} is at version {}{}{}, {}.\n", display_name(place.folder), changed.line.version,
      changed.line.previous.empty() || changed.line.previous == changed.line.version
          ? ""
          : ", before at " + changed.line.previous,
      changed.line.made.empty() ? "" : ", made " + changed.line.made,
      key.empty() ? "signed by no key that this machine trusts" : "signed by " + key);
  outcome.text += effect_text(place, changed);
}

void add_change_options(VerbOptions& verb, InstallOptions& options) {
  verb.add_option("--to", options.to,
                  "The place: a name below /var/lib/plumb, or a folder with a '/'; else the only "
                  "place there")
      .type_name("PLACE");
  verb.add_flag("--at-restart", options.at_restart,
                "Do not swap in what runs, but let the next start take it");
  verb.add_option("--allow-change-mm", options.change_mm,
                  "Let the swap change corrections by as much, beyond max_change_mm of rt.toml")
      .check(number_between(0.001, 50.0));
  add_etc_option(verb, options.etc);
}

}  // namespace

void add_install(Program& program) {
  const auto options = std::make_shared<InstallOptions>();
  VerbOptions verb = program.verb(
      {.name = "install",
       .summary = "Put a deploy folder into a place, verified and whole; what runs swaps to it",
       .examples = "  plumb-rt install deploy --to cell4        # into /var/lib/plumb/cell4\n"
                   "  plumb-rt install deploy --to ./place      # into a folder, to try it"},
      [options](const Globals&, Outcome& outcome) {
        const InstallRequest request{.change = change_of(*options),
                                     .from = options->dir,
                                     .keep = options->keep,
                                     .older = options->older ? InstallRequest::Older::kAllowed
                                                             : InstallRequest::Older::kRefused};
        report_change(request.change.place, install(request, outcome), outcome);
      });
  verb.add_option("DIR", options->dir, "The folder that 'plumb deploy' wrote").required();
  add_change_options(verb, *options);
  verb.add_flag("--older", options->older,
                "Install although one that was made later was installed before");
  verb.add_option("--keep", options->keep, "Versions that stay, the newest")
      .check(whole_number_between(2, kMostKept))
      .shows_default();
}

void add_rollback(Program& program) {
  const auto options = std::make_shared<InstallOptions>();
  VerbOptions verb = program.verb(
      {.name = "rollback",
       .summary = "Back to the version of a place before the present one, or to a named one",
       .examples = "  plumb-rt rollback --to cell4\n"
                   "  plumb-rt rollback --to cell4 --version 0123456789abcdef  # of plumb-rt list"},
      [options](const Globals&, Outcome& outcome) {
        const ChangeRequest request = change_of(*options);
        report_change(request.place, roll_back(request, options->version, outcome), outcome);
      });
  verb.add_option("--version", options->version, "The version, as plumb-rt list shows it")
      .type_name("ID");
  add_change_options(verb, *options);
}

}  // namespace plumb::drivers::rt

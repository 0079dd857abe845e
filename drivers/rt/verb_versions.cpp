// SPDX-License-Identifier: Apache-2.0
#include "rt/verb_versions.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <system_error>
#include <tuple>

#include "program/file.hpp"
#include "program/folder_lock.hpp"
#include "program/shell_word.hpp"
#include "rt/install_history.hpp"
#include "rt/running_place.hpp"
#include "rt/signing_rules.hpp"
#include "rt/version_store.hpp"

namespace plumb::drivers::rt {
namespace {

struct VersionOptions {
  std::string to;
  std::string etc = kEtc;
};

/// The place that was named, which must be one.
InstallPlace named_place(const VersionOptions& options) {
  InstallPlace out = find_place(options.to, kStore);
  std::error_code error;
  std::ignore = std::filesystem::status(out.folder, error);
  if (error == std::errc::permission_denied)
    throw Failure(
        Exit::kEnvironment,
        {.code = "E-RT-PLACE",
         .message = fmt::format("{} may not be opened by this user", display_name(out.folder)),
         .help = "as root, or as a member of its group: adduser NAME plumb"});
  if (!is_place(out.folder))
    throw Failure(Exit::kInput,
                  {.code = "E-RT-PLACE",
                   .message = fmt::format("{} is no place: nothing was installed there",
                                          display_name(out.folder)),
                   .help = "plumb-rt install DIR --to " +
                           shell_word(std::filesystem::absolute(out.folder).string())});
  return out;
}

/// The version that runs; empty if none does, or if that cannot be asked.
std::string running_version(const InstallPlace& place) {
  try {
    const auto running = find_running(place);
    return running ? running->version : "";
  } catch (const Failure&) {
    return "";
  }
}

Json version_json(const std::string& id, const HistoryLine* line, const std::string& current,
                  const std::string& running) {
  const auto of = [&](auto member) { return line == nullptr ? "" : line->*member; };
  return {{"version", id},
          {"current", id == current},
          {"running", id == running},
          {"installed_at", of(&HistoryLine::time)},
          {"installed_by", of(&HistoryLine::by)},
          {"host", of(&HistoryLine::host)},
          {"made", of(&HistoryLine::made)},
          {"signed_by", of(&HistoryLine::key)},
          {"key_id", of(&HistoryLine::key_id)}};
}

/// A time without the parts of a second, which nobody reads in a table.
std::string to_the_second(const std::string& time) {
  return time.size() > 20 ? time.substr(0, 19) + "Z" : time;
}

std::string version_table(const Json& versions) {
  const auto row = [](const char* mark, const std::string& version, const std::string& made,
                      const std::string& at, const std::string& by, const std::string& signer,
                      const char* runs) {
    const auto or_dash = [](const std::string& text) { return text.empty() ? "-" : text; };
    return fmt::format("{} {:<16}  {:<20}  {:<20}  {:<12}  {}{}\n", mark, version, or_dash(made),
                       or_dash(at), or_dash(by), or_dash(signer), runs);
  };
  std::string out = row(" ", "version", "made", "installed", "by", "signed by", "");
  for (const Json& one : versions) {
    const auto word = [&](const char* key) { return one[key].get<std::string>(); };
    out += row(one["current"].get<bool>() ? "*" : " ", word("version"), word("made"),
               to_the_second(word("installed_at")), word("installed_by"), word("signed_by"),
               one["running"].get<bool>() ? "; runs" : "");
  }
  return out;
}

void list_versions(const VersionOptions& options, Outcome& outcome) {
  const InstallPlace place = named_place(options);
  const std::string current = current_version_if_any(place);
  const std::string running = running_version(place);
  const History history = read_history(place, current);
  std::vector<std::string> ids = place.ids();
  const auto when = [&](const std::string& id) {
    const HistoryLine* const line = history.last_of(id);
    return line == nullptr ? std::string() : line->time;
  };
  std::stable_sort(ids.begin(), ids.end(),
                   [&](const std::string& a, const std::string& b) { return when(a) > when(b); });
  Json versions = Json::array(), lines = Json::array();
  for (const std::string& id : ids)
    versions.push_back(version_json(id, history.last_of(id), current, running));
  for (const HistoryLine& line : history.lines) lines.push_back(to_json(line));
  outcome.result = {{"place", place.folder.string()}, {"current", current},
                    {"previous", history.previous()}, {"running", running},
                    {"versions", versions},           {"history", lines}};
  outcome.text = fmt::format("{} has {} versions, the newest first; * is current:\n",
                             display_name(place.folder), ids.size());
  outcome.text += version_table(versions);
  if (!running.empty() && running != current)
    outcome.text += "RESTART NEEDED: another version runs than is current.\n";
}

/// Others than the owner may not write to what was verified.
void refuse_open_version(const std::filesystem::path& folder) {
  struct stat found {};
  if (::lstat(folder.c_str(), &found) != 0 || (found.st_mode & (S_IWGRP | S_IWOTH)) == 0) return;
  throw Failure(Exit::kInput, {.code = "E-RT-PLACE",
                               .message = fmt::format("{} may be written by others than its owner",
                                                      display_name(folder)),
                               .help = "chmod go-w " + shell_word(display_name(folder))});
}

void verify_version(const InstallPlace& place, const std::string& id, const SigningRules& rules) {
  const auto folder = place.version(id);
  refuse_open_version(folder);
  const Deployment found = load_version(folder, rules);
  if (version_of(found.sums) != id)
    throw Failure(Exit::kInput,
                  {.code = "E-RT-PLACE",
                   .message = fmt::format("{} holds version {} under another name",
                                          display_name(folder), version_of(found.sums)),
                   .help = "install the deploy folder again"});
}

void verify_place(const VersionOptions& options, Outcome& outcome) {
  const InstallPlace place = named_place(options);
  const SigningRules rules = read_signing_rules(options.etc);
  outcome.remark(key_warnings(rules));
  const auto try_to = [&](auto check) {
    try {
      check();
      return true;
    } catch (const Failure& failure) {
      outcome.errors.push_back(failure.problems().front());
      return false;
    }
  };
  FolderLock quiet(place.versions());  // so that no install removes what is being read
  quiet.wait(std::chrono::seconds(5));
  try_to([&] { refuse_open_place(place); });
  std::string current;
  try_to([&] { current = current_version(place).value_or(""); });
  Json versions = Json::array();
  const auto ids = place.ids();
  for (const std::string& id : ids)
    versions.push_back({{"version", id},
                        {"current", id == current},
                        {"sound", try_to([&] { verify_version(place, id, rules); })}});
  const History history = read_history(place, current);
  outcome.result = {{"place", place.folder.string()},
                    {"current", current},
                    {"sound", outcome.errors.empty()},
                    {"versions", versions},
                    {"damaged", history.damaged}};
  outcome.text = fmt::format("{}: {} versions, current {}: {}\n", display_name(place.folder),
                             ids.size(), current.empty() ? "none" : current,
                             outcome.errors.empty() ? "sound" : "NOT SOUND");
  if (!outcome.errors.empty()) outcome.exit = Exit::kInput;
}

void add_place_options(VerbOptions& verb, VersionOptions& options) {
  verb.add_option("--to", options.to,
                  "The place: a name below /var/lib/plumb, or a folder with a '/'; else the only "
                  "place there")
      .type_name("PLACE");
}

}  // namespace

void add_list(Program& program) {
  const auto options = std::make_shared<VersionOptions>();
  VerbOptions verb = program.verb(
      {.name = "list",
       .summary =
           "The versions of a place: which is current, who installed and signed it, and when",
       .examples = "  plumb-rt list --to cell4\n  plumb-rt list --to cell4 --json"},
      [options](const Globals&, Outcome& outcome) { list_versions(*options, outcome); });
  add_place_options(verb, *options);
}

void add_verify(Program& program) {
  const auto options = std::make_shared<VersionOptions>();
  VerbOptions verb = program.verb(
      {.name = "verify",
       .summary = "Is all that is installed in a place whole, signed and as it was installed?",
       .examples = "  plumb-rt verify --to cell4\n  plumb-rt verify --to ./place --json"},
      [options](const Globals&, Outcome& outcome) { verify_place(*options, outcome); });
  add_place_options(verb, *options);
  add_etc_option(verb, options->etc);
}

}  // namespace plumb::drivers::rt

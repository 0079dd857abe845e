// SPDX-License-Identifier: Apache-2.0
#include "rt/installing.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "program/file.hpp"
#include "program/interrupt.hpp"
#include "program/shell_word.hpp"
#include "rt/install_checks.hpp"
#include "rt/version_store.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;

std::string to_place(const InstallPlace& place) {
  return "--to " + shell_word(fs::absolute(place.folder).lexically_normal().string());
}

/// A `current` that is broken does not keep from installing: the next one mends it.
PlaceBefore look_at(const InstallPlace& place, Outcome& outcome) {
  PlaceBefore out;
  try {
    out.current = current_version(place).value_or("");
  } catch (const Failure& failure) {
    Problem problem = failure.problems().front();
    problem.severity = Severity::kWarning;
    outcome.remarks.push_back(std::move(problem));
  }
  out.history = read_history(place, out.current);
  if (out.history.cut_off.empty()) return out;
  HistoryLine line = history_line("refused", out.history.cut_off, out.current);
  line.how = "it was cut off before it took effect";
  append_history(place, line);
  return out;
}

HistoryLine line_for(const char* what, const std::string& id, const Deployment& deployment,
                     const PlaceBefore& before) {
  HistoryLine out = history_line(what, id, before.current);
  out.key = deployment.model.origin.key;
  out.key_id = deployment.model.origin.key_id;
  out.made = deployment.config.made;
  out.model = deployment.model.loaded->number();
  return out;
}

void say_origin(const Origin& origin, const SigningRules& rules, const fs::path& folder,
                Outcome& outcome) {
  outcome.remark(key_warnings(rules));
  if (origin.note.empty() || !rules.demanded()) return;
  outcome.remarks.push_back({.severity = Severity::kWarning,
                             .code = "W-RT-UNSIGNED",
                             .message = fmt::format("{} is {}", display_name(folder), origin.note),
                             .help = "plumb deploy --sign FILE.key"});
}

}  // namespace

Changed install(const InstallRequest& request, Outcome& outcome) {
  const InstallPlace& place = request.change.place;
  if (is_place(request.from))
    throw Failure(
        Exit::kInput,
        {.code = "E-RT-PLACE",
         .message = fmt::format("{} is a place itself, not a folder that plumb deploy "
                                "wrote",
                                display_name(request.from)),
         .help = "of what is installed there: plumb-rt list " + to_place({request.from})});
  std::error_code ignored;
  if (fs::exists(place.folder / "rt.toml", ignored))
    throw Failure(Exit::kInput,
                  {.code = "E-RT-PLACE",
                   .message = fmt::format("{} is a deploy folder, in which nothing is installed",
                                          display_name(place.folder)),
                   .help = "name another folder: --to " + std::string(kStore) + "/NAME"});
  const SigningRules rules = read_signing_rules(request.change.etc);
  const Deployment source = load_deployment(request.from, Sums::kVerified, &rules);
  check_content(request.from, source.sums, Beside::kRunFiles, written_files(source.config));
  const Writing writing;
  const VersionStore store(place, VersionStore::Make::kYes);
  const PlaceBefore before = look_at(place, outcome);
  const fs::path copy = store.copy(request.from, source.sums);
  const Deployment copied = load_version(copy, rules);
  const std::string id = version_of(copied.sums);
  refuse_other_robot(request, copied, before);
  refuse_older(request, copied.config.made, id, before);
  warn_of_clock(request, copied.config.made, outcome);
  say_origin(copied.model.origin, rules, request.from, outcome);
  HistoryLine line = line_for("install", id, copied, before);
  line.from = fs::absolute(request.from).lexically_normal().string();
  const auto added = store.add(copy, id);
  try {
    VersionChange change(request.change, before, std::move(line));
    Changed out = change.make();
    const History history = read_history(place, id);
    out.removed = store.keep_newest(request.keep, history,
                                    {id, history.previous(), before.current, change.running()});
    return out;
  } catch (...) {
    if (added == VersionStore::Added::kNew && current_version_if_any(place) != id)
      std::ignore = store.remove(id);
    throw;
  }
}

Changed roll_back(const ChangeRequest& request, const std::string& version, Outcome& outcome) {
  const InstallPlace& place = request.place;
  const SigningRules rules = read_signing_rules(request.etc);
  const Writing writing;
  const VersionStore store(place, VersionStore::Make::kNo);
  const PlaceBefore before = look_at(place, outcome);
  const auto ids = place.ids();
  const auto is_there = [&](const std::string& id) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
  };
  std::string target = version;
  if (target.empty()) {
    const auto& path = before.history.path;
    for (std::size_t i = path.size(); i-- > 0 && target.empty();)
      if (i + 1 < path.size() && is_there(path[i])) target = path[i];
  }
  if (target.empty() || !is_there(target))
    throw Failure(
        Exit::kInput,
        {.code = "E-RT-ROLLBACK",
         .message = target.empty()
                        ? fmt::format("{} has no version before the current one",
                                      display_name(place.folder))
                        : fmt::format("{} has no version {}", display_name(place.folder), target),
         .help = "what there is: plumb-rt list " + to_place(place)});
  const Deployment found = load_version(place.version(target), rules);
  say_origin(found.model.origin, rules, place.version(target), outcome);
  VersionChange change(request, before, line_for("rollback", target, found, before));
  return change.make();
}

}  // namespace plumb::drivers::rt

// SPDX-License-Identifier: Apache-2.0
#include "rt/installing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "program/file.hpp"
#include "program/interrupt.hpp"
#include "program/shell_word.hpp"
#include "rt/restart_reasons.hpp"
#include "rt/running_place.hpp"
#include "rt/utc.hpp"
#include "rt/version_store.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kClockSlack_s = 86'400;
constexpr std::size_t kMostReasons = 6;

std::string to_place(const Place& place) {
  return "--to " + shell_word(fs::absolute(place.folder).lexically_normal().string());
}

/// What is known of a place before it is changed.
struct Before {
  std::string current;
  History history;
};

/// A `current` that is broken does not keep from installing: the next one mends it.
Before look_at(const Place& place, Outcome& outcome) {
  Before out;
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

/// Words on a clock that was wrong, if these times look like it.
std::string clock_hint(const std::string& made, const std::string& newest) {
  const std::int64_t now_s = utc_ns() / 1'000'000'000;
  const std::string tomorrow = utc_second(now_s + kClockSlack_s);
  if (newest > tomorrow)
    return fmt::format(
        "; this machine's clock says {}, so a clock was wrong when {} was made, or "
        "is wrong here",
        utc_second(now_s), newest);
  if (made < "2020")
    return "; the clock of the machine that made it was wrong, or is older than this program";
  return "";
}

/// An older folder is installed only on purpose.
void refuse_older(const InstallRequest& request, const std::string& made, const std::string& id,
                  const Before& before) {
  const std::string& newest = before.history.newest_made;
  if (request.older == InstallRequest::Older::kAllowed || id == before.current || made >= newest)
    return;
  const Place& place = request.change.place;
  const auto ids = place.ids();
  const bool there = std::find(ids.begin(), ids.end(), id) != ids.end();
  const std::string when =
      made.empty() ? "does not say when it was made, which counts as older than all that do"
                   : fmt::format("was made {}", made);
  throw Failure(
      Exit::kInput,
      {.code = "E-RT-OLDER",
       .message = fmt::format("{} {}, and one made {} was installed in {} before{}",
                              display_name(request.from), when, newest, display_name(place.folder),
                              made.empty() ? "" : clock_hint(made, newest)),
       .help = there ? fmt::format("to go back on purpose: plumb-rt rollback {} --version {}",
                                   to_place(place), id)
                     : "if an older one is meant: add --older"});
}

/// A place belongs to one robot: the wrong folder in the wrong place is refused, running or not.
void refuse_other_robot(const InstallRequest& request, const Deployment& next,
                        const Before& before) {
  const Place& place = request.change.place;
  if (before.current.empty()) return;
  std::string serial;
  try {
    serial = load_deployment(place.version(before.current)).model.loaded->model().serial;
  } catch (const Failure&) {
    return;  // the install mends what is there
  }
  const std::string& own = next.model.loaded->model().serial;
  if (own == serial) return;
  throw Failure(
      Exit::kInput,
      {.code = "E-RT-SERIAL",
       .message = fmt::format("{} was made for robot '{}', and {} is that of robot '{}'",
                              display_name(request.from), own, display_name(place.folder), serial),
       .help = "a place for each robot: --to ANOTHER"});
}

void warn_of_clock(const InstallRequest& request, const std::string& made, Outcome& outcome) {
  const std::int64_t now_s = utc_ns() / 1'000'000'000;
  if (made <= utc_second(now_s + kClockSlack_s)) return;
  outcome.remarks.push_back(
      {.severity = Severity::kWarning,
       .code = "W-RT-CLOCK",
       .message = fmt::format("{} was made {}, and this machine's clock says {}: one of the two "
                              "clocks is wrong, and what is made until then counts as older",
                              display_name(request.from), made, utc_second(now_s)),
       .help = "timedatectl, on both machines"});
}

[[noreturn]] void refuse_restart(const ChangeRequest& request, const std::string& version,
                                 std::vector<std::string> reasons) {
  std::string more;
  if (reasons.size() > kMostReasons) {
    more = fmt::format(" and {} more", reasons.size() - kMostReasons);
    reasons.resize(kMostReasons);
  }
  throw Failure(
      Exit::kInput,
      {.code = "E-RT-RESTART",
       .message = fmt::format("version {} differs from what runs in more than the model, and takes "
                              "effect only when plumb-rt is started again: {}{}",
                              version, fmt::join(reasons, ", "), more),
       .help = fmt::format("add --at-restart, then start {} again",
                           display_name(request.place.folder))});
}

/// The change of one place from one current version to another.
class Change {
 public:
  Change(const ChangeRequest& request, const Before& before, HistoryLine line)
      : request_(request), before_(before), line_(std::move(line)) {
    const bool locked = FolderLock(request.place.folder).state() == FolderLock::State::kBusy;
    if (request.running == ChangeRequest::Running::kSwap) running_ = find_running(request.place);
    runs_ = locked || running_.has_value();
  }

  Changed make() {
    const std::string& id = line_.version;
    const bool same = id == before_.current;
    const bool swaps = running_.has_value() && running_->version != id;
    Changed out{.line = line_, .nothing = same && !swaps, .removed = {}};
    out.line.how = !runs_ ? "stopped" : running_ ? "swapped" : "at-restart";
    if (out.nothing) return out;
    if (swaps) refuse_if_restart();
    std::optional<CurrentLink> link;
    if (!same) {
      link.emplace(CurrentLink::prepare(request_.place, id));
      append_history(request_.place, out.line);
    }
    try {
      if (swaps) out.change_mm = ask_swap(request_.place, swap_to(id, request_.change_m));
      if (link) commit(*link, swaps);
    } catch (const Failure& failure) {
      if (link) take_back(failure.what());
      throw;
    }
    return out;
  }

  /// The version that runs, if that is known.
  std::string running() const { return running_ ? running_->version : ""; }

 private:
  SwapRequest swap_to(const std::string& id, double change_m) const {
    return {.file = fs::absolute(model_of(id)).lexically_normal().string(), .change_m = change_m};
  }
  fs::path model_of(const std::string& id) const {
    return load_deployment(request_.place.version(id)).config.model;
  }
  void refuse_if_restart() const {
    if (running_->version.empty())
      refuse_restart(request_, line_.version, {"a model that is no version was swapped in"});
    const auto reasons = restart_reasons(request_.place.version(running_->version),
                                         request_.place.version(line_.version));
    if (!reasons.empty()) refuse_restart(request_, line_.version, reasons);
  }
  /// If the link cannot be renamed the model that ran before comes back.
  void commit(CurrentLink& link, bool swapped) const {
    try {
      link.commit();
    } catch (const Failure&) {
      constexpr double kAny_m = 1.0;
      if (swapped) std::ignore = ask_swap(request_.place, swap_to(running_->version, kAny_m));
      throw;
    }
  }
  /// Best effort: a history whose last line did not become current says the same by itself.
  void take_back(const std::string& why) const noexcept {
    try {
      HistoryLine line = history_line("refused", line_.version, before_.current);
      line.how = why;
      append_history(request_.place, line);
    } catch (...) {
    }
  }

  const ChangeRequest& request_;
  const Before& before_;
  HistoryLine line_;
  std::optional<RunningPlace> running_;
  bool runs_ = false;
};

HistoryLine line_for(const char* what, const std::string& id, const Deployment& deployment,
                     const Before& before) {
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
  const Place& place = request.change.place;
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
  const Before before = look_at(place, outcome);
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
    Change change(request.change, before, std::move(line));
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
  const Place& place = request.place;
  const SigningRules rules = read_signing_rules(request.etc);
  const Writing writing;
  const VersionStore store(place, VersionStore::Make::kNo);
  const Before before = look_at(place, outcome);
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
  return Change(request, before, line_for("rollback", target, found, before)).make();
}

}  // namespace plumb::drivers::rt

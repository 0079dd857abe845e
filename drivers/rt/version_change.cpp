// SPDX-License-Identifier: Apache-2.0
#include "rt/version_change.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "program/file.hpp"
#include "program/folder_lock.hpp"
#include "rt/deployment.hpp"
#include "rt/restart_reasons.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostReasons = 6;  // named in one message

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

}  // namespace

VersionChange::VersionChange(const ChangeRequest& request, const PlaceBefore& before,
                             HistoryLine line)
    : request_(request), before_(before), line_(std::move(line)) {
  const bool locked = FolderLock(request.place.folder).state() == FolderLock::State::kBusy;
  if (request.running == ChangeRequest::Running::kSwap) running_ = find_running(request.place);
  runs_ = locked || running_.has_value();
}

Changed VersionChange::make() {
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

SwapRequest VersionChange::swap_to(const std::string& id, double change_m) const {
  const fs::path model = load_deployment(request_.place.version(id)).config.model;
  return {.file = fs::absolute(model).lexically_normal().string(), .change_m = change_m};
}

void VersionChange::refuse_if_restart() const {
  if (running_->version.empty())
    refuse_restart(request_, line_.version, {"a model that is no version was swapped in"});
  const auto reasons = restart_reasons(request_.place.version(running_->version),
                                       request_.place.version(line_.version));
  if (!reasons.empty()) refuse_restart(request_, line_.version, reasons);
}

/// If the link cannot be renamed the model that ran before comes back.
void VersionChange::commit(CurrentLink& link, bool swapped) const {
  try {
    link.commit();
  } catch (const Failure&) {
    constexpr double kAny_m = 1.0;  // allows any change: the model ran a moment ago
    if (swapped) std::ignore = ask_swap(request_.place, swap_to(running_->version, kAny_m));
    throw;
  }
}

/// Best effort: a history whose last line did not become current says the same by itself.
void VersionChange::take_back(const std::string& why) const noexcept {
  try {
    HistoryLine line = history_line("refused", line_.version, before_.current);
    line.how = why;
    append_history(request_.place, line);
  } catch (...) {
  }
}

}  // namespace plumb::drivers::rt

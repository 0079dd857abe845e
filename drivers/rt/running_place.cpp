// SPDX-License-Identifier: Apache-2.0
#include "rt/running_place.hpp"

#include <fmt/format.h>

#include <chrono>
#include <thread>

#include "program/file.hpp"
#include "program/folder_lock.hpp"
#include "program/json.hpp"
#include "program/shell_word.hpp"
#include "rt/control_path.hpp"

namespace plumb::drivers::rt {
namespace {

/// Longest waits for the answer to a status and to a swap; the latter as in verb_control.cpp.
constexpr int kStatus_ms = 2000, kSwapAnswer_ms = 10'000;
constexpr int kAttempts = 3;  // to get a status, see find_running
constexpr std::chrono::milliseconds kBetweenAttempts{300};

/// The object that a plumb-rt answers; nothing if none hears it.
std::optional<Json> answer_of(const InstallPlace& place, const std::string& request,
                              int within_ms) {
  for (const auto& path : control_paths(place.folder))
    if (const auto answer = ask(path, request + "\n", within_ms)) {
      Json json = Json::parse(*answer, nullptr, false);
      if (json.is_object()) return json;
    }
  return std::nullopt;
}

/// What stands under a key; null if there is no such key, or `json` is no object.
Json member_of(const Json& json, const char* key) {
  return json.is_object() && json.contains(key) ? json[key] : Json();
}

std::string text_or(const Json& json, const std::string& absent) {
  return json.is_string() ? json.get<std::string>() : absent;
}

bool is_text_or_absent(const Json& json) { return json.is_string() || json.is_null(); }

[[noreturn]] void refuse_silence(const InstallPlace& place) {
  throw Failure(
      Exit::kEnvironment,
      {.code = "E-RT-CONTROL",
       .message = fmt::format("a plumb-rt runs {}, and does not answer to this user",
                              display_name(place.folder)),
       .help = "as root or as the user who runs it; or --at-restart, and start it again"});
}

}  // namespace

/// A plumb-rt holds the lock of its place for as long as it lives, also while it is stopped. One
/// that starts, or whose machine is busy, answers a little later.
std::optional<RunningPlace> find_running(const InstallPlace& place) {
  std::optional<Json> json;
  for (int attempt = 0; !json && attempt < kAttempts; ++attempt) {
    if (attempt > 0) std::this_thread::sleep_for(kBetweenAttempts);
    if (FolderLock(place.folder).state() != FolderLock::State::kBusy) return std::nullopt;
    json = answer_of(place, "status", kStatus_ms);
  }
  if (!json || member_of(*json, "ok") != true) refuse_silence(place);
  const Json result = member_of(*json, "result");
  const Json install = member_of(result, "install"), link = member_of(result, "link");
  const Json version = member_of(install, "version"), packing = member_of(link, "packing");
  const bool sound = result.is_object() && (install.is_object() || install.is_null()) &&
                     (link.is_object() || link.is_null()) && is_text_or_absent(version) &&
                     is_text_or_absent(packing);
  if (!sound) refuse_silence(place);
  return RunningPlace{.version = text_or(version, ""), .packing = text_or(packing, "")};
}

double ask_swap(const InstallPlace& place, const SwapRequest& request) {
  const auto json = answer_of(place, swap_line(request), kSwapAnswer_ms);
  if (!json) refuse_silence(place);
  if (member_of(*json, "ok") == true) {
    const Json change_mm = member_of(member_of(*json, "result"), "change_mm");
    return change_mm.is_number() ? change_mm.get<double>() : 0.0;
  }
  const Json error = member_of(*json, "error");
  throw Failure(
      Exit::kInput,
      {.code = text_or(member_of(error, "code"), "E-RT-SWAP"),
       .message = text_or(member_of(error, "message"), "the running plumb-rt refuses it"),
       .help = "nothing was changed; plumb-rt status " + shell_word(display_name(place.folder))});
}

}  // namespace plumb::drivers::rt

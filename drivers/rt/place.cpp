// SPDX-License-Identifier: Apache-2.0
#include "rt/place.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <cstring>

#include "program/file.hpp"
#include "program/problem.hpp"
#include "program/shell_word.hpp"
#include "rt/synced_files.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kVersionDigits = 16;
constexpr std::string_view kVersionsPrefix = "versions/";

[[noreturn]] void refuse_place(const fs::path& folder, const std::string& message,
                               Exit exit = Exit::kInput, const std::string& help = "") {
  throw Failure(exit, {.code = "E-RT-PLACE",
                       .message = message,
                       .help = !help.empty() ? help
                                             : "plumb-rt verify --to " +
                                                   shell_word(fs::absolute(folder).string())});
}

/// The target of a symbolic link; empty, with errno, if it cannot be read.
std::string link_target(const fs::path& link) noexcept {
  std::array<char, PATH_MAX> target;
  const ssize_t n = ::readlink(link.c_str(), target.data(), target.size());
  return n <= 0 ? "" : std::string(target.data(), static_cast<std::size_t>(n));
}

}  // namespace

bool is_place_name(const std::string& name) {
  return !name.empty() && name.front() != '.' && name.front() != '-' && name.size() <= 100 &&
         name.find_first_not_of(
             "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-"
             ":@") == std::string::npos;
}

bool is_version_id(const std::string& text) {
  return text.size() == kVersionDigits &&
         text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

std::vector<std::string> InstallPlace::ids() const {
  std::vector<std::string> out;
  std::error_code error;
  for (fs::directory_iterator at(versions(), error), end; !error && at != end; at.increment(error))
    if (is_version_id(at->path().filename().string()))
      out.push_back(at->path().filename().string());
  std::sort(out.begin(), out.end());
  return out;
}

bool is_place(const fs::path& folder) {
  std::error_code ignored;
  const InstallPlace place{folder};
  if (fs::exists(fs::symlink_status(place.link(), ignored))) return true;
  return fs::is_directory(fs::symlink_status(place.versions(), ignored)) &&
         !fs::exists(folder / "rt.toml", ignored);
}

std::optional<std::string> current_version(const InstallPlace& place) {
  std::error_code ignored;
  const std::string name = display_name(place.link());
  const auto status = fs::symlink_status(place.link(), ignored);
  if (!fs::exists(status)) return std::nullopt;
  if (!fs::is_symlink(status))
    refuse_place(place.folder, fmt::format("{} is no symbolic link to a version", name));
  const std::string id = current_version_if_any(place);
  if (id.empty())
    refuse_place(place.folder, fmt::format("{} points to '{}', which is no version", name,
                                           link_target(place.link())));
  if (!fs::is_directory(fs::symlink_status(place.version(id), ignored)))
    refuse_place(place.folder,
                 fmt::format("{} points to version {}, which is not there", name, id));
  return id;
}

std::string current_version_if_any(const InstallPlace& place) noexcept {
  std::string target = link_target(place.link());
  if (!target.starts_with(kVersionsPrefix)) return "";
  target.erase(0, kVersionsPrefix.size());
  return is_version_id(target) ? target : "";
}

CurrentLink CurrentLink::prepare(const InstallPlace& place, const std::string& id) {
  CurrentLink out;
  out.link_ = place.link();
  const fs::path draft = place.folder / ".current.new";
  ::unlink(draft.c_str());  // that of a killed install; the caller holds the lock
  const std::string target = std::string(kVersionsPrefix) + id;
  if (::symlink(target.c_str(), draft.c_str()) != 0) refuse_file_write(draft, errno);
  out.draft_ = draft;
  return out;
}

CurrentLink::CurrentLink(CurrentLink&& other) noexcept
    : draft_(std::move(other.draft_)), link_(std::move(other.link_)) {
  other.draft_.clear();
}

CurrentLink::~CurrentLink() {
  if (!draft_.empty()) ::unlink(draft_.c_str());
}

void CurrentLink::commit() {
  if (::rename(draft_.c_str(), link_.c_str()) != 0) refuse_file_write(link_, errno);
  draft_.clear();
  // The rename has taken effect, so a failure from here on must not be reported as one of it.
  try {
    sync_folder(link_.parent_path());
  } catch (const Failure&) {
  }
}

void refuse_open_place(const InstallPlace& place) {
  for (const fs::path& folder : {place.folder, place.versions()}) {
    struct stat found {};
    if (::stat(folder.c_str(), &found) != 0 || (found.st_mode & (S_IWGRP | S_IWOTH)) == 0) continue;
    refuse_place(place.folder,
                 fmt::format("{} may be written by others than its owner", display_name(folder)),
                 Exit::kInput, "chmod go-w " + shell_word(display_name(folder)));
  }
}

Content find_content(const fs::path& folder) {
  if (!is_place(folder)) return {folder, ""};
  const InstallPlace place{folder};
  refuse_open_place(place);
  const auto id = current_version(place);
  if (!id)
    refuse_place(folder, fmt::format("nothing is installed in {}", display_name(folder)),
                 Exit::kInput,
                 "plumb-rt install DIR --to " + shell_word(fs::absolute(folder).string()));
  return {place.version(*id), *id};
}

std::vector<std::string> places_below(const fs::path& store) {
  std::vector<std::string> out;
  std::error_code error;
  for (fs::directory_iterator at(store, error), end; !error && at != end; at.increment(error))
    if (is_place(at->path())) out.push_back(at->path().filename().string());
  std::sort(out.begin(), out.end());
  return out;
}

InstallPlace find_place(const std::string& to, const fs::path& store) {
  if (to.find('/') != std::string::npos) return {fs::path(to)};
  if (!to.empty()) {
    if (is_place_name(to)) return {store / to};
    refuse_place(store, fmt::format("'{}' cannot be the name of a place", to), Exit::kUsage,
                 "--to NAME of letters, digits, '.', '_' and '-', or --to ./FOLDER");
  }
  const auto names = places_below(store);
  if (names.size() == 1) return {store / names.front()};
  if (names.empty())
    refuse_place(store, fmt::format("there is no place below {}", store.string()), Exit::kUsage,
                 "name the first one: plumb-rt install DIR --to NAME");
  refuse_place(
      store,
      fmt::format("there are several places below {}: {}", store.string(), fmt::join(names, ", ")),
      Exit::kUsage, "--to " + names.front());
}

}  // namespace plumb::drivers::rt

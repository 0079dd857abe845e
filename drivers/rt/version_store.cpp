// SPDX-License-Identifier: Apache-2.0
#include "rt/version_store.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>

#include "plumb/drivers/time_source.hpp"
#include "program/bounded_file.hpp"
#include "program/file.hpp"
#include "program/shell_word.hpp"
#include "program/sums_signature.hpp"
#include "rt/listed_files.hpp"
#include "rt/synced_files.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kLongestWait{5};
constexpr char kCopyPrefix[] = ".new-", kOldPrefix[] = ".old-";
constexpr std::uintmax_t kMostListBytes = 16u << 20;

/// Makes a folder that others may read. True if it was not there.
bool make_shared_folder(const fs::path& folder) {
  if (::mkdir(folder.c_str(), 0755) != 0) {
    if (errno == EEXIST) return false;
    refuse_file_write(folder, errno);
  }
  if (::chmod(folder.c_str(), 0755) != 0)
    refuse_file_write(folder, errno);  // the umask is stricter
  return true;
}

/// Makes the folder of a place, and if it is the first one of the machine that of all places.
bool make_place(const fs::path& folder) {
  if (folder.parent_path() == kStore) make_shared_folder(kStore);
  const bool made = make_shared_folder(folder);
  if (made) sync_folder(fs::absolute(folder).lexically_normal().parent_path());
  return made;
}

std::string unused_suffix() {
  static std::atomic<unsigned> count{0};
  return fmt::format("{}-{}-{}", ::getpid(), MonotonicTime::now_ns(), count++);
}

/// The whole file, or empty if it cannot be read.
std::string text_if_any(const fs::path& file) {
  try {
    return read_regular_file(file, kMostListBytes);
  } catch (const Failure&) {
    return "";
  }
}

/// True if both versions have the same list and signature, and the first is what the list says.
bool is_same_version(const fs::path& there, const fs::path& copy) {
  for (const char* const name : {kSumsFile, kSignatureFile})
    if (text_if_any(there / name) != text_if_any(copy / name)) return false;
  try {
    const std::string sums = text_if_any(there / kSumsFile);
    check_content(there, sums, Beside::kNothing, {});
    for (const std::string& name : listed_files(there, sums))
      if (sha256(read_regular_file(there / name, kMostFileBytes)) !=
          sha256(read_regular_file(copy / name, kMostFileBytes)))
        return false;
    return true;
  } catch (const Failure&) {
    return false;
  }
}

}  // namespace

std::string version_of(const std::string& sums) { return sha256(sums).substr(0, 16); }

Deployment load_version(const fs::path& folder, const SigningRules& rules) {
  Deployment out = load_deployment(folder, Sums::kVerified, &rules);
  check_content(folder, out.sums, Beside::kNothing, {});
  return out;
}

VersionStore::VersionStore(const InstallPlace& place, Make make)
    : place_(place),
      made_(make == Make::kYes && make_place(place.folder)),
      made_versions_(make == Make::kYes && make_shared_folder(place.versions())),
      lock_(place.versions()) {
  const std::string name = display_name(place.folder);
  if (lock_.wait(kLongestWait) == FolderLock::State::kBusy)
    throw Failure(Exit::kEnvironment,
                  {.code = "E-RT-INSTALLING",
                   .message = fmt::format("another install or rollback works in {}", name),
                   .help = "wait until it has ended"});
  if (lock_.state() == FolderLock::State::kImpossible)
    throw Failure(Exit::kEnvironment,
                  {.code = lock_.error() == ENOENT ? "E-RT-PLACE" : "E-RT-LOCK",
                   .message = fmt::format("{} cannot be opened: {}", display_name(place.versions()),
                                          std::strerror(lock_.error())),
                   .help = "plumb-rt install DIR --to " + shell_word(name)});
  refuse_open_place(place);
  remove_leftovers();
}

/// A place that was made for a deploy folder that was refused goes again; else these fail.
VersionStore::~VersionStore() {
  remove_leftovers();
  if (made_versions_) ::rmdir(place_.versions().c_str());
  if (made_) ::rmdir(place_.folder.c_str());
}

void VersionStore::remove_leftovers() const {
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator at(place_.versions(), error), end; !error && at != end;
       at.increment(error)) {
    const std::string name = at->path().filename().string();
    if (name.starts_with(kCopyPrefix) || name.starts_with(kOldPrefix)) found.push_back(at->path());
  }
  for (const fs::path& one : found) std::ignore = remove_folder(one);
}

fs::path VersionStore::aside() const { return place_.versions() / (kOldPrefix + unused_suffix()); }

fs::path VersionStore::copy(const fs::path& folder, const std::string& sums) const {
  std::vector<std::string> names = listed_files(folder, sums);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  names.emplace_back(kSumsFile);
  struct stat found {};
  if (::lstat((folder / kSignatureFile).c_str(), &found) == 0) names.emplace_back(kSignatureFile);
  fs::path out = place_.versions() / (kCopyPrefix + unused_suffix());
  copy_synced(folder, names, out);
  return out;
}

VersionStore::Added VersionStore::add(const fs::path& copy, const std::string& id) const {
  const fs::path version = place_.version(id);
  std::error_code ignored;
  const bool there = fs::exists(fs::symlink_status(version, ignored));
  if (there && is_same_version(version, copy)) {
    std::ignore = remove_folder(copy);
    return Added::kWasThere;
  }
  const unsigned flags = there ? RENAME_EXCHANGE : RENAME_NOREPLACE;
  if (::renameat2(AT_FDCWD, copy.c_str(), AT_FDCWD, version.c_str(), flags) != 0) {
    const int error = errno;
    std::ignore = remove_folder(copy);
    refuse_file_write(version, error);
  }
  sync_folder(place_.versions());
  if (there) std::ignore = remove_folder(copy);  // what was there before
  return there ? Added::kWasThere : Added::kNew;
}

bool VersionStore::remove(const std::string& id) const {
  const fs::path old = aside();
  return ::rename(place_.version(id).c_str(), old.c_str()) == 0 && remove_folder(old);
}

std::vector<std::string> VersionStore::keep_newest(int keep, const History& history,
                                                   const std::vector<std::string>& needed) const {
  std::vector<std::string> newest;  // first
  for (auto line = history.lines.rbegin(); line != history.lines.rend(); ++line)
    if (std::find(newest.begin(), newest.end(), line->version) == newest.end())
      newest.push_back(line->version);
  const auto rank = [&](const std::string& id) {
    return std::find(newest.begin(), newest.end(), id) - newest.begin();
  };
  std::vector<std::string> ids = place_.ids(), out;
  std::stable_sort(ids.begin(), ids.end(),
                   [&](const std::string& a, const std::string& b) { return rank(a) < rank(b); });
  for (std::size_t i = static_cast<std::size_t>(std::max(keep, 1)); i < ids.size(); ++i) {
    if (std::find(needed.begin(), needed.end(), ids[i]) != needed.end()) continue;
    if (FolderLock(place_.version(ids[i])).state() == FolderLock::State::kBusy) continue;
    if (remove(ids[i])) out.push_back(ids[i]);
  }
  return out;
}

}  // namespace plumb::drivers::rt

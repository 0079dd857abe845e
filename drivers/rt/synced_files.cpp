// SPDX-License-Identifier: Apache-2.0
#include "rt/synced_files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <set>

#include "plumb/drivers/descriptor.hpp"
#include "program/byte_output.hpp"
#include "program/file.hpp"
#include "program/problem.hpp"
#include "program/shell_word.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;

constexpr off_t kMostCopied = 256 << 20;
constexpr mode_t kFileMode = 0444, kFolderMode = 0555;

[[noreturn]] void refuse_source(const fs::path& file, const char* code, const std::string& why) {
  throw Failure(Exit::kInput, {.code = code,
                               .message = fmt::format("{} {}", display_name(file), why),
                               .help = "ls -l " + shell_word(display_name(file))});
}

/// Opens what is to be copied, and judges what was opened.
Descriptor open_source(const fs::path& file) {
  Descriptor out(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY));
  if (!out.open() && errno == ELOOP) refuse_source(file, "E-RT-FOLDER", "is a symbolic link");
  struct stat found {};
  if (!out.open() || ::fstat(out.get(), &found) != 0)
    refuse_source(file, "E-READ", std::string("cannot be read: ") + std::strerror(errno));
  if (!S_ISREG(found.st_mode)) refuse_source(file, "E-RT-FOLDER", "is no regular file");
  if (found.st_nlink != 1) refuse_source(file, "E-RT-FOLDER", "has several names (hard links)");
  if (found.st_size > kMostCopied)
    refuse_source(file, "E-RT-FOLDER", "holds more than 256 MB, the most that is installed");
  return out;
}

void copy_file_synced(const fs::path& from, const fs::path& to) {
  const Descriptor in = open_source(from);
  const Descriptor out(::open(to.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
  if (!out.open()) refuse_file_write(to, errno);
  char block[1 << 16];
  off_t copied = 0;
  for (;;) {
    const ssize_t n = ::read(in.get(), block, sizeof(block));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0)
      refuse_source(from, "E-READ", std::string("cannot be read: ") + std::strerror(errno));
    if (n == 0) break;
    copied += n;
    if (copied > kMostCopied)
      refuse_source(from, "E-RT-FOLDER", "holds more than 256 MB, the most that is installed");
    if (const int error = plumb::write_all(out.get(), {block, static_cast<std::size_t>(n)});
        error != 0)
      refuse_file_write(to, error);
  }
  if (::fchmod(out.get(), kFileMode) != 0) refuse_file_write(to, errno);
  if (const int error = sync_to_disk(out.get()); error != 0) refuse_file_write(to, error);
}

void make_folder(const fs::path& folder) {
  if (::mkdir(folder.c_str(), 0700) != 0) refuse_file_write(folder, errno);
}

}  // namespace

void refuse_file_write(const fs::path& file, int error) {
  throw Failure(
      Exit::kEnvironment,
      {.code = "E-WRITE",
       .message = fmt::format("cannot write {}: {}", display_name(file), std::strerror(error)),
       .help = "check free space and permissions: df -h && ls -ld " +
               shell_word(display_name(file.parent_path()))});
}

void sync_folder(const fs::path& folder) {
  const Descriptor at(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!at.open()) refuse_file_write(folder, errno);
  if (const int error = sync_to_disk(at.get()); error != 0) refuse_file_write(folder, error);
}

void append_synced(const fs::path& file, const std::string& line) {
  const Descriptor out(::open(
      file.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0644));
  struct stat before {};
  if (!out.open() || ::fstat(out.get(), &before) != 0) refuse_file_write(file, errno);
  if (!S_ISREG(before.st_mode)) refuse_file_write(file, EINVAL);
  char last = '\n';
  if (before.st_size > 0 && ::pread(out.get(), &last, 1, before.st_size - 1) != 1) last = '\n';
  const std::string text = (last == '\n' ? "" : "\n") + line + "\n";
  int error = plumb::write_all(out.get(), text);
  if (error == 0) error = sync_to_disk(out.get());
  if (error == 0) return;
  std::ignore = ::ftruncate(out.get(), before.st_size);
  refuse_file_write(file, error);
}

void copy_synced(const fs::path& from, const std::vector<std::string>& names, const fs::path& to) {
  make_folder(to);
  try {
    std::set<fs::path> folders{to};
    for (const std::string& name : names) {
      fs::path folder = to;
      const fs::path within = fs::path(name).parent_path();
      for (const auto& part : within) {
        folder /= part;
        if (folders.insert(folder).second) make_folder(folder);
      }
      copy_file_synced(from / name, to / name);
    }
    for (auto folder = folders.rbegin(); folder != folders.rend(); ++folder) {
      if (::chmod(folder->c_str(), kFolderMode) != 0) refuse_file_write(*folder, errno);
      sync_folder(*folder);
    }
  } catch (...) {
    std::ignore = remove_folder(to);
    throw;
  }
}

bool remove_folder(const fs::path& folder) noexcept {
  std::error_code error;
  if (!fs::is_symlink(fs::symlink_status(folder, error)) && fs::is_directory(folder, error)) {
    ::chmod(folder.c_str(), 0700);
    for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end;
         at.increment(error)) {
      std::error_code ignored;
      if (at->is_directory(ignored) && !at->is_symlink(ignored)) ::chmod(at->path().c_str(), 0700);
    }
  }
  fs::remove_all(folder, error);
  return !error;
}

}  // namespace plumb::drivers::rt

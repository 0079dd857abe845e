// SPDX-License-Identifier: Apache-2.0
#include "program/spool.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <vector>

#include "program/byte_output.hpp"
#include "program/interrupt.hpp"
#include "program/problem.hpp"

namespace plumb {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kCopied = 1 << 20;  // bytes at a time

[[noreturn]] void cannot_spool(const fs::path& file, int error) {
  const std::string name = file.empty() ? "to stdout" : display_name(file);
  throw Failure(Exit::kEnvironment,
                {.code = "E-WRITE",
                 .message = fmt::format("cannot write {}: {}", name, std::strerror(error)),
                 .help = file.empty() ? "check what reads it: df -h"
                                      : "check free space and permissions: df -h && ls -ld " +
                                            (file.has_parent_path() ? file.parent_path().string()
                                                                    : std::string("."))});
}

/// No name means stdout.
bool goes_to_a_stream(const fs::path& file) { return file.empty() || is_stream(file); }

/// The folder the file will stand in, or the nearest above it that exists.
fs::path present_folder(const fs::path& file) {
  std::error_code ignored;
  fs::path folder = fs::absolute(file, ignored).parent_path();
  while (folder.has_relative_path() && !fs::is_directory(folder, ignored))
    folder = folder.parent_path();
  return folder;
}

int open_nameless(const fs::path& folder) {
  const int fd = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0644);
  if (fd >= 0) return fd;
  std::string name = (folder / ".plumb-XXXXXX").string();  // a file system without O_TMPFILE
  const int named = ::mkostemp(name.data(), O_CLOEXEC);
  if (named >= 0) ::unlink(name.c_str());
  return named;
}

}  // namespace

Spool::Spool(fs::path file) : file_(std::move(file)) {
  std::error_code ignored;
  if (!goes_to_a_stream(file_)) fd_ = open_nameless(present_folder(file_));
  if (fd_ < 0) fd_ = open_nameless(fs::temp_directory_path(ignored));
  if (fd_ < 0) cannot_spool(file_, errno);
}

Spool::~Spool() { ::close(fd_); }

void Spool::write(std::string_view bytes) {
  if (const int error = write_all(fd_, bytes); error != 0) cannot_spool(file_, error);
}

void Spool::commit(Overwrite overwrite) {
  if (goes_to_a_stream(file_)) return commit_to_stream();
  const Writing writing;
  commit_to_file(overwrite);
}

/// Waits for a reader if it is a pipe, and may be interrupted.
void Spool::commit_to_stream() {
  const int out =
      file_.empty() ? STDOUT_FILENO : ::open(file_.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC);
  const int error = out < 0 ? errno : copy_to(out);
  if (out >= 0 && !file_.empty()) ::close(out);
  if (error != 0) cannot_spool(file_, error);
}

void Spool::commit_to_file(Overwrite overwrite) {
  std::error_code ignored;
  if (fs::is_directory(file_, ignored)) cannot_spool(file_, EISDIR);
  if (overwrite == Overwrite::kNo && would_replace(file_))
    throw Failure(Exit::kUsage, {.code = "E-EXISTS",
                                 .message = fmt::format("{} is already there", display_name(file_)),
                                 .help = "to replace it add --force"});
  if (file_.has_parent_path()) fs::create_directories(file_.parent_path());
  // A symbolic link is kept; the file that it points to is replaced.
  const fs::path target = fs::is_symlink(file_, ignored) ? fs::weakly_canonical(file_) : file_;
  const fs::path draft = target.string() + fmt::format(".{}-spool.tmp", ::getpid());
  ::unlink(draft.c_str());  // left by a killed program that had the same process number
  int error = give_name(draft, target);
  if (error == 0 && ::rename(draft.c_str(), target.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(draft.c_str());
    cannot_spool(file_, error);
  }
  const int folder = ::open(present_folder(target).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;
  sync_to_disk(folder);
  ::close(folder);
}

/// 0 or errno.
int Spool::give_name(const fs::path& draft, const fs::path& target) const {
  struct stat present {};
  const bool replaces = ::stat(target.c_str(), &present) == 0;
  const std::string self = fmt::format("/proc/self/fd/{}", fd_);
  const bool linked =
      ::linkat(AT_FDCWD, self.c_str(), AT_FDCWD, draft.c_str(), AT_SYMLINK_FOLLOW) == 0;
  const int out =
      ::open(draft.c_str(), O_WRONLY | O_CLOEXEC | (linked ? 0 : O_CREAT | O_EXCL), 0644);
  if (out < 0) return errno;
  int error = linked ? 0 : copy_to(out);
  if (error == 0 && replaces && ::fchmod(out, present.st_mode & 07777) != 0) error = errno;
  if (error == 0) error = sync_to_disk(out);
  ::close(out);
  return error;
}

/// 0 or errno.
int Spool::copy_to(int fd) const {
  if (::lseek(fd_, 0, SEEK_SET) < 0) return errno;
  std::vector<char> buffer(kCopied);
  for (;;) {
    const ssize_t n = ::read(fd_, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno;
    if (n == 0) return 0;
    if (const int error = write_all(fd, {buffer.data(), static_cast<std::size_t>(n)}); error != 0)
      return error;
  }
}

}  // namespace plumb

// SPDX-License-Identifier: Apache-2.0
#include "program/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <openssl/evp.h>
#include <pthread.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>

#include "program/problem.hpp"

namespace plumb {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

[[noreturn]] void cannot_read(const fs::path& file, const std::string& why) {
  throw Failure(Exit::kInput,
                {.code = "E-READ",
                 .message = fmt::format("cannot read {}: {}", display_name(file), why),
                 .help = "check the path: ls -l " + folder_of(file).string()});
}

[[noreturn]] void cannot_write(const fs::path& file, int error) {
  throw Failure(
      Exit::kEnvironment,
      {.code = "E-WRITE",
       .message = fmt::format("cannot write {}: {}", display_name(file), std::strerror(error)),
       .help = "check free space and permissions: df -h && ls -ld " + folder_of(file).string()});
}

/// A file descriptor that closes itself.
class Descriptor {
 public:
  Descriptor(const char* path, int flags) : fd_(::open(path, flags | O_CLOEXEC, 0644)) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

int sync(int fd) {
  int result = 0;
  do result = ::fsync(fd);
  while (result != 0 && errno == EINTR);
  // A pipe or a device has nothing to wait for.
  return result == 0 || errno == EINVAL || errno == ENOTSUP ? 0 : errno;
}

/// 0 or errno.
int write_all(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return sync(fd);
}

/// What is replaced keeps its permissions.
int write_draft(const fs::path& draft, const fs::path& target, std::string_view bytes) {
  const Descriptor file(draft.c_str(), O_WRONLY | O_CREAT | O_EXCL);
  if (file.get() < 0) return errno;
  struct stat present {};
  if (::stat(target.c_str(), &present) == 0 && ::fchmod(file.get(), present.st_mode & 07777) != 0)
    return errno;
  return write_all(file.get(), bytes);
}

bool is_stream(const fs::path& file) {
  std::error_code ignored;
  const auto status = fs::status(file, ignored);
  return fs::is_fifo(status) || fs::is_character_file(status);
}

/// Waits for a reader if it is a pipe; until then nothing can be left half-written, so an interrupt
/// ends the program as anywhere else.
void write_into(const fs::path& stream, std::string_view bytes) {
  sigset_t interrupts, before;
  sigemptyset(&interrupts);
  sigaddset(&interrupts, SIGINT);
  sigaddset(&interrupts, SIGTERM);
  pthread_sigmask(SIG_UNBLOCK, &interrupts, &before);
  const Descriptor out(stream.c_str(), O_WRONLY | O_NOCTTY);
  const int error = out.get() < 0 ? errno : write_all(out.get(), bytes);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (error != 0) cannot_write(stream, error);
}

/// A name that no other writer uses, nor one that died before.
fs::path draft_beside(const fs::path& target) {
  static std::atomic<unsigned> count{0};
  const auto now = std::chrono::system_clock::now().time_since_epoch().count();
  return target.string() + fmt::format(".{}-{}-{}.tmp", ::getpid(), now, count++);
}

}  // namespace

std::string display_name(const fs::path& file) {
  std::error_code error;
  const fs::path here = fs::current_path(error);
  if (error || !file.is_absolute()) return file.string();
  const fs::path relative = file.lexically_normal().lexically_relative(here);
  const bool below = !relative.empty() && *relative.begin() != "..";
  return below ? relative.string() : file.string();
}

std::string read_file(const fs::path& file) {
  std::error_code error;
  const auto status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) cannot_read(file, "no such file");
  if (error) cannot_read(file, error.message());
  if (fs::is_directory(status)) cannot_read(file, "it is a directory");
  const Descriptor in(file.c_str(), O_RDONLY);
  if (in.get() < 0) cannot_read(file, std::strerror(errno));
  std::string out;
  if (fs::is_regular_file(status)) out.reserve(fs::file_size(file, error) + 1);
  std::array<char, 1 << 16> chunk;
  for (;;) {
    const ssize_t n = ::read(in.get(), chunk.data(), chunk.size());
    if (n == 0) return out;
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) cannot_read(file, std::strerror(errno));
    out.append(chunk.data(), static_cast<std::size_t>(n));
  }
}

void write_file_atomically(const fs::path& file, std::string_view bytes) {
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) cannot_write(file, EISDIR);
  if (is_stream(file)) return write_into(file, bytes);
  // A link stays a link: what it points to is replaced.
  const fs::path target = fs::is_symlink(file, ignored) ? fs::weakly_canonical(file) : file;
  const fs::path draft = draft_beside(target);
  int error = write_draft(draft, target, bytes);
  if (error == 0 && ::rename(draft.c_str(), target.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(draft.c_str());
    cannot_write(file, error);
  }
  const Descriptor directory(folder_of(target).c_str(), O_RDONLY | O_DIRECTORY);
  if (directory.get() >= 0) sync(directory.get());
}

bool would_replace(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(file, ignored) && !is_stream(file);
}

void write_new_file(const fs::path& file, std::string_view bytes, Overwrite overwrite) {
  if (overwrite == Overwrite::kNo && would_replace(file))
    throw Failure(Exit::kUsage, {.code = "E-EXISTS",
                                 .message = fmt::format("{} is already there", display_name(file)),
                                 .help = "to replace it add --force"});
  write_file_atomically(file, bytes);
}

std::string sha256(std::string_view bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1)
    throw Failure(Exit::kBug, Problem{.code = "E-BUG", .message = "SHA-256 failed"});
  std::string out;
  for (unsigned i = 0; i < size; ++i) out += fmt::format("{:02x}", digest[i]);
  return out;
}

}  // namespace plumb

// SPDX-License-Identifier: Apache-2.0
#include "program/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <openssl/evp.h>
#include <pthread.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <optional>
#include <regex>
#include <vector>

#include "program/bounded_file.hpp"
#include "program/byte_output.hpp"
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

[[noreturn]] void too_large(const fs::path& file, std::uintmax_t most) {
  throw Failure(Exit::kInput,
                {.code = "E-READ-SIZE",
                 .message = fmt::format("{} holds more than {} MB, the most that is read of such a "
                                        "file",
                                        display_name(file), most >> 20),
                 .help = "check what it is: file " + file.string()});
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

/// Writes a draft (temporary file), with the permissions of the file that it will replace. Returns
/// 0 or an errno.
int fill_draft(int fd, const fs::path& target, std::string_view bytes) {
  struct stat present {};
  if (::stat(target.c_str(), &present) == 0 && ::fchmod(fd, present.st_mode & 07777) != 0)
    return errno;
  return write_and_sync(fd, bytes);
}

/// Writes a draft that gets its name only when it is complete. Returns 0 or an errno; empty if the
/// file system does not support files without a name.
std::optional<int> write_nameless_draft(const fs::path& draft, const fs::path& target,
                                        std::string_view bytes) {
  const Descriptor file(folder_of(target).c_str(), O_TMPFILE | O_WRONLY);
  if (file.get() < 0) return std::nullopt;
  if (const int error = fill_draft(file.get(), target, bytes); error != 0) return error;
  const std::string self = fmt::format("/proc/self/fd/{}", file.get());
  if (::linkat(AT_FDCWD, self.c_str(), AT_FDCWD, draft.c_str(), AT_SYMLINK_FOLLOW) != 0)
    return std::nullopt;
  return 0;
}

int write_draft(const fs::path& draft, const fs::path& target, std::string_view bytes) {
  if (const auto done = write_nameless_draft(draft, target, bytes)) return *done;
  const Descriptor file(draft.c_str(), O_WRONLY | O_CREAT | O_EXCL);
  return file.get() < 0 ? errno : fill_draft(file.get(), target, bytes);
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
  const int error = out.get() < 0 ? errno : write_and_sync(out.get(), bytes);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (error != 0) cannot_write(stream, error);
}

/// A name that no other writer uses and that no killed writer has left.
fs::path draft_beside(const fs::path& target) {
  static std::atomic<unsigned> count{0};
  const auto now = std::chrono::system_clock::now().time_since_epoch().count();
  return target.string() + fmt::format(".{}-{}-{}.tmp", ::getpid(), now, count++);
}

/// The process number in "12-345-6.tmp", the ending that draft_beside appends to the name of the
/// target; 0 for any other text.
pid_t writer_of(std::string_view ending) {
  static const std::regex kEnding(R"((\d{1,9})-\d+-\d+\.tmp)");
  std::match_results<std::string_view::const_iterator> match;
  if (!std::regex_match(ending.begin(), ending.end(), match, kEnding)) return 0;
  return std::stoi(match[1].str());
}

/// True if a draft is older than a minute. A process of another machine that shares the folder
/// cannot be seen from here, but its draft is newer.
bool is_old(const fs::path& draft) {
  std::error_code error;
  const auto written = fs::last_write_time(draft, error);
  return !error && fs::file_time_type::clock::now() - written > std::chrono::minutes(1);
}

/// Drafts of this target whose writers were killed.
void remove_stale_drafts(const fs::path& target) {
  const std::string begin = target.filename().string() + ".";
  std::error_code ignored;
  std::vector<fs::path> stale;
  for (fs::directory_iterator at(folder_of(target), ignored), end; !ignored && at != end;
       at.increment(ignored)) {
    const std::string name = at->path().filename().string();
    if (!name.starts_with(begin) || !name.ends_with(".tmp")) continue;
    const pid_t writer = writer_of(std::string_view(name).substr(begin.size()));
    const bool gone = writer > 0 && ::kill(writer, 0) != 0 && errno == ESRCH;
    if (gone && is_old(at->path())) stale.push_back(at->path());
  }
  for (const auto& draft : stale) ::unlink(draft.c_str());
}

}  // namespace

std::string display_name(const fs::path& file) {
  std::error_code error;
  const fs::path here = fs::current_path(error);
  // A service works in "/": what it says is read, and pasted, elsewhere.
  if (error || !file.is_absolute() || here == here.root_path()) return file.string();
  const fs::path relative = file.lexically_normal().lexically_relative(here);
  const bool below = !relative.empty() && *relative.begin() != "..";
  return below ? relative.string() : file.string();
}

std::string read_file(const fs::path& file) { return read_file_up_to(file, kMostFileBytes); }

std::string read_file_up_to(const fs::path& file, std::uintmax_t most) {
  std::error_code error;
  const auto status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) cannot_read(file, "no such file");
  if (error) cannot_read(file, error.message());
  if (fs::is_directory(status)) cannot_read(file, "it is a directory");
  if (fs::is_socket(status)) cannot_read(file, "it is a socket");
  if (fs::is_regular_file(status)) {
    const std::uintmax_t size = fs::file_size(file, error);
    if (!error && size > most) too_large(file, most);
  } else {
    most = std::min(most, kMostStreamBytes);
  }
  const Descriptor in(file.c_str(), O_RDONLY | O_NOCTTY);
  if (in.get() < 0) cannot_read(file, std::strerror(errno));
  std::string out;
  const std::uintmax_t expected = fs::is_regular_file(status) ? fs::file_size(file, error) : 0;
  if (!error && expected <= most) out.reserve(expected + 1);
  std::array<char, 1 << 16> chunk;
  for (;;) {
    const ssize_t n = ::read(in.get(), chunk.data(), chunk.size());
    if (n == 0) return out;
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) cannot_read(file, std::strerror(errno));
    if (out.size() + static_cast<std::size_t>(n) > most) too_large(file, most);
    out.append(chunk.data(), static_cast<std::size_t>(n));
  }
}

/// It is opened without waiting and judged by what was opened: a name may change in between.
std::string read_regular_file(const fs::path& file, std::uintmax_t most) {
  const Descriptor in(file.c_str(), O_RDONLY | O_NOCTTY | O_NONBLOCK);
  if (in.get() < 0) cannot_read(file, errno == ENOENT ? "no such file" : std::strerror(errno));
  struct stat found {};
  if (::fstat(in.get(), &found) != 0) cannot_read(file, std::strerror(errno));
  if (S_ISDIR(found.st_mode)) cannot_read(file, "it is a directory");
  if (!S_ISREG(found.st_mode)) cannot_read(file, "it is no regular file");
  std::string out;
  std::array<char, 1 << 16> chunk;
  for (;;) {
    const ssize_t n = ::read(in.get(), chunk.data(), chunk.size());
    if (n == 0) return out;
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) cannot_read(file, std::strerror(errno));
    if (out.size() + static_cast<std::size_t>(n) > most) too_large(file, most);
    out.append(chunk.data(), static_cast<std::size_t>(n));
  }
}

void write_file_atomically(const fs::path& file, std::string_view bytes) {
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) cannot_write(file, EISDIR);
  if (is_stream(file)) return write_into(file, bytes);
  // A symbolic link is kept; the file that it points to is replaced.
  const fs::path target = fs::is_symlink(file, ignored) ? fs::weakly_canonical(file) : file;
  const fs::path draft = draft_beside(target);
  remove_stale_drafts(target);
  int error = write_draft(draft, target, bytes);
  if (error == 0 && ::rename(draft.c_str(), target.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(draft.c_str());
    cannot_write(file, error);
  }
  const Descriptor directory(folder_of(target).c_str(), O_RDONLY | O_DIRECTORY);
  if (directory.get() >= 0) sync_to_disk(directory.get());
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

// SPDX-License-Identifier: Apache-2.0
#include "cell/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <openssl/evp.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "cell/problem.hpp"

namespace plumb::offline {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void cannot_read(const fs::path& file, const std::string& why) {
  throw Failure(Exit::kInput, {.code = "E-READ",
                               .message = fmt::format("cannot read {}: {}", file.string(), why),
                               .help = "check the path: ls -l " + file.parent_path().string()});
}

[[noreturn]] void cannot_write(const fs::path& file, int error) {
  throw Failure(
      Exit::kEnvironment,
      {.code = "E-WRITE",
       .message = fmt::format("cannot write {}: {}", file.string(), std::strerror(error)),
       .help = "check free space and permissions: df -h && ls -ld " + file.parent_path().string()});
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

/// 0 or errno.
int write_all(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return ::fsync(fd) == 0 ? 0 : errno;
}

int write_draft(const fs::path& draft, std::string_view bytes) {
  const Descriptor file(draft.c_str(), O_WRONLY | O_CREAT | O_TRUNC);
  return file.get() < 0 ? errno : write_all(file.get(), bytes);
}

}  // namespace

std::string read_file(const fs::path& file) {
  std::error_code error;
  const auto status = fs::status(file, error);
  if (!fs::exists(status)) cannot_read(file, "no such file");
  if (fs::is_directory(status)) cannot_read(file, "it is a directory");
  std::ifstream in(file, std::ios::binary);
  if (!in) cannot_read(file, std::strerror(errno));
  std::string out;
  if (fs::is_regular_file(status)) out.reserve(fs::file_size(file, error));
  std::array<char, 1 << 16> chunk;
  while (in.read(chunk.data(), chunk.size()) || in.gcount() > 0)
    out.append(chunk.data(), static_cast<std::size_t>(in.gcount()));
  if (in.bad()) cannot_read(file, "the read failed");
  return out;
}

void write_file_atomically(const fs::path& file, std::string_view bytes) {
  if (fs::is_directory(file)) cannot_write(file, EISDIR);
  const fs::path draft = file.string() + fmt::format(".{}.tmp", ::getpid());
  int error = write_draft(draft, bytes);
  if (error == 0 && ::rename(draft.c_str(), file.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(draft.c_str());
    cannot_write(file, error);
  }
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const Descriptor directory(folder.c_str(), O_RDONLY | O_DIRECTORY);
  if (directory.get() >= 0) ::fsync(directory.get());
}

void write_new_file(const fs::path& file, std::string_view bytes, Overwrite overwrite) {
  if (overwrite == Overwrite::kNo && fs::exists(file))
    throw Failure(Exit::kUsage, {.code = "E-EXISTS",
                                 .message = fmt::format("{} is already there", file.string()),
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

}  // namespace plumb::offline

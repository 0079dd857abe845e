// SPDX-License-Identifier: Apache-2.0
#include "program/key_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "program/byte_output.hpp"
#include "program/file.hpp"
#include "program/interrupt.hpp"
#include "program/problem.hpp"
#include "program/shell_word.hpp"

namespace plumb {
namespace {

constexpr std::size_t kMostOwnedBytes = 64 << 10;  // of a key file, which has some hundred

[[noreturn]] void refuse_reading(const std::filesystem::path& file, const std::string& why) {
  throw Failure(Exit::kInput,
                {.code = "E-READ",
                 .message = fmt::format("cannot read {}: {}", display_name(file), why),
                 .help = "ls -l " + shell_word(display_name(file))});
}

/// Closes a file descriptor at the end.
struct Closing {
  int fd;
  ~Closing() {
    if (fd >= 0) ::close(fd);
  }
};

[[noreturn]] void refuse_writing(const std::filesystem::path& file, int error) {
  if (error == EEXIST)
    throw Failure(Exit::kUsage, {.code = "E-EXISTS",
                                 .message = fmt::format("{} is already there", display_name(file)),
                                 .help = "a key is never replaced: choose another name"});
  throw Failure(
      Exit::kEnvironment,
      {.code = "E-WRITE",
       .message = fmt::format("cannot write {}: {}", display_name(file), std::strerror(error)),
       .help = "check free space and permissions of its folder"});
}

/// Creates a file with these permissions, whatever the umask allows beyond them. 0 or an errno.
int create_file(const std::filesystem::path& file, const std::string& text, mode_t mode) {
  const Closing out{::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode)};
  if (out.fd < 0) return errno;
  if (::fchmod(out.fd, mode) != 0) return errno;
  return write_and_sync(out.fd, text);
}

}  // namespace

OwnedText read_owned_text(const std::filesystem::path& file) {
  const Closing in{::open(file.c_str(), O_RDONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)};
  if (in.fd < 0) refuse_reading(file, errno == ENOENT ? "no such file" : std::strerror(errno));
  struct stat found {};
  if (::fstat(in.fd, &found) != 0) refuse_reading(file, std::strerror(errno));
  if (!S_ISREG(found.st_mode)) refuse_reading(file, "it is no regular file");
  OwnedText out{.text = {}, .owner = found.st_uid, .mode = found.st_mode & 07777};
  std::array<char, 4096> block;
  for (;;) {
    const ssize_t n = ::read(in.fd, block.data(), block.size());
    if (n == 0) return out;
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) refuse_reading(file, std::strerror(errno));
    out.text.append(block.data(), static_cast<std::size_t>(n));
    if (out.text.size() > kMostOwnedBytes) refuse_reading(file, "it is larger than 64 kB");
  }
}

std::string rights_fault(uid_t owner, mode_t mode) {
  if (owner != 0 && owner != ::geteuid())
    return fmt::format("belongs to user {}, not to root", owner);
  if ((mode & (S_IWGRP | S_IWOTH)) != 0) return "may be written by others than its owner";
  return "";
}

SecretKey read_secret_key(const std::filesystem::path& file) {
  const OwnedText read = read_owned_text(file);
  const std::string name = display_name(file);
  if ((read.mode & 077) != 0)
    throw Failure(
        Exit::kInput,
        {.code = "E-KEY-RIGHTS",
         .message = fmt::format("the private key {} may be read or written by others (mode {:04o})",
                                name, read.mode),
         .help = "if nobody has read it: chmod 600 " + shell_word(name)});
  try {
    return SecretKey::read(read.text);
  } catch (const std::invalid_argument& why) {
    throw Failure(Exit::kInput,
                  {.code = "E-KEY",
                   .message = fmt::format("{} is no private key: {}", name, why.what()),
                   .help = "a new pair of keys: plumb keygen NAME"});
  }
}

KeyFiles write_new_keys(const std::filesystem::path& name) {
  if (name.filename().empty())
    throw Failure(Exit::kUsage, {.code = "E-USAGE",
                                 .message = fmt::format("'{}' names no key", name.string()),
                                 .help = "for example: plumb keygen cell4"});
  const SecretKey secret = SecretKey::generate();
  KeyFiles out{.secret = name.string() + ".key",
               .shared = name.string() + ".pub",
               .key = secret.public_key()};
  out.key.comment = name.filename().string();
  const Writing writing;
  std::error_code ignored;
  for (const auto& file : {out.secret, out.shared})
    if (std::filesystem::exists(std::filesystem::symlink_status(file, ignored)))
      refuse_writing(file, EEXIST);
  if (const int error = create_file(out.secret, secret.text(out.key.comment), 0600); error != 0) {
    if (error != EEXIST) ::unlink(out.secret.c_str());
    refuse_writing(out.secret, error);
  }
  if (const int error = create_file(out.shared, out.key.text(), 0644); error != 0) {
    if (error != EEXIST) ::unlink(out.shared.c_str());
    ::unlink(out.secret.c_str());
    refuse_writing(out.shared, error);
  }
  return out;
}

}  // namespace plumb

// SPDX-License-Identifier: Apache-2.0
#include "rt/standard_error.hpp"

#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include "plumb/drivers/descriptor.hpp"

namespace plumb::drivers::rt {
namespace {

bool all_of(std::string_view line, ssize_t written) noexcept {
  return written == static_cast<ssize_t>(line.size());
}

/// A pipe that has room takes so much at once. One without a reader has none.
bool say_if_there_is_room(int stream, std::string_view line) noexcept {
  pollfd at{.fd = stream, .events = POLLOUT, .revents = 0};
  return ::poll(&at, 1, 0) == 1 && at.revents == POLLOUT &&
         all_of(line, ::write(stream, line.data(), line.size()));
}

/// A pipe or a terminal is opened anew, because O_NONBLOCK would hold for all programs that share
/// the description.
bool say_into_stream(std::string_view line) noexcept {
  const Descriptor own(::open("/proc/self/fd/2", O_WRONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY));
  return say_if_there_is_room(own.open() ? own.get() : STDERR_FILENO, line);
}

}  // namespace

bool say_at_once(std::string_view line) noexcept {
  line = line.substr(0, PIPE_BUF);
  struct stat now {};
  if (::fstat(STDERR_FILENO, &now) != 0) return false;
  if (S_ISSOCK(now.st_mode))
    return all_of(line,
                  ::send(STDERR_FILENO, line.data(), line.size(), MSG_DONTWAIT | MSG_NOSIGNAL));
  if (S_ISFIFO(now.st_mode) || S_ISCHR(now.st_mode)) return say_into_stream(line);
  return all_of(line, ::write(STDERR_FILENO, line.data(), line.size()));
}

}  // namespace plumb::drivers::rt

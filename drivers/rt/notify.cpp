// SPDX-License-Identifier: Apache-2.0
#include "rt/notify.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string_view>
#include <tuple>

namespace plumb::drivers::rt {
namespace {

constexpr std::int64_t kNanoseconds = 1000;  // in a microsecond

/// What the manager says in whole microseconds; 0 if it says nothing, or what is no time.
std::int64_t watchdog_us() {
  const char* const text = std::getenv("WATCHDOG_USEC");
  if (text == nullptr) return 0;
  std::int64_t out = 0;
  std::from_chars(text, text + std::strlen(text), out);
  return out > 0 && out <= std::numeric_limits<std::int64_t>::max() / kNanoseconds ? out : 0;
}

int connected(std::string_view path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() < 2 || path.size() >= sizeof(address.sun_path)) return -1;
  path.copy(address.sun_path, path.size());
  if (path.front() == '@') address.sun_path[0] = '\0';  // the abstract name space
  const int fd = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + path.size());
  if (fd < 0 || ::connect(fd, reinterpret_cast<const sockaddr*>(&address), size) == 0) return fd;
  ::close(fd);
  return -1;
}

}  // namespace

ServiceManager::ServiceManager() : watchdog_ns_(watchdog_us() * kNanoseconds / 2) {
  if (const char* const path = std::getenv("NOTIFY_SOCKET")) fd_ = connected(path);
}

ServiceManager::~ServiceManager() {
  if (fd_ >= 0) ::close(fd_);
}

void ServiceManager::tell(const std::string& state) noexcept {
  if (fd_ >= 0) std::ignore = ::send(fd_, state.data(), state.size(), MSG_NOSIGNAL);
}

}  // namespace plumb::drivers::rt

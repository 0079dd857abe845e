// SPDX-License-Identifier: Apache-2.0
#include "rt/listener.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "plumb/drivers/time_source.hpp"

namespace plumb::drivers::rt {
namespace {

constexpr int kBacklog = 8;  // connections that wait to be accepted; one is served at a time

/// Milliseconds that are left until a deadline, 0 when it has passed.
class Deadline {
 public:
  explicit Deadline(int within_ms) : end_ns_(MonotonicTime::now_ns() + within_ms * kMilli_ns) {}
  int left_ms() const {
    return static_cast<int>(
        std::max<std::int64_t>(0, (end_ns_ - MonotonicTime::now_ns() + kMilli_ns - 1) / kMilli_ns));
  }
  bool wait(int fd, short event) const {
    pollfd at{.fd = fd, .events = event, .revents = 0};
    const int left = left_ms();
    return left > 0 && ::poll(&at, 1, left) == 1;
  }

 private:
  static constexpr std::int64_t kMilli_ns = 1'000'000;
  std::int64_t end_ns_;
};

/// Reads up to `end`, or to the end of the connection if `end` is empty. No text if it is too long
/// or too slow.
std::optional<std::string> read_until(int fd, const std::string& end, std::size_t most,
                                      const Deadline& deadline) {
  std::string out;
  char block[4096];
  while (deadline.wait(fd, POLLIN)) {
    const auto got = ::recv(fd, block, std::min(sizeof(block), most + 1 - out.size()), 0);
    if (got < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (got < 0) return std::nullopt;
    if (got == 0) return end.empty() ? std::optional(out) : std::nullopt;
    out.append(block, static_cast<std::size_t>(got));
    const std::size_t at = end.empty() ? std::string::npos : out.find(end);
    if (at != std::string::npos) return out.substr(0, at);
    if (out.size() > most) return std::nullopt;
  }
  return std::nullopt;
}

void write_all(int fd, std::string_view bytes, const Deadline& deadline) {
  while (!bytes.empty() && deadline.wait(fd, POLLOUT)) {
    const auto sent = ::send(fd, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0 && errno != EINTR && errno != EAGAIN) return;
    if (sent > 0) bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
}

bool unix_address(const std::filesystem::path& path, sockaddr_un& out) {
  const std::string text = path.string();
  out = {};
  out.sun_family = AF_UNIX;
  if (text.empty() || text.size() >= sizeof(out.sun_path)) {
    errno = ENAMETOOLONG;
    return false;
  }
  text.copy(out.sun_path, text.size());
  return true;
}

/// The user who connected, as the kernel knows him; -1 of a socket that has none.
std::int64_t user_of(int fd) {
  ucred peer{};
  socklen_t size = sizeof(peer);
  const bool known = ::getsockopt(fd, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0 &&
                     size == sizeof(peer) && peer.uid != static_cast<uid_t>(-1);
  return known ? static_cast<std::int64_t>(peer.uid) : -1;
}

std::optional<Descriptor> listening(Descriptor fd, const sockaddr* address, socklen_t size) {
  if (!fd.open() || ::bind(fd.get(), address, size) != 0 || ::listen(fd.get(), kBacklog) != 0)
    return std::nullopt;
  return fd;
}

Descriptor accepted(int listening, ReserveDescriptor& reserve) {
  const auto accept = [&] {
    return Descriptor(::accept4(listening, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
  };
  Descriptor out = accept();
  if (out.open() || (errno != EMFILE && errno != ENFILE)) return out;
  reserve.give_up();
  return accept();
}

}  // namespace

std::optional<Asked> take_request(int listening, ReserveDescriptor& reserve,
                                  const std::string& end_of_request, const Patience& patience) {
  Descriptor peer = accepted(listening, reserve);
  if (!peer.open()) return std::nullopt;
  auto request =
      read_until(peer.get(), end_of_request, patience.most_bytes, Deadline(patience.within_ms));
  if (!request) return std::nullopt;
  const std::int64_t uid = user_of(peer.get());
  return Asked{std::move(peer), std::move(*request), uid};
}

void reply_to(const Descriptor& peer, const std::string& answer, const Patience& patience) {
  write_all(peer.get(), answer, Deadline(patience.within_ms));
}

void serve_one(int listening, ReserveDescriptor& reserve, const std::string& end_of_request,
               const Patience& patience,
               const std::function<std::string(const std::string&)>& answer) {
  const auto asked = take_request(listening, reserve, end_of_request, patience);
  if (asked) reply_to(asked->peer, answer(asked->request), patience);
}

std::optional<Descriptor> listen_unix(const std::filesystem::path& path) {
  sockaddr_un address;
  if (!unix_address(path, address)) return std::nullopt;
  const mode_t before = ::umask(0177);
  auto out = listening(Descriptor(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)),
                       reinterpret_cast<const sockaddr*>(&address), sizeof(address));
  ::umask(before);
  return out;
}

std::optional<Descriptor> listen_loopback(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  Descriptor fd(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  const int on = 1;
  if (fd.open()) ::setsockopt(fd.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on));
  return listening(std::move(fd), reinterpret_cast<const sockaddr*>(&address), sizeof(address));
}

std::optional<std::string> ask(const std::filesystem::path& path, const std::string& request,
                               int within_ms) {
  constexpr std::size_t kMost = 1 << 20;  // bytes of an answer; a status has some 10,000
  sockaddr_un address;
  const Descriptor fd(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (!fd.open() || !unix_address(path, address)) return std::nullopt;
  if (::connect(fd.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0)
    return std::nullopt;
  const Deadline deadline(within_ms);
  write_all(fd.get(), request, deadline);
  return read_until(fd.get(), "", kMost, deadline);
}

}  // namespace plumb::drivers::rt

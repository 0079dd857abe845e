// SPDX-License-Identifier: Apache-2.0
#include "modbus_connection.hpp"

#include <netinet/tcp.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/select.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "plumb/drivers/time_source.hpp"

namespace plumb::drivers {
namespace {

constexpr std::size_t kSerialHead = 1;  // unit
constexpr std::size_t kSerialTail = 2;  // check sum, which libmodbus writes and checks

void set_timeouts(modbus_t* context, double timeout_s) {
  const auto timeout_us = static_cast<std::uint32_t>(timeout_s * 1e6);
  ::modbus_set_response_timeout(context, timeout_us / 1'000'000, timeout_us % 1'000'000);
  ::modbus_set_indication_timeout(context, timeout_us / 1'000'000, timeout_us % 1'000'000);
  ::modbus_set_byte_timeout(context, 0, 0);
  ::modbus_set_error_recovery(context, MODBUS_ERROR_RECOVERY_NONE);
}

/// Waits until the connection is established. Returns 0 or an errno.
int await_connection(int socket, double timeout_s, const LinkThread& thread) {
  std::array<pollfd, 2> events{pollfd{.fd = socket, .events = POLLOUT, .revents = 0},
                               pollfd{.fd = thread.stop_event(), .events = POLLIN, .revents = 0}};
  const timespec wait = wait_until(MonotonicTime::now_ns() + to_ns(timeout_s));
  const int ready = ::ppoll(events.data(), events.size(), &wait, nullptr);
  if (thread.stopping()) return ECANCELED;
  if (ready == 0) return ETIMEDOUT;
  if (ready < 0) return errno;
  int error = 0;
  socklen_t size = sizeof error;
  return ::getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size) == 0 ? error : errno;
}

/// Connects the socket. Returns 0 or an errno.
int connect(int socket, const SocketAddress& to, double timeout_s, const LinkThread& thread) {
  const int on = 1;
  ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  ::setsockopt(socket, SOL_SOCKET, SO_KEEPALIVE, &on, sizeof on);
  if (::connect(socket, to.get(), to.size) == 0) return 0;
  return errno == EINPROGRESS ? await_connection(socket, timeout_s, thread) : errno;
}

ModbusContext open_tcp(const TcpAddress& at, double timeout_s, const LinkThread& thread) {
  const auto to = socket_address(at.host, at.port);
  if (!to) return errno = EINVAL, nullptr;
  const int socket = ::socket(to->family(), SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket < 0) return nullptr;
  int error = socket >= FD_SETSIZE ? EMFILE : connect(socket, *to, timeout_s, thread);
  // The address given to libmodbus is not used: the socket is connected.
  ModbusContext context(error == 0 ? ::modbus_new_tcp("127.0.0.1", MODBUS_TCP_DEFAULT_PORT)
                                   : nullptr);
  if (!context) {
    if (error == 0) error = errno;
    ::close(socket);
    return errno = error, nullptr;
  }
  ::modbus_set_socket(context.get(), socket);
  set_timeouts(context.get(), timeout_s);
  return context;
}

ModbusConnection::Result judge_failure(int error) {
  if (error == ETIMEDOUT) return ModbusConnection::Result::kLate;
  return error > MODBUS_ENOBASE ? ModbusConnection::Result::kBad : ModbusConnection::Result::kLost;
}

}  // namespace

ModbusContext open_serial(const SerialLine& line, int unit, double timeout_s) {
  ModbusContext context(::modbus_new_rtu(line.device.c_str(), line.baud,
                                         static_cast<char>(line.parity), 8, line.stop_bits));
  if (!context || ::modbus_set_slave(context.get(), unit) != 0) return nullptr;
  set_timeouts(context.get(), timeout_s);
  if (::modbus_connect(context.get()) != 0) return nullptr;
  if (::modbus_get_socket(context.get()) >= FD_SETSIZE) return errno = EMFILE, nullptr;
  ::modbus_flush(context.get());
  return context;
}

std::unique_ptr<ModbusConnection> ModbusConnection::open(const ModbusClientSettings& settings,
                                                         const LinkThread& thread) {
  const auto* tcp = std::get_if<TcpAddress>(&settings.server);
  ModbusContext context = tcp != nullptr ? open_tcp(*tcp, settings.response_timeout_s, thread)
                                         : open_serial(std::get<SerialLine>(settings.server),
                                                       settings.unit, settings.response_timeout_s);
  if (!context) return nullptr;
  return std::unique_ptr<ModbusConnection>(
      new ModbusConnection(std::move(context), settings.unit, tcp != nullptr));
}

ModbusConnection::Result ModbusConnection::read(std::uint16_t first,
                                                std::span<std::uint16_t> registers) {
  const std::span<std::uint8_t> pdu = std::span(request_).subspan(kMbapHeader);
  const auto count = static_cast<std::uint16_t>(registers.size());
  pdu[0] = static_cast<std::uint8_t>(ModbusFunction::kReadHolding);
  set_word(pdu, 1, first);
  set_word(pdu, 3, count);
  const Result result = exchange(5);
  if (result != Result::kDone) return result;
  if (answer_pdu_.size() != 2 + 2 * std::size_t{count} || answer_pdu_[1] != 2 * count)
    return Result::kBad;
  for (std::size_t i = 0; i < count; ++i) registers[i] = word_at(answer_pdu_, 2 + 2 * i);
  return Result::kDone;
}

ModbusConnection::Result ModbusConnection::write(std::uint16_t first,
                                                 std::span<const std::uint16_t> registers) {
  const std::span<std::uint8_t> pdu = std::span(request_).subspan(kMbapHeader);
  const auto count = static_cast<std::uint16_t>(registers.size());
  pdu[0] = static_cast<std::uint8_t>(ModbusFunction::kWriteMultiple);
  set_word(pdu, 1, first);
  set_word(pdu, 3, count);
  pdu[5] = static_cast<std::uint8_t>(2 * count);
  for (std::size_t i = 0; i < count; ++i) set_word(pdu, 6 + 2 * i, registers[i]);
  const Result result = exchange(6 + 2 * std::size_t{count});
  if (result != Result::kDone) return result;
  return std::ranges::equal(answer_pdu_, pdu.first(5)) ? Result::kDone : Result::kBad;
}

bool ModbusConnection::unasked_bytes() const {
  int waiting = 0;
  return ::ioctl(::modbus_get_socket(context_.get()), FIONREAD, &waiting) == 0 && waiting > 0;
}

bool ModbusConnection::send_request(std::size_t pdu_size) {
  if (!tcp_) {
    request_[kMbapHeader - kSerialHead] = unit_;
    const int size = static_cast<int>(kSerialHead + pdu_size);
    return ::modbus_send_raw_request(context_.get(), request_.data() + kMbapHeader - kSerialHead,
                                     size) == size + static_cast<int>(kSerialTail);
  }
  put_header({.transaction = ++transaction_,
              .unit = unit_,
              .pdu_size = static_cast<std::uint16_t>(pdu_size)},
             request_);
  const std::size_t size = kMbapHeader + pdu_size;
  return ::send(::modbus_get_socket(context_.get()), request_.data(), size, MSG_NOSIGNAL) ==
         static_cast<ssize_t>(size);
}

ModbusConnection::Result ModbusConnection::exchange(std::size_t pdu_size) {
  if (unasked_bytes()) return Result::kBad;
  if (!send_request(pdu_size)) return Result::kLost;
  const int received = ::modbus_receive_confirmation(context_.get(), answer_.data());
  if (received < 0) return judge_failure(errno);
  if (!is_framed_well(static_cast<std::size_t>(received))) return Result::kBad;
  const std::size_t head = tcp_ ? kMbapHeader : kSerialHead;
  const std::size_t tail = tcp_ ? 0 : kSerialTail;
  answer_pdu_ = std::span(answer_).subspan(head, static_cast<std::size_t>(received) - head - tail);
  const std::uint8_t function = request_[kMbapHeader];
  if (answer_pdu_[0] == function) return Result::kDone;
  const bool refused = answer_pdu_[0] == (function | 0x80) && answer_pdu_.size() == 2;
  return refused ? Result::kRefused : Result::kBad;
}

bool ModbusConnection::is_framed_well(std::size_t size) const {
  const std::span<const std::uint8_t> frame(answer_);
  if (!tcp_) return size >= kSerialHead + 2 + kSerialTail && frame[0] == unit_;
  return size >= kMbapHeader + 2 && word_at(frame, 0) == transaction_ && word_at(frame, 2) == 0 &&
         word_at(frame, 4) == size - (kMbapHeader - 1) && frame[kMbapHeader - 1] == unit_;
}

}  // namespace plumb::drivers

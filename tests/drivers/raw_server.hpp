// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <map>
#include <mutex>
#include <thread>

#include "plumb/drivers/bus_content.hpp"
#include "tests/drivers/raw_arm.hpp"

namespace plumb::tests {

/// A controller that is the Modbus TCP server of plumb-rt, made of sockets and of the map of
/// registers alone. It remembers who wrote what, and does to the registers what the test says.
class RawServer {
 public:
  using Bytes = RawArm::Bytes;
  using Words = std::vector<std::uint16_t>;
  static constexpr std::uint16_t kCorrected = 1200, kStatus = 1248, kSignature = 1272,
                                 kOwner = 1288, kOurs = 1200, kEnd = 1290;

  RawServer(const format::Chain& arm, std::uint32_t robot, RawArm::Packing packing = {},
            bool strict = false)
      : arm_(arm, robot, packing), strict_(strict) {
    listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof at;
    ::bind(listener_, reinterpret_cast<const sockaddr*>(&at), size);
    ::listen(listener_, 8);
    ::getsockname(listener_, reinterpret_cast<sockaddr*>(&at), &size);
    port = ntohs(at.sin_port);
    thread_ = std::thread([this] { run(); });
  }
  ~RawServer() {
    ended_ = true;
    thread_.join();
    for (const Client& client : clients_) ::close(client.socket);
    ::close(listener_);
  }
  RawServer(const RawServer&) = delete;
  RawServer& operator=(const RawServer&) = delete;

  struct Write {
    int client = 0;  // in the order in which they connected, from 1
    std::uint16_t first = 0;
    Words words;
    int looks = 0;  // how often the client had read the registers of plumb-rt
    std::chrono::steady_clock::time_point time;
  };

  std::uint16_t port = 0;
  std::atomic<bool> acknowledge{false};
  enum class Lose { kNothing, kRequest, kAnswer };
  std::atomic<Lose> lose{Lose::kNothing};  // of the next write; the connection ends with it

  /// Writes into any of these registers are answered with this exception; 0: all are taken.
  void refuse(std::uint8_t exception, std::uint16_t first = kOurs, std::uint16_t end = kEnd) {
    const std::lock_guard lock(mutex_);
    refusal_ = {exception, first, end};
  }

  /// As an operator does: again if the button is still lit, because a busy machine left a gap.
  void press() {
    for (int i = 0; i < 10 && (i == 0 || asks()); ++i) {
      acknowledge = true;
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      acknowledge = false;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  }
  /// plumb-rt's status asks for an acknowledgement.
  bool asks() { return registers(kStatus, 17)[5] == 6; }

  /// The registers of plumb-rt become zero, as a controller's do whose program starts.
  void zero() {
    const std::lock_guard lock(mutex_);
    registers_.erase(registers_.lower_bound(kOurs), registers_.lower_bound(kEnd));
  }
  /// A client of the test's own writes.
  void put(std::uint16_t first, const Words& words) {
    const std::lock_guard lock(mutex_);
    set(first, words);
  }
  void hang_up() { hang_up_ = true; }

  Words registers(std::uint16_t first, std::size_t count) {
    const std::lock_guard lock(mutex_);
    return get(first, count);
  }
  std::vector<Write> writes() {
    const std::lock_guard lock(mutex_);
    return writes_;
  }
  void forget_writes() {
    const std::lock_guard lock(mutex_);
    writes_.clear();
  }
  int looks_of(int client) {
    const std::lock_guard lock(mutex_);
    return looks_[client];
  }
  int newest_client() {
    const std::lock_guard lock(mutex_);
    return next_client_ - 1;
  }
  /// The state that plumb-rt's status shows; -1: there is none.
  int state() {
    const Words status = registers(kStatus, 17);
    return status[14] == 0 && status[15] == 0 ? -1 : status[1];
  }
  bool sees(drivers::SessionState wanted) { return state() == static_cast<int>(wanted); }
  /// Whether plumb-rt has written that state since there were so many writes, however shortly.
  bool has_seen(drivers::SessionState wanted, std::size_t since) {
    const std::lock_guard lock(mutex_);
    return std::any_of(writes_.begin() + static_cast<std::ptrdiff_t>(since), writes_.end(),
                       [wanted](const Write& write) {
                         return write.first == kStatus &&
                                write.words[1] == static_cast<int>(wanted);
                       });
  }

  /// The largest step between two answers in a row, by the most time that may lie between them
  /// [m/s]: an answer was computed after its target stood here, and before it came.
  double largest_speed_m_s() {
    const std::lock_guard lock(mutex_);
    double out = 0.0;
    const Write* before = nullptr;
    for (const Write& write : writes_) {
      if (write.first != kCorrected || arm_.target(write.words[12]) == nullptr) continue;
      if (before != nullptr && before->words[12] != write.words[12]) {
        const std::chrono::duration<double> most = write.time - stood_[before->words[12]];
        const double step_m = (correction(write) - correction(*before)).norm() - kRounded_m;
        out = std::max(out, step_m / (most.count() + 0.004));
      }
      before = &write;
    }
    return out;
  }
  /// The largest correction among the answers of a client [m].
  double largest_correction_m(int client) {
    const std::lock_guard lock(mutex_);
    double out = 0.0;
    for (const Write& write : writes_)
      if (write.client == client && write.first == kCorrected &&
          arm_.target(write.words[12]) != nullptr)
        out = std::max(out, correction(write).norm());
    return out;
  }

 private:
  static constexpr double kRounded_m = 4e-6;  // of targets and answers, to a micrometre each

  struct Client {
    int socket = -1;
    int number = 0;
    Bytes received;
  };

  static Words words_of(const Bytes& bytes) {
    Words out;
    for (std::size_t i = 0; i + 1 < bytes.size(); i += 2)
      out.push_back(static_cast<std::uint16_t>(bytes[i] << 8 | bytes[i + 1]));
    return out;
  }
  static std::uint16_t word(const Bytes& bytes, std::size_t i) {
    return static_cast<std::uint16_t>(bytes[i] << 8 | bytes[i + 1]);
  }

  void set(std::uint16_t first, const Words& words) {
    for (std::size_t i = 0; i < words.size(); ++i)
      registers_[static_cast<std::uint16_t>(first + i)] = words[i];
  }
  Words get(std::uint16_t first, std::size_t count) {
    Words out;
    for (std::size_t i = 0; i < count; ++i) {
      const auto found = registers_.find(static_cast<std::uint16_t>(first + i));
      out.push_back(found == registers_.end() ? std::uint16_t{0} : found->second);
    }
    return out;
  }

  Vector3 correction(const Write& answer) const {
    Vector3 out;
    for (int i = 0; i < 3; ++i) {
      const auto at = static_cast<std::size_t>(2 * i);
      const auto bits = static_cast<std::uint32_t>(answer.words[at]) << 16 | answer.words[at + 1];
      out(i) = 1e-6 * static_cast<double>(static_cast<std::int32_t>(bits));
    }
    return out - *arm_.target(answer.words[12]);
  }

  void run() {
    auto next = std::chrono::steady_clock::now();
    while (!ended_) {
      if (std::chrono::steady_clock::now() >= next) {
        beat();
        next += std::chrono::milliseconds(4);
      }
      if (hang_up_.exchange(false)) close_all();
      std::vector<pollfd> events{{.fd = listener_, .events = POLLIN, .revents = 0}};
      for (const Client& client : clients_)
        events.push_back({.fd = client.socket, .events = POLLIN, .revents = 0});
      ::poll(events.data(), events.size(), 1);
      for (std::size_t i = 0; i < clients_.size(); ++i)
        if (events[i + 1].revents != 0) serve(clients_[i]);
      std::erase_if(clients_, [](const Client& client) { return client.socket < 0; });
      if (events[0].revents != 0) accept();
    }
  }

  void beat() {
    const std::lock_guard lock(mutex_);
    for (const auto& [first, bytes] : arm_.beat({.acknowledge = acknowledge}))
      set(first, words_of(bytes));
    stood_[registers_[1060]] = std::chrono::steady_clock::now();  // the counter of the target
  }

  void accept() {
    const int socket = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
    const int on = 1;
    ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    const std::lock_guard lock(mutex_);
    clients_.push_back({.socket = socket, .number = next_client_++, .received = {}});
  }

  void close_all() {
    for (Client& client : clients_) hang_up(client);
    clients_.clear();
  }
  static void hang_up(Client& client) {
    ::close(client.socket);
    client.socket = -1;
  }

  void serve(Client& client) {
    Bytes more(512);
    const ssize_t got = ::recv(client.socket, more.data(), more.size(), 0);
    if (got <= 0) return hang_up(client);
    client.received.insert(client.received.end(), more.begin(), more.begin() + got);
    while (client.socket >= 0 && client.received.size() >= 7 &&
           client.received.size() >= 6U + word(client.received, 4)) {
      const auto end = client.received.begin() + 6 + word(client.received, 4);
      const Bytes frame(client.received.begin(), end);
      client.received.erase(client.received.begin(), end);
      answer(client, frame);
    }
  }

  void answer(Client& client, const Bytes& frame) {
    const Bytes pdu(frame.begin() + 7, frame.end());
    const bool writes = pdu[0] == 16;
    const Lose lost = writes ? lose.exchange(Lose::kNothing) : Lose::kNothing;
    if (lost == Lose::kRequest) return hang_up(client);
    const Bytes said = writes ? write(client, pdu) : read(client, pdu);
    if (lost == Lose::kAnswer) return hang_up(client);
    Bytes out(frame.begin(), frame.begin() + 4);
    RawArm::put(out, static_cast<std::uint32_t>(said.size() + 1));
    out.push_back(frame[6]);
    out.insert(out.end(), said.begin(), said.end());
    ::send(client.socket, out.data(), out.size(), MSG_NOSIGNAL);
  }

  Bytes read(const Client& client, const Bytes& pdu) {
    const std::lock_guard lock(mutex_);
    const std::uint16_t first = word(pdu, 1), count = word(pdu, 3);
    if (first <= kCorrected && first + count > kCorrected) ++looks_[client.number];
    for (std::uint16_t i = 0; strict_ && i < count; ++i)
      if (first + i < kOurs && !registers_.contains(static_cast<std::uint16_t>(first + i)))
        return {0x83, 2};
    Bytes out{3, static_cast<std::uint8_t>(2 * count)};
    for (const std::uint16_t one : get(first, count)) RawArm::put(out, one);
    return out;
  }

  Bytes write(const Client& client, const Bytes& pdu) {
    const std::lock_guard lock(mutex_);
    const Words words = words_of(Bytes(pdu.begin() + 6, pdu.end()));
    const std::size_t begin = word(pdu, 1);
    if (refusal_.exception != 0 && begin < refusal_.end && begin + words.size() > refusal_.first)
      return {static_cast<std::uint8_t>(pdu[0] | 0x80), refusal_.exception};
    set(word(pdu, 1), words);
    writes_.push_back({client.number, word(pdu, 1), words, looks_[client.number],
                       std::chrono::steady_clock::now()});
    return {pdu.begin(), pdu.begin() + 5};
  }

  struct Refusal {
    std::uint8_t exception = 0;
    std::uint16_t first = 0, end = 0;
  };

  RawArm arm_;
  bool strict_ = false;  // of the controller's registers there are only those of messages
  Refusal refusal_;
  int listener_ = -1;
  std::vector<Client> clients_;
  std::mutex mutex_;  // of all below
  std::map<std::uint16_t, std::uint16_t> registers_;
  std::vector<Write> writes_;
  std::map<std::uint16_t, std::chrono::steady_clock::time_point> stood_;  // since when, by counter
  std::map<int, int> looks_;
  int next_client_ = 1;
  std::atomic<bool> hang_up_{false}, ended_{false};
  std::thread thread_;
};

}  // namespace plumb::tests

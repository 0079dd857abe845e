// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>
#include <vector>

#include "plumb/drivers/bus_content.hpp"
#include "tests/drivers/raw_arm.hpp"

namespace plumb::tests {

/// A controller that asks a plumb-rt on Modbus TCP, made of sockets and of the map of registers
/// alone: frames, numbers and check sums are its own.
class RawController {
 public:
  RawController(std::uint16_t port, const format::Chain& arm, std::uint32_t robot,
                RawArm::Packing packing = {})
      : port_(port), arm_(arm, robot, packing), thread_([this] {
          while (!ended_) beat();
        }) {}
  ~RawController() {
    ended_ = true;
    thread_.join();
    hang_up();
  }
  RawController(const RawController&) = delete;
  RawController& operator=(const RawController&) = delete;

  std::atomic<bool> acknowledge{false};
  std::atomic<bool> another_tool{false};  // the pose shown is not the nominal arm's
  std::atomic<int> state{-1};             // of plumb-rt; -1: none was heard

  std::atomic<bool> asks{false};  // for an acknowledgement, as its status says

  bool sees(drivers::SessionState wanted) const { return state == static_cast<int>(wanted); }

  /// As an operator does: again if the button is still lit, because a busy machine left a gap.
  void press() {
    for (int i = 0; i < 10 && (i == 0 || asks); ++i) {
      acknowledge = true;
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      acknowledge = false;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  }

 private:
  using Bytes = RawArm::Bytes;

  void hang_up() {
    if (socket_ >= 0) ::close(socket_);
    socket_ = -1;
    state = -1;
  }

  bool dial() {
    if (socket_ >= 0) return true;
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port_);
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const int on = 1;
    const timeval patience{.tv_sec = 0, .tv_usec = 200'000};
    socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    ::setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    if (::connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0) return true;
    hang_up();
    return false;
  }

  /// The answer's data behind the function code; empty: the connection is gone.
  Bytes ask(const Bytes& pdu) {
    if (socket_ < 0) return {};
    Bytes frame{0, 1, 0, 0, 0, static_cast<std::uint8_t>(pdu.size() + 1), 1};
    frame.insert(frame.end(), pdu.begin(), pdu.end());
    Bytes answer(260);
    const bool sent = ::send(socket_, frame.data(), frame.size(), MSG_NOSIGNAL) ==
                      static_cast<ssize_t>(frame.size());
    const ssize_t got = sent ? ::recv(socket_, answer.data(), answer.size(), 0) : -1;
    if (got < 9) {
      hang_up();
      return {};
    }
    return {answer.begin() + 8, answer.begin() + got};
  }

  void write(std::uint16_t first, const Bytes& words) {
    Bytes pdu{16};
    RawArm::put(pdu, first);
    RawArm::put(pdu, static_cast<std::uint32_t>(words.size() / 2));
    pdu.push_back(static_cast<std::uint8_t>(words.size()));
    pdu.insert(pdu.end(), words.begin(), words.end());
    ask(pdu);
  }

  void read_status() {
    Bytes pdu{3};
    RawArm::put(pdu, arm_.layout.find(drivers::MessageKind::kStatus)->first_register);
    RawArm::put(pdu, 6);
    const Bytes said = ask(pdu);  // number of bytes, then the pairs of state, mode and status
    if (said.size() != 13) return;
    const bool big = arm_.layout.word_order == drivers::ByteOrder::kBig;
    asks = said[big ? 12 : 10] == 6;
    state = said[big ? 4 : 2];
  }

  void beat() {
    const auto next = std::chrono::steady_clock::now() + std::chrono::milliseconds(4);
    if (dial()) {
      for (const auto& [first, words] :
           arm_.beat({.acknowledge = acknowledge, .another_tool = another_tool}))
        write(first, words);
      read_status();
    }
    std::this_thread::sleep_until(next);
  }

  std::uint16_t port_;
  RawArm arm_;
  int socket_ = -1;
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

}  // namespace plumb::tests

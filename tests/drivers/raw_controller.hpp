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
#include <cmath>
#include <cstdint>
#include <thread>
#include <vector>

#include "plumb/drivers/bus_content.hpp"
#include "plumb/drivers/bus_layout.hpp"
#include "plumb/runtime/chain.hpp"

namespace plumb::tests {

/// A controller that asks a plumb-rt on Modbus TCP, made of sockets and of the map of registers
/// alone: frames, numbers and check sums are its own. Its arm swings, and is the nominal one.
class RawController {
 public:
  RawController(std::uint16_t port, const format::Chain& arm, std::uint32_t robot)
      : port_(port), arm_(arm), robot_(robot), thread_([this] {
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

  bool sees(drivers::SessionState wanted) const { return state == static_cast<int>(wanted); }

  void press() {
    acknowledge = true;
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    acknowledge = false;
  }

 private:
  using Bytes = std::vector<std::uint8_t>;
  using Kind = drivers::MessageKind;

  /// CRC-32P4 of AUTOSAR: polynomial F4ACFB13, reflected.
  static std::uint32_t crc(const Bytes& bytes) {
    std::uint32_t out = 0xFFFFFFFF;
    for (const std::uint8_t byte : bytes) {
      out ^= byte;
      for (int i = 0; i < 8; ++i) out = (out >> 1) ^ ((out & 1) != 0 ? 0xC8DF352F : 0);
    }
    return ~out;
  }

  static void put(Bytes& out, std::uint32_t word) {
    out.push_back(static_cast<std::uint8_t>(word >> 8));
    out.push_back(static_cast<std::uint8_t>(word));
  }
  void put_pair(Bytes& out, std::uint32_t value) const {
    const bool big = layout_.word_order == drivers::ByteOrder::kBig;
    put(out, (big ? value >> 16 : value) & 0xFFFF);
    put(out, (big ? value : value >> 16) & 0xFFFF);
  }

  Bytes block(const drivers::MessageLayout& message, const std::vector<double>& values) const {
    Bytes out;
    for (std::size_t i = 0; i < values.size(); ++i)
      put_pair(out, static_cast<std::uint32_t>(static_cast<std::int32_t>(
                        std::lround(values[i] / message.signals[i].scale))));
    put(out, counter_);
    Bytes sum{static_cast<std::uint8_t>(message.first_register),
              static_cast<std::uint8_t>(message.first_register >> 8), 0, 0};
    sum.insert(sum.end(), out.begin(), out.end());
    put_pair(out, crc(sum));
    return out;
  }

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

  void write(Kind kind, const std::vector<double>& values) {
    const auto& message = *layout_.find(kind);
    const Bytes words = block(message, values);
    Bytes pdu{16};
    put(pdu, message.first_register);
    put(pdu, static_cast<std::uint32_t>(words.size() / 2));
    pdu.push_back(static_cast<std::uint8_t>(words.size()));
    pdu.insert(pdu.end(), words.begin(), words.end());
    ask(pdu);
  }

  void read_status() {
    Bytes pdu{3};
    put(pdu, layout_.find(Kind::kStatus)->first_register);
    put(pdu, 2);
    const Bytes said = ask(pdu);  // number of bytes, then the pair of the state
    if (said.size() != 5) return;
    state = layout_.word_order == drivers::ByteOrder::kBig ? said[4] : said[2];
  }

  void beat() {
    const auto next = std::chrono::steady_clock::now() + std::chrono::milliseconds(4);
    if (dial()) {
      const Transformd X_BA = arm_.forward(q_);
      const Vector3 r = rotation_vector(X_BA.R);
      const double shift = another_tool ? 0.02 : 0.0;
      const std::vector<double> pose{X_BA.p(0), X_BA.p(1), X_BA.p(2), r(0), r(1), r(2)};
      std::vector<double> shown = pose;
      shown[2] += shift;
      const unsigned flags = 1 + 2 + 8 + (acknowledge ? 16 : 0);
      write(Kind::kController, {static_cast<double>(flags), 0, 0, 0});
      write(Kind::kRobot, {static_cast<double>(robot_)});
      write(Kind::kJoints, q_);
      write(Kind::kActual, shown);
      write(Kind::kTarget, pose);
      read_status();
      ++counter_;
      phase_ += 0.005;
      for (std::size_t i = 0; i < q_.size(); ++i) q_[i] = rest_[i] + 0.3 * std::sin(phase_);
    }
    std::this_thread::sleep_until(next);
  }

  std::uint16_t port_;
  Chain arm_;
  std::uint32_t robot_;
  drivers::BusLayout layout_ = drivers::default_layout(6, 0.004);
  int socket_ = -1;
  std::uint16_t counter_ = 0;
  double phase_ = 0.0;
  std::vector<double> rest_{0.3, -1.0, 1.2, -0.4, 1.1, 0.2};
  std::vector<double> q_ = rest_;
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

}  // namespace plumb::tests

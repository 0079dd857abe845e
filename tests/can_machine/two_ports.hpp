// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <tuple>
#include <vector>

#include "plumb/drivers/can_port.hpp"
#include "plumb/drivers/time_source.hpp"

namespace plumb::tests {

using namespace plumb::drivers;

inline constexpr std::int64_t kMs = 1'000'000;

inline std::int64_t now_ns() { return MonotonicTime::now_ns(); }
inline void wait_ms(int ms) { ::usleep(static_cast<useconds_t>(ms) * 1000); }

/// For printf, whatever the width of long.
inline unsigned long long wide(std::uint64_t count) { return count; }

/// A command of the machine that must succeed.
inline void must(const std::string& command) {
  ASSERT_EQ(std::system((command + " 2>&1").c_str()), 0) << command;
}
inline void may(const std::string& command) {
  std::ignore = std::system((command + " > /dev/null 2>&1").c_str());
}

inline BusLayout layout_of(CanFrame::Format format, double cycle_s = 0.001) {
  BusLayout out = default_layout(6, cycle_s);
  out.can_format = format;
  return out;
}

/// plumb-rt on `left`, the controller on `right`, and a cable (vxcan) between them. The controller
/// sends targets in which every value tells which one it is.
class TwoPorts {
 public:
  static constexpr int kMost = 20'000;  // targets in a test

  explicit TwoPorts(CanFrame::Format format) : layout_(layout_of(format)), sent_ns_(kMost, 0) {
    may("ip link del left");
    must("ip link add left type vxcan peer name right");
    must("ip link set left mtu 72 up && ip link set right mtu 72 up");
    open(plumb_, "left", Sender::kPlumb);
    open(controller_, "right", Sender::kController);
  }
  ~TwoPorts() { may("ip link del left"); }

  CanPort& plumb() { return *plumb_; }
  CanPort& controller() { return *controller_; }
  const BusLayout& layout() const { return layout_; }
  int next() const { return next_; }
  int last_heard() const { return last_heard_; }
  int heard() const { return heard_; }

  static double value(int k, std::size_t i) { return 1e-6 * (k + 1000.0 * static_cast<double>(i)); }

  bool send_target() {
    BusMessage message{.kind = MessageKind::kTarget, .size = 6};
    message.counter = static_cast<std::uint16_t>(next_);
    for (std::size_t i = 0; i < 6; ++i) message.values[i] = value(next_, i);
    sent_ns_[static_cast<std::size_t>(next_++)] = now_ns();
    return controller().send(message);
  }

  bool send_status() {
    BusMessage message{.kind = MessageKind::kStatus, .size = 7};
    message.values.fill(0.0);
    return plumb().send(message);
  }

  /// Takes all that is there, and checks of each: of one piece, newer than the one before, and its
  /// time neither before it was sent nor after now. Returns how many.
  int take_all() {
    BusMessage message;
    int count = 0;
    while (plumb().receive(message)) {
      if (message.kind != MessageKind::kTarget) continue;
      check(message);
      ++count;
    }
    return count;
  }

  /// `count` targets, one a millisecond.
  void run(int count) {
    for (int i = 0; i < count; ++i) {
      send_target();
      wait_ms(1);
      take_all();
    }
  }

  /// Both sides go on until a target arrives; how long that took [ms], -1 if it took too long.
  double recovery_ms(int limit_ms = 3000) {
    const std::int64_t begin_ns = now_ns();
    const int first = next_;
    while (now_ns() - begin_ns < limit_ms * kMs) {
      send_target();
      send_status();
      wait_ms(1);
      take_all();
      if (last_heard_ >= first && plumb().state() == LinkState::kUp)
        return 1e-6 * static_cast<double>(now_ns() - begin_ns);
    }
    return -1.0;
  }

 private:
  void open(std::optional<CanPort>& port, const char* interface, Sender self) const {
    CanPortOpening opening = CanPort::open(interface, layout_, self);
    ASSERT_TRUE(opening.port) << describe(opening.step).why;
    port.emplace(std::move(*opening.port));
  }

  void check(const BusMessage& message) {
    ++heard_;
    const int k = static_cast<int>(std::lround(1e6 * message.values[0]));
    ASSERT_TRUE(k >= 0 && k < next_) << k;
    for (std::size_t i = 0; i < 6; ++i) ASSERT_NEAR(message.values[i], value(k, i), 1e-9);
    EXPECT_GT(k, last_heard_) << "an old target after a newer one, or one twice";
    EXPECT_LE(message.time_ns, now_ns());
    if (!date_was_set) {
      EXPECT_GE(message.time_ns, sent_ns_[static_cast<std::size_t>(k)] - kMs);
    }
    last_heard_ = k;
  }

 public:
  bool date_was_set = false;  // then a target is as old as can be

 private:
  BusLayout layout_;
  std::optional<CanPort> plumb_;
  std::optional<CanPort> controller_;
  std::vector<std::int64_t> sent_ns_;
  int next_ = 0;
  int last_heard_ = -1;
  int heard_ = 0;
};

}  // namespace plumb::tests

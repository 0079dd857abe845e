// SPDX-License-Identifier: Apache-2.0
// The states of a CAN controller, told by an adapter that we play: slcan on a pseudo terminal. Run
// by tests/can_machine/can_faults.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/tty.h>
#include <net/if.h>
#include <poll.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <termios.h>

#include "tests/can_machine/two_ports.hpp"

namespace plumb::tests {
namespace {

/// The far end of a serial line whose near end the kernel takes for an adapter: interface adapter0.
class Adapter {
 public:
  Adapter() {
    termios raw{};
    ::cfmakeraw(&raw);
    EXPECT_EQ(::openpty(&far_, &near_, nullptr, &raw, nullptr), 0);
    const int discipline = N_SLCAN;
    EXPECT_EQ(::ioctl(near_, TIOCSETD, &discipline), 0) << errno;
    char name[IFNAMSIZ] = {};
    EXPECT_EQ(::ioctl(near_, SIOCGIFNAME, name), 0);
    must(std::string("ip link set ") + name + " name adapter0");
    must("ip link set adapter0 up");
    wait_ms(50);
    std::ignore = heard();
  }
  ~Adapter() {
    ::close(far_);
    ::close(near_);
  }
  Adapter(const Adapter&) = delete;
  Adapter& operator=(const Adapter&) = delete;

  void say(const std::string& line) const {
    EXPECT_EQ(::write(far_, line.c_str(), line.size()), static_cast<ssize_t>(line.size()));
    wait_ms(100);  // the kernel takes it up in its own time
  }

  /// What the kernel wrote to the adapter.
  std::string heard() const {
    std::string out;
    std::array<char, 256> part{};
    pollfd ready{.fd = far_, .events = POLLIN, .revents = 0};
    while (::poll(&ready, 1, 100) > 0) {
      const ssize_t size = ::read(far_, part.data(), part.size());
      if (size <= 0) break;
      out.append(part.data(), static_cast<std::size_t>(size));
    }
    return out;
  }

 private:
  int far_ = -1;
  int near_ = -1;
};

/// In ASCII, as an adapter says it: t, identifier, length, data.
std::string line_of(const CanFrame& frame) {
  char text[32];
  std::snprintf(text, sizeof(text), "t%03X%d", frame.id, frame.length);
  std::string out = text;
  for (std::size_t i = 0; i < frame.length; ++i) {
    std::snprintf(text, sizeof(text), "%02X", frame.data[i]);
    out += text;
  }
  return out + "\r";
}

class WithAnAdapter : public testing::Test {
 protected:
  WithAnAdapter() : layout(layout_of(CanFrame::Format::kClassic)) {
    CanPortOpening opening = CanPort::open("adapter0", layout, Sender::kPlumb);
    EXPECT_TRUE(opening.port) << describe(opening.step).why;
    port.emplace(std::move(opening.port.value()));
  }

  LinkState state_after(const std::string& line) {
    adapter.say(line);
    receive();
    return port->state();
  }
  int receive() {
    int count = 0;
    while (port->receive(message)) ++count;
    return count;
  }
  bool send() {
    BusMessage status{.kind = MessageKind::kSignature, .size = 2};
    status.values.fill(1.0);
    return port->send(status);
  }
  std::string robot(std::uint16_t counter) {
    CanCodec codec(layout);
    BusMessage out{.kind = MessageKind::kRobot, .size = 1, .counter = counter};
    out.values[0] = 5.0;
    return line_of(codec.encode(out)[0]);
  }

  Adapter adapter;
  BusLayout layout;
  std::optional<CanPort> port;
  BusMessage message;
};

TEST_F(WithAnAdapter, FramesGoBothWays) {
  EXPECT_TRUE(send());
  EXPECT_EQ(adapter.heard().substr(0, 11), "t1608010000");  // 0x160, 8 bytes, 1 as int24
  adapter.say(robot(1));
  EXPECT_EQ(receive(), 1);
  EXPECT_EQ(message.values[0], 5.0);
}

TEST_F(WithAnAdapter, ErrorStatesAreFollowed) {
  EXPECT_EQ(state_after("sw100096\r"), LinkState::kDegraded);
  EXPECT_EQ(state_after("sp128130\r"), LinkState::kDegraded);
  EXPECT_EQ(state_after("sa000000\r"), LinkState::kUp);
  const auto& errors = port->link().errors();
  EXPECT_EQ(errors.warnings, 1U);
  EXPECT_EQ(errors.passives, 1U);
  EXPECT_EQ(errors.bus_offs, 0U);
}

TEST_F(WithAnAdapter, BusOffIsDownAndNothingIsQueuedUntilTheRestart) {
  EXPECT_EQ(state_after("sb000256\r"), LinkState::kDown);
  EXPECT_EQ(port->link().errors().bus_offs, 1U);
  std::ignore = adapter.heard();
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(send());
  EXPECT_EQ(port->counters().not_sent, 20U);
  EXPECT_EQ(adapter.heard(), "");
  // the way out that always works: down and up
  const std::int64_t begin_ns = now_ns();
  must("ip link set adapter0 down && ip link set adapter0 up");
  bool sent = false;
  while (!sent && now_ns() - begin_ns < 2000 * kMs) {
    receive();
    sent = send();
    wait_ms(1);
  }
  std::printf("bus-off, then down and up: sent again after %.1f ms\n",
              1e-6 * static_cast<double>(now_ns() - begin_ns));
  EXPECT_TRUE(sent);
  EXPECT_EQ(port->state(), LinkState::kUp);
  EXPECT_NE(adapter.heard().find("t160"), std::string::npos);
}

/// The kernel tells of a lost carrier up to a second late if another change came just before.
TEST_F(WithAnAdapter, ASecondBusOffWithinASecondIsDownToo) {
  EXPECT_EQ(state_after("sb000256\r"), LinkState::kDown);
  wait_ms(1500);
  EXPECT_FALSE(send());
  must("ip link set adapter0 down && ip link set adapter0 up");
  receive();
  EXPECT_TRUE(send());
  EXPECT_EQ(state_after("sb000256\r"), LinkState::kDown);
  std::ignore = adapter.heard();
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(send());
  EXPECT_EQ(adapter.heard(), "");
  EXPECT_EQ(port->state(), LinkState::kDown);
}

TEST_F(WithAnAdapter, AFrameFromTheWireEndsBusOff) {
  EXPECT_EQ(state_after("sb000256\r"), LinkState::kDown);
  adapter.say("sa000000\r");
  adapter.say(robot(2));
  EXPECT_EQ(receive(), 1);
  EXPECT_EQ(port->state(), LinkState::kUp);
}

TEST_F(WithAnAdapter, NonsenseFromTheAdapterDoesNoHarm) {
  for (const char* line : {"t1\r", "tFFF8\r", "t1189001122\r", "s\r", "e9xyz\r", "T118\r", "\r\r"})
    adapter.say(line);
  EXPECT_EQ(receive(), 0);
  EXPECT_EQ(port->counters().received, 0U);
  EXPECT_EQ(port->state(), LinkState::kUp);
}

}  // namespace
}  // namespace plumb::tests

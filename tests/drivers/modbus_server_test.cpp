// SPDX-License-Identifier: Apache-2.0
// Whom a server lets in, for how long, and when it hangs up.
#include "plumb/drivers/modbus_server.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <vector>

#include "tests/drivers/modbus_support.hpp"

using namespace plumb::drivers;
using plumb::tests::seconds_since;
using plumb::tests::soon;
using Bytes = std::vector<std::uint8_t>;
using Clock = std::chrono::steady_clock;

namespace {

const Bytes kRead{0, 7, 0, 0, 0, 6, 1, 3, 0x04, 0xF8, 0, 1};  // one register of the signature
const Bytes kAnswer{0, 7, 0, 0, 0, 5, 1, 3, 2, 0, 0};

/// A peer made of plain system calls.
class Peer {
 public:
  explicit Peer(std::uint16_t port, const char* from = "127.0.0.1") {
    const auto here = *socket_address(from, 0), there = *socket_address("127.0.0.1", port);
    socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    EXPECT_EQ(::bind(socket_, here.get(), here.size), 0);
    EXPECT_EQ(::connect(socket_, there.get(), there.size), 0);
  }
  ~Peer() { ::close(socket_); }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  bool send(const Bytes& bytes) const {
    return ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL) ==
           static_cast<ssize_t>(bytes.size());
  }

  /// What comes next; empty: the server hung up, or said nothing for `patience_ms`.
  Bytes receive(int patience_ms = 3000) const {
    pollfd event{socket_, POLLIN, 0};
    if (::poll(&event, 1, patience_ms) != 1) return {};
    Bytes out(300);
    const ssize_t got = ::recv(socket_, out.data(), out.size(), 0);
    out.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    return out;
  }

  bool hung_up_on() const {
    pollfd event{socket_, POLLIN, 0};
    if (::poll(&event, 1, 3000) != 1) return false;
    char byte = 0;
    return ::recv(socket_, &byte, 1, 0) <= 0;
  }

 private:
  int socket_ = -1;
};

ModbusServerSettings brisk() {
  return {.at = TcpAddress{"127.0.0.1", 0},
          .peers = {"127.0.0.1", "127.0.0.2"},
          .most_connections = 2,
          .request_timeout_s = 0.1,
          .idle_timeout_s = 0.4};
}

class Started {
 public:
  explicit Started(const ModbusServerSettings& settings)
      : server(default_layout(6, 0.001), settings) {
    const auto fault = server.start();
    EXPECT_FALSE(fault) << fault->what;
  }
  const ModbusCounters& counters() { return server.exchange().counters; }
  ModbusServer server;
};

}  // namespace

TEST(ModbusServer, AnswersWithTheTransactionAndUnitOfTheRequest) {
  Started s(brisk());
  const Peer peer(s.server.port());
  for (int number : {1, 0, 255}) {
    const auto unit = static_cast<std::uint8_t>(number);
    Bytes request = kRead, answer = kAnswer;
    request[6] = answer[6] = unit;
    ASSERT_TRUE(peer.send(request));
    EXPECT_EQ(peer.receive(), answer) << number;
  }
  Bytes request = kRead;
  request[6] = 2;
  ASSERT_TRUE(peer.send(request));
  EXPECT_EQ(peer.receive(), (Bytes{0, 7, 0, 0, 0, 3, 2, 0x83, 11}));
}

TEST(ModbusServer, LetsInOnlyThosePeersThatItIsTold) {
  auto settings = brisk();
  settings.peers = {"127.0.0.3", "10.0.0.1"};
  Started told(settings);
  const Peer known(told.server.port(), "127.0.0.3");
  ASSERT_TRUE(known.send(kRead));
  EXPECT_EQ(known.receive(), kAnswer);
  const Peer foreign(told.server.port(), "127.0.0.2");
  EXPECT_TRUE(foreign.hung_up_on());
  EXPECT_EQ(told.counters().foreign_peers, 1U);
  ASSERT_TRUE(known.send(kRead));
  EXPECT_EQ(known.receive(), kAnswer) << "which does not disturb the others";
}

TEST(ModbusServer, TakesNoMoreConnectionsThanItIsTold) {
  Started s(brisk());
  const Peer first(s.server.port()), second(s.server.port()), third(s.server.port());
  EXPECT_TRUE(third.hung_up_on());
  EXPECT_EQ(s.counters().crowded_out, 1U);
  ASSERT_TRUE(first.send(kRead));
  EXPECT_EQ(first.receive(), kAnswer);
}

constexpr std::uint8_t kBusyCode = 6;

/// Writes a register of message robot, and what comes back of it: 0 or the code of an exception.
int written(const Peer& peer) {
  const Bytes request{0, 7, 0, 0, 0, 6, 1, 6, 0x04, 0x58, 0, 1};
  EXPECT_TRUE(peer.send(request));
  const Bytes answer = peer.receive();
  if (answer == request) return 0;
  return answer.size() == 9 ? answer[8] : -1;
}

/// A controller that reconnects, as after a stall of ours or a cable that was off, cannot always
/// end its old connection first.
TEST(ModbusServer, AConnectionSupersedesAnEarlierOneOfItsHost) {
  Started s(brisk());
  const Peer half_open(s.server.port());
  ASSERT_EQ(written(half_open), 0);
  const Peer again(s.server.port());
  EXPECT_EQ(written(again), 0) << "at once, not when half a second is over";
  EXPECT_EQ(written(half_open), kBusyCode) << "a request that was on the way for long";
  EXPECT_EQ(written(again), 0);
  EXPECT_EQ(s.counters().foreign_senders, 0U);
  const Peer third(s.server.port());
  EXPECT_EQ(written(third), 0) << "its place was that of the one superseded";
}

TEST(ModbusServer, AConnectionThatWritesOnThoughItWasSupersededIsASecondSender) {
  Started s(brisk());
  const Peer one(s.server.port()), other(s.server.port());
  ASSERT_EQ(written(one), 0);
  ASSERT_EQ(written(other), 0);
  EXPECT_EQ(written(one), kBusyCode);
  EXPECT_EQ(written(one), kBusyCode);
  EXPECT_EQ(s.counters().foreign_senders, 1U);
}

TEST(ModbusServer, AnotherHostSupersedesNobody) {
  Started s(brisk());
  const Peer one(s.server.port(), "127.0.0.1"), other(s.server.port(), "127.0.0.2");
  ASSERT_EQ(written(one), 0);
  EXPECT_EQ(written(other), kBusyCode);
  EXPECT_EQ(s.counters().foreign_senders, 1U);
}

TEST(ModbusServer, HangsUpOnARequestThatDripsHoweverSteadily) {
  Started s(brisk());
  const Peer peer(s.server.port());
  const auto begin = Clock::now();
  for (std::size_t i = 0; i < kRead.size() && peer.send({kRead[i]}); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
  EXPECT_TRUE(peer.hung_up_on());
  EXPECT_LT(seconds_since(begin), 2.0);
  EXPECT_EQ(s.counters().timeouts, 1U);
  EXPECT_EQ(s.counters().transactions, 0U);
}

TEST(ModbusServer, HangsUpOnSilence) {
  Started s(brisk());
  const Peer peer(s.server.port());
  const auto begin = Clock::now();
  EXPECT_TRUE(peer.hung_up_on());
  EXPECT_GT(seconds_since(begin), 0.3);
  EXPECT_EQ(s.counters().timeouts, 1U);
}

TEST(ModbusServer, HangsUpOnBytesThatAreNoModbus) {
  Started s(brisk());
  const Peer peer(s.server.port());
  ASSERT_TRUE(peer.send({'G', 'E', 'T', ' ', '/'}));
  EXPECT_TRUE(peer.hung_up_on());
  EXPECT_EQ(s.counters().bad_frames, 1U);
}

/// Its answers would fill the server's memory, or hold it up.
TEST(ModbusServer, HangsUpOnAPeerThatDoesNotTakeItsAnswers) {
  Started s(brisk());
  {
    const Peer peer(s.server.port());
    Bytes many;
    for (int i = 0; i < 100; ++i)
      for (int byte : {0, 7, 0, 0, 0, 6, 1, 3, 3, 0xE8, 0, 125})
        many.push_back(static_cast<std::uint8_t>(byte));
    const auto begin = Clock::now();
    while (seconds_since(begin) < 5 && peer.send(many)) continue;
    EXPECT_LT(seconds_since(begin), 5.0);
  }
  EXPECT_TRUE(soon([&] { return s.counters().disconnects == 1U; }));
  const Peer next(s.server.port());
  ASSERT_TRUE(next.send(kRead));
  EXPECT_EQ(next.receive(), kAnswer);
}

TEST(ModbusServer, BindsToAnInterfaceByName) {
  auto settings = brisk();
  settings.at = TcpAddress{"lo", 0};
  ModbusServer server(default_layout(6, 0.001), settings);
  if (const auto fault = server.start()) {
    EXPECT_EQ(fault->error, EPERM) << fault->what;
    GTEST_SKIP() << fault->what;
  }
  const Peer peer(server.port());
  ASSERT_TRUE(peer.send(kRead));
  EXPECT_EQ(peer.receive(), kAnswer);
}

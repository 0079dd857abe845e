// SPDX-License-Identifier: Apache-2.0
// Client and server against each other, over TCP on this machine and over a serial cable.
#include <dirent.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <fstream>
#include <optional>

#include "plumb/drivers/modbus_client.hpp"
#include "plumb/drivers/modbus_port.hpp"
#include "plumb/drivers/modbus_server.hpp"
#include "tests/drivers/modbus_support.hpp"
#include "tests/drivers/pty_pair.hpp"

using namespace plumb::drivers;
using namespace std::chrono_literals;
using plumb::tests::is_lawful;
using plumb::tests::lawful;
using plumb::tests::PtyPair;
using plumb::tests::seconds_since;
using plumb::tests::soon;
using Clock = std::chrono::steady_clock;

namespace {

/// A cycle's end of a link: sends lawful messages, hears others, and counts what is not lawful.
class Talker {
 public:
  Talker(ModbusExchange& exchange, const BusLayout& layout, Sender self)
      : layout_(&layout), port(exchange, layout, self), self_(self) {}

  void cycle() {
    ++counter;
    for (const auto& message : layout_->messages)
      if (message.sender == self_ && message.kind != silent)
        port.send(lawful(*layout_, message.kind, counter));
    BusMessage heard_now;
    while (port.receive(heard_now)) {
      if (!is_lawful(*layout_, heard_now)) ++unlawful;
      last[static_cast<std::size_t>(heard_now.kind)] = heard_now;
      ++heard;
    }
  }

  const std::optional<BusMessage>& newest(MessageKind kind) const {
    return last[static_cast<std::size_t>(kind)];
  }

 private:
  const BusLayout* layout_;

 public:
  ModbusPort port;
  std::optional<MessageKind> silent;  // is not sent
  std::uint16_t counter = 0;
  int heard = 0;
  int unlawful = 0;
  std::array<std::optional<BusMessage>, kMessageKinds> last;

 private:
  Sender self_;
};

bool all_of_the_other_side_heard(const BusLayout& layout, const Talker& talker, Sender other) {
  return std::all_of(layout.messages.begin(), layout.messages.end(), [&](const auto& message) {
    return message.sender != other || talker.newest(message.kind);
  });
}

std::string words(const std::optional<LinkFault>& fault) {
  return fault ? fault->key + ": " + fault->what + "; " + fault->help : "started";
}

/// Both sides in this process; each may be plumb-rt.
class Pair {
 public:
  Pair(const BusLayout& used, ModbusServerSettings at, ModbusClientSettings to, Sender client_is)
      : layout(used),
        server(layout,
               with_self(at, client_is == Sender::kPlumb ? Sender::kController : Sender::kPlumb)),
        fault(server.start()),
        client(layout, with_server(with_self(to, client_is), server.port())),
        near(client.exchange(), layout, client_is),
        far(server.exchange(), layout,
            client_is == Sender::kPlumb ? Sender::kController : Sender::kPlumb) {}

  template <class Settings>
  static Settings with_self(Settings settings, Sender self) {
    settings.self = self;
    return settings;
  }
  static ModbusClientSettings with_server(ModbusClientSettings settings, std::uint16_t port) {
    if (auto* tcp = std::get_if<TcpAddress>(&settings.server)) tcp->port = port;
    return settings;
  }

  void cycle() {
    near.cycle();
    far.cycle();
  }

  BusLayout layout;
  ModbusServer server;
  std::optional<LinkFault> fault;
  ModbusClient client;
  Talker near, far;
};

const ModbusServerSettings kAnyPort{.at = TcpAddress{.host = "127.0.0.1", .port = 0}};

void expect_talk(Pair& pair, Sender client_is) {
  const Sender other = client_is == Sender::kPlumb ? Sender::kController : Sender::kPlumb;
  ASSERT_FALSE(pair.fault) << words(pair.fault);
  const auto fault = pair.client.start();
  ASSERT_FALSE(fault) << words(fault);
  EXPECT_TRUE(soon([&] {
    pair.cycle();
    return all_of_the_other_side_heard(pair.layout, pair.near, other) &&
           all_of_the_other_side_heard(pair.layout, pair.far, client_is) && pair.near.heard > 100;
  }));
  EXPECT_EQ(pair.near.unlawful, 0);
  EXPECT_EQ(pair.far.unlawful, 0);
  EXPECT_EQ(pair.near.port.state(), LinkState::kUp);
  EXPECT_EQ(pair.far.port.state(), LinkState::kUp);
  EXPECT_EQ(pair.client.exchange().counters.corrupt, 0U);
  EXPECT_EQ(pair.client.exchange().counters.foreign_senders, 0U);
}

}  // namespace

class ModbusLink : public testing::TestWithParam<Sender> {};
INSTANTIATE_TEST_SUITE_P(BothRoles, ModbusLink,
                         testing::Values(Sender::kPlumb, Sender::kController));

TEST_P(ModbusLink, CarriesEveryMessageOverTcp) {
  Pair pair(default_layout(6, 0.001), kAnyPort, {}, GetParam());
  expect_talk(pair, GetParam());
}

TEST_P(ModbusLink, CarriesEveryMessageOverASerialCable) {
  PtyPair cable;
  const ModbusServerSettings at{.at = SerialLine{.device = cable.device(0)}};
  ModbusClientSettings to{.server = SerialLine{.device = cable.device(1)}};
  Pair pair(default_layout(6, 0.01), at, to, GetParam());
  expect_talk(pair, GetParam());
}

TEST_P(ModbusLink, CarriesTheOtherWordOrderAndSevenJoints) {
  BusLayout layout = default_layout(7, 0.002, 2);
  layout.word_order = ByteOrder::kLittle;
  Pair pair(layout, kAnyPort, {}, GetParam());
  expect_talk(pair, GetParam());
}

/// Shared machines stall: the best of several seconds counts.
TEST(ModbusLinkRate, RunsAThousandCyclesASecondOnOneMachine) {
  ModbusClientSettings to;
  to.poll_period_s = 100e-6;
  Pair pair(default_layout(6, 0.001), kAnyPort, to, Sender::kPlumb);
  ASSERT_FALSE(pair.client.start());
  double best = 0;
  double best_requests = 0;
  for (int attempt = 0; attempt < 5 && best < 1000; ++attempt) {
    const auto begin = Clock::now();
    const std::uint64_t requests = pair.client.exchange().counters.transactions;
    int round_trips = 0;  // a target that came, and its answer that arrived
    std::uint16_t answered = 0;
    while (seconds_since(begin) < 1.0) {
      pair.far.cycle();
      const std::uint16_t asked = pair.far.counter;
      soon(
          [&] {
            BusMessage target;
            while (pair.near.port.receive(target))
              if (target.kind == MessageKind::kTarget)
                pair.near.port.send(lawful(pair.layout, MessageKind::kCorrected, target.counter));
            while (pair.far.port.receive(target))
              if (target.kind == MessageKind::kCorrected) answered = target.counter;
            return answered == asked;
          },
          100ms);
      if (answered == asked) ++round_trips;
    }
    best = std::max(best, round_trips / seconds_since(begin));
    best_requests =
        std::max(best_requests,
                 static_cast<double>(pair.client.exchange().counters.transactions - requests) /
                     seconds_since(begin));
  }
  std::printf("%.0f round trips/s, %.0f requests/s\n", best, best_requests);
  EXPECT_GE(best_requests, 1000);
  EXPECT_GE(best, 1000);
}

/// A controller need not send every message of the layout, and comes when it comes.
void expect_clean_without(MessageKind kind, Pair& pair) {
  ASSERT_FALSE(pair.fault) << words(pair.fault);
  pair.far.silent = kind;
  ASSERT_TRUE(soon([&] {
    pair.cycle();
    return pair.near.heard > 200;
  }));
  EXPECT_FALSE(pair.near.newest(kind));
  EXPECT_EQ(pair.near.port.state(), LinkState::kUp);
  EXPECT_EQ(pair.near.port.counters().corrupt, 0U);
  EXPECT_EQ(pair.near.port.counters().reconnects, 0U);
}

TEST(ModbusLinkFaults, AMessageThatIsNeverSentIsNotTakenForACorruptOne) {
  BusLayout layout = default_layout(6, 0.001);
  for (auto& message : layout.messages) message.period_s = 0.001;
  Pair pair(layout, kAnyPort, {}, Sender::kPlumb);
  ASSERT_FALSE(pair.client.start());
  expect_clean_without(MessageKind::kContext, pair);
}

TEST(ModbusLinkFaults, OnASerialCableWaitingForTheFirstAnswerIsNoReconnection) {
  PtyPair cable;
  const ModbusServerSettings at{.at = SerialLine{.device = cable.device(0)}};
  ModbusClientSettings to{.server = SerialLine{.device = cable.device(1)},
                          .response_timeout_s = 0.2};
  cable.cut();
  Pair pair(default_layout(6, 0.004), at, to, Sender::kPlumb);
  ASSERT_FALSE(pair.client.start());
  ASSERT_TRUE(soon([&] { return pair.client.exchange().counters.timeouts >= 3U; }));
  EXPECT_EQ(pair.client.exchange().counters.connects, 0U);
  cable.mend();
  expect_clean_without(MessageKind::kContext, pair);
}

TEST(ModbusLinkFaults, WhatTheServerWithdrewAsOldIsNotTakenForCorrupt) {
  BusLayout layout = default_layout(6, 0.001);
  for (auto& message : layout.messages) message.period_s = 0.001;
  Pair pair(layout, kAnyPort, {}, Sender::kPlumb);
  ASSERT_FALSE(pair.fault) << words(pair.fault);
  ASSERT_FALSE(pair.client.start());
  ASSERT_TRUE(soon([&] {
    pair.cycle();
    return pair.near.heard > 50;
  }));
  ASSERT_TRUE(soon([&] { return pair.server.exchange().counters.stale > 3U; }));
  const std::uint64_t before = pair.client.exchange().counters.transactions;
  ASSERT_TRUE(soon([&] { return pair.client.exchange().counters.transactions > before + 10; }));
  EXPECT_EQ(pair.client.exchange().counters.corrupt, 0U);
}

TEST(ModbusLinkFaults, APeerThatGoesAndComesBackIsFoundAgain) {
  const BusLayout layout = default_layout(6, 0.001);
  auto server =
      std::make_unique<ModbusServer>(layout, Pair::with_self(kAnyPort, Sender::kController));
  ASSERT_FALSE(server->start());
  const std::uint16_t port = server->port();
  ModbusClient client(layout, {.server = TcpAddress{"127.0.0.1", port}});
  ASSERT_FALSE(client.start());
  Talker near(client.exchange(), layout, Sender::kPlumb);
  for (int turn = 0; turn < 3; ++turn) {
    Talker far(server->exchange(), layout, Sender::kController);
    const int before = near.heard;
    const auto begin = Clock::now();
    ASSERT_TRUE(soon([&] {
      far.cycle();
      near.cycle();
      return near.heard > before + 20;
    }));
    std::printf("back after %.0f ms\n", 1e3 * seconds_since(begin));
    EXPECT_LT(seconds_since(begin), 3.0);
    server.reset();
    ASSERT_TRUE(soon([&] { return near.port.state() == LinkState::kDown; }));
    EXPECT_FALSE(near.port.send(lawful(layout, MessageKind::kCorrected, 1)));
    server = std::make_unique<ModbusServer>(
        layout,
        ModbusServerSettings{.at = TcpAddress{"127.0.0.1", port}, .self = Sender::kController});
    std::this_thread::sleep_for(300ms);
    const auto fault = server->start();
    ASSERT_FALSE(fault) << words(fault);
  }
  EXPECT_EQ(near.unlawful, 0);
  EXPECT_GE(near.port.counters().reconnects, 2U);
}

TEST(ModbusLinkFaults, WhatWaitedWhileThePeerWasGoneIsNotWrittenWhenItComesBack) {
  const BusLayout layout = default_layout(6, 0.001);
  ModbusServer server(layout, Pair::with_self(kAnyPort, Sender::kController));
  ASSERT_FALSE(server.start());
  ModbusClient client(layout, {.server = TcpAddress{"127.0.0.1", server.port()}});
  ModbusPort port(client.exchange(), layout, Sender::kPlumb);
  EXPECT_FALSE(port.send(lawful(layout, MessageKind::kCorrected, 77)));  // not even started
  std::this_thread::sleep_for(150ms);
  ASSERT_FALSE(client.start());
  ASSERT_TRUE(
      soon([&] { return port.state() == LinkState::kUp || port.state() == LinkState::kDegraded; }));
  ASSERT_TRUE(soon([&] { return client.exchange().counters.stale == 1U; }));
  Talker far(server.exchange(), layout, Sender::kController);
  far.cycle();
  EXPECT_FALSE(far.newest(MessageKind::kCorrected));
}

TEST(ModbusLinkFaults, ACutCableIsSeenAndMended) {
  PtyPair cable;
  const ModbusServerSettings at{.at = SerialLine{.device = cable.device(0)}};
  ModbusClientSettings to{.server = SerialLine{.device = cable.device(1)}};
  Pair pair(default_layout(6, 0.01), at, to, Sender::kPlumb);
  ASSERT_FALSE(pair.fault) << words(pair.fault);
  ASSERT_FALSE(pair.client.start());
  const auto talks = [&](int more) {
    const int goal = pair.near.heard + more;
    return soon([&] {
      pair.cycle();
      return pair.near.heard >= goal;
    });
  };
  ASSERT_TRUE(talks(20));
  cable.cut();
  ASSERT_TRUE(soon([&] {
    pair.cycle();
    return pair.near.port.state() == LinkState::kDown;
  }));
  cable.mend();
  ASSERT_TRUE(talks(20));
  EXPECT_EQ(pair.near.unlawful, 0);
  EXPECT_EQ(pair.far.unlawful, 0);
}

TEST(ModbusLinkFaults, TwoClientsThatWriteTheSameRegistersAreNotBothServed) {
  const BusLayout layout = default_layout(6, 0.001);
  ModbusServer server(layout, Pair::with_self(kAnyPort, Sender::kController));
  ASSERT_FALSE(server.start());
  ModbusClient first(layout, {.server = TcpAddress{"127.0.0.1", server.port()}});
  ModbusClient second(layout, {.server = TcpAddress{"127.0.0.1", server.port()}});
  ASSERT_FALSE(first.start());
  ASSERT_FALSE(second.start());
  Talker a(first.exchange(), layout, Sender::kPlumb), b(second.exchange(), layout, Sender::kPlumb);
  EXPECT_TRUE(soon([&] {
    a.cycle();
    b.cycle();
    return server.exchange().counters.foreign_senders > 0;
  }));
}

TEST(ModbusThread, StopsSoonWhateverItWaitsFor) {
  const BusLayout layout = default_layout(6, 0.001);
  for (const char* host : {"127.0.0.1", "192.0.2.1"}) {  // refused; a documentation address
    ModbusClient client(layout, {.server = TcpAddress{host, 9}, .response_timeout_s = 5.0});
    ASSERT_FALSE(client.start());
    std::this_thread::sleep_for(50ms);
    const auto begin = Clock::now();
    client.stop();
    EXPECT_LT(seconds_since(begin), 1.0) << host;
  }
  ModbusServer server(layout, kAnyPort);
  ASSERT_FALSE(server.start());
  const auto begin = Clock::now();
  server.stop();
  EXPECT_LT(seconds_since(begin), 1.0);
}

TEST(ModbusThread, HasANameNoSignalsAndNoPriority) {
  ModbusServer server(default_layout(6, 0.001), kAnyPort);
  ASSERT_FALSE(server.start());
  bool found = false;
  DIR* tasks = ::opendir("/proc/self/task");
  ASSERT_NE(tasks, nullptr);
  ASSERT_TRUE(soon([&] {
    ::rewinddir(tasks);
    while (const dirent* entry = ::readdir(tasks)) {
      const std::string folder = std::string("/proc/self/task/") + entry->d_name;
      std::string name;
      std::getline(std::ifstream(folder + "/comm"), name);
      if (name != "plumb-modbus") continue;
      found = true;
      std::ifstream status(folder + "/status");
      for (std::string line; std::getline(status, line);)
        if (line.starts_with("SigBlk:")) {
          EXPECT_NE(line.find("fffffffe7ffbfeff"), std::string::npos) << line;
        }
    }
    return found;
  }));
  ::closedir(tasks);
}

TEST(ModbusStart, SaysWhatIsWrongBeforeAnythingIsSent) {
  const BusLayout layout = default_layout(6, 0.001);
  const auto server_fault = [&](ModbusServerSettings s) {
    return words(ModbusServer(layout, s).start());
  };
  const auto client_fault = [&](ModbusClientSettings s) {
    return words(ModbusClient(layout, s).start());
  };
  EXPECT_EQ(server_fault({.at = TcpAddress{"0.0.0.0", 0}}),
            "host: 0.0.0.0 would listen on every interface; name the interface or the address that "
            "the controller is on");
  EXPECT_NE(server_fault({.at = TcpAddress{"::", 0}}).find("every interface"), std::string::npos);
  EXPECT_EQ(server_fault({.at = TcpAddress{"0.0.0.0", 0},
                          .wildcard = ModbusServerSettings::Wildcard::kAllowed}),
            "started");
  EXPECT_NE(server_fault({.at = TcpAddress{"nosuch0", 0}}).find("neither an address nor"),
            std::string::npos);
  EXPECT_NE(server_fault({.at = TcpAddress{"192.0.2.1", 0}}).find("no address of this machine"),
            std::string::npos);
  ModbusServer first(layout, kAnyPort);
  ASSERT_FALSE(first.start());
  EXPECT_NE(server_fault({.at = TcpAddress{"127.0.0.1", first.port()}}).find("already"),
            std::string::npos);
  EXPECT_NE(server_fault({.peers = {"robot7"}}).find("in numbers"), std::string::npos);
  EXPECT_NE(client_fault({.server = TcpAddress{"robot7", 502}}).find("in numbers"),
            std::string::npos);
  EXPECT_NE(client_fault({.server = TcpAddress{"127.0.0.1", 0}}).find("port 0"), std::string::npos);
  EXPECT_NE(client_fault({.server = SerialLine{"/dev/nosuch"}}).find("cannot open /dev/nosuch"),
            std::string::npos);
  EXPECT_NE(client_fault({.server = SerialLine{"/dev/null"}}).find("not a serial device"),
            std::string::npos);
  EXPECT_NE(client_fault({.server = SerialLine{"/dev/null", 12345}}).find("12345 baud"),
            std::string::npos);
  EXPECT_NE(client_fault({.server = SerialLine{"/dev/null"}, .unit = 0}).find("reserved"),
            std::string::npos);
  EXPECT_NE(client_fault({.response_timeout_s = 0}).find("response_timeout"), std::string::npos);
}

/// libmodbus puts descriptors into an fd_set without looking, which ends the process.
TEST(ModbusClientDescriptors, OneBeyondFdSetSizeIsRefused) {
  rlimit limit{};
  ::getrlimit(RLIMIT_NOFILE, &limit);
  if (limit.rlim_max < FD_SETSIZE + 64) GTEST_SKIP() << "too few descriptors";
  limit.rlim_cur = FD_SETSIZE + 64;
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &limit), 0);
  ModbusServer server(default_layout(6, 0.001), kAnyPort);
  ASSERT_FALSE(server.start());
  ModbusClient client(default_layout(6, 0.001), {.server = TcpAddress{"127.0.0.1", server.port()}});
  std::vector<int> taken;
  while (taken.empty() || taken.back() < FD_SETSIZE) taken.push_back(::dup(0));
  ASSERT_FALSE(client.start());
  std::this_thread::sleep_for(100ms);
  EXPECT_EQ(client.exchange().state, LinkState::kDown);
  for (int descriptor : taken) ::close(descriptor);
  EXPECT_TRUE(soon([&] { return client.exchange().state != LinkState::kDown; }));
}

// SPDX-License-Identifier: Apache-2.0
// How a Modbus link starts, what its thread is, and how soon it stops.
#include <dirent.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <fstream>

#include "tests/drivers/modbus_pair.hpp"

namespace plumb::tests {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

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
  const std::vector<std::string> here{"127.0.0.1"};
  const auto server_fault = [&](ModbusServerSettings s) {
    return words(ModbusServer(layout, s).start());
  };
  const auto client_fault = [&](ModbusClientSettings s) {
    return words(ModbusClient(layout, s).start());
  };
  EXPECT_EQ(server_fault({.at = TcpAddress{"0.0.0.0", 0}, .peers = here}),
            "host: 0.0.0.0 would listen on every interface; name the interface or the address that "
            "the controller is on");
  EXPECT_NE(server_fault({.at = TcpAddress{"::", 0}, .peers = here}).find("every interface"),
            std::string::npos);
  EXPECT_EQ(server_fault({.at = TcpAddress{"0.0.0.0", 0},
                          .wildcard = ModbusServerSettings::Wildcard::kAllowed,
                          .peers = here}),
            "started");
  EXPECT_NE(
      server_fault({.at = TcpAddress{"nosuch0", 0}, .peers = here}).find("neither an address nor"),
      std::string::npos);
  EXPECT_NE(server_fault({.at = TcpAddress{"192.0.2.1", 0}, .peers = here})
                .find("no address of this machine"),
            std::string::npos);
  ModbusServer first(layout, kAnyPort);
  ASSERT_FALSE(first.start());
  EXPECT_NE(
      server_fault({.at = TcpAddress{"127.0.0.1", first.port()}, .peers = here}).find("already"),
      std::string::npos);
  EXPECT_NE(server_fault({.at = TcpAddress{"127.0.0.1", 0}}).find("peers: no peer is named"),
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

}  // namespace
}  // namespace plumb::tests

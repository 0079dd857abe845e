// SPDX-License-Identifier: Apache-2.0
// The service manager's side is a socket of the test; the protocol is that of sd_notify(3).
#include "rt/notify.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdlib>

#include "plumb/drivers/descriptor.hpp"
#include "plumb/drivers/time_source.hpp"
#include "program/scratch_folder.hpp"

namespace plumb::drivers::rt {
namespace {

class ServiceManagers : public testing::Test {
 protected:
  ~ServiceManagers() override {
    ::unsetenv("NOTIFY_SOCKET");
    ::unsetenv("WATCHDOG_USEC");
  }
  /// The manager's socket at a path, or under a name that begins with '@' and is no file.
  static Descriptor listen_at(const std::string& name) {
    Descriptor out(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    name.copy(address.sun_path, sizeof(address.sun_path) - 1);
    if (name.front() == '@') address.sun_path[0] = '\0';
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
    EXPECT_EQ(::bind(out.get(), reinterpret_cast<const sockaddr*>(&address), size), 0);
    ::setenv("NOTIFY_SOCKET", name.c_str(), 1);
    return out;
  }
  static std::string heard_at(const Descriptor& socket) {
    std::array<char, 512> text;
    const auto n = ::recv(socket.get(), text.data(), text.size(), 0);
    return n < 0 ? "nothing" : std::string(text.data(), static_cast<std::size_t>(n));
  }
  const ScratchFolder scratch{"plumb-notify-"};
};

TEST_F(ServiceManagers, WhatIsToldArrivesWholeAndInOrderAtAFileAndAtAName) {
  for (const std::string& name :
       {(scratch.path() / "notify").string(), "@plumb-notify-" + std::to_string(::getpid())}) {
    const Descriptor socket = listen_at(name);
    ServiceManager manager;
    manager.tell("READY=1");
    manager.tell("WATCHDOG=1\nSTATUS=active, mode full");
    EXPECT_EQ(heard_at(socket), "READY=1") << name;
    EXPECT_EQ(heard_at(socket), "WATCHDOG=1\nSTATUS=active, mode full");
    EXPECT_EQ(heard_at(socket), "nothing");
  }
}

/// The thread that tells also answers an operator.
TEST_F(ServiceManagers, AManagerThatReadsNothingOrHasGoneHoldsNobodyUp) {
  Descriptor socket = listen_at((scratch.path() / "notify").string());
  ServiceManager manager;
  const std::int64_t begin_ns = MonotonicTime::now_ns();
  for (int i = 0; i < 10'000; ++i) manager.tell("WATCHDOG=1");
  socket = Descriptor();
  for (int i = 0; i < 100; ++i) manager.tell("WATCHDOG=1");
  EXPECT_LT(MonotonicTime::now_ns() - begin_ns, 5'000'000'000);
}

TEST_F(ServiceManagers, WithoutAManagerNothingIsToldAndThatIsNoError) {
  for (const std::string& name : {std::string(), std::string("@"), std::string("/"),
                                  (scratch.path() / "missing").string(), std::string(200, 'x')}) {
    ::setenv("NOTIFY_SOCKET", name.c_str(), 1);
    ServiceManager manager;
    manager.tell("READY=1");
  }
  ::unsetenv("NOTIFY_SOCKET");
  ServiceManager().tell("READY=1");
}

TEST_F(ServiceManagers, TheSocketIsNotLeftToAProgramThatIsStarted) {
  const Descriptor socket = listen_at((scratch.path() / "notify").string());
  const int free = Descriptor(::dup(0)).get();  // the number that the next descriptor gets
  const ServiceManager manager;
  EXPECT_NE(::fcntl(free, F_GETFD) & FD_CLOEXEC, 0);
}

TEST_F(ServiceManagers, TheWatchdogIsHalfOfWhatTheManagerSaysAndNoneIfThatIsNoTime) {
  for (const std::int64_t us : {2LL, 1'000LL, 30'000'000LL, 9'000'000'000'000'000LL}) {
    ::setenv("WATCHDOG_USEC", std::to_string(us).c_str(), 1);
    EXPECT_EQ(ServiceManager().watchdog_ns(), us * 500);
  }
  for (const char* const text :
       {"", "0", "-5", "soon", "99999999999999999999", "9223372036854775807"}) {
    ::setenv("WATCHDOG_USEC", text, 1);
    EXPECT_EQ(ServiceManager().watchdog_ns(), 0) << text;
  }
  ::unsetenv("WATCHDOG_USEC");
  EXPECT_EQ(ServiceManager().watchdog_ns(), 0);
}

}  // namespace
}  // namespace plumb::drivers::rt

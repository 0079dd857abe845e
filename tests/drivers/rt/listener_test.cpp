// SPDX-License-Identifier: Apache-2.0
#include "rt/listener.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <thread>

#include "plumb/drivers/time_source.hpp"
#include "program/scratch_folder.hpp"

namespace plumb::drivers::rt {
namespace {

class Listeners : public testing::Test {
 protected:
  /// A connection of a peer, who has not said anything yet.
  Descriptor connect() const {
    Descriptor out(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.string().copy(address.sun_path, sizeof(address.sun_path) - 1);
    EXPECT_EQ(::connect(out.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)),
              0);
    return out;
  }
  static void send(const Descriptor& to, std::string_view text) {
    EXPECT_EQ(::send(to.get(), text.data(), text.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(text.size()));
  }
  std::optional<Asked> take(const Patience& patience = {}) {
    return take_request(listening->get(), reserve, "\n", patience);
  }
  const ScratchFolder scratch{"plumb-listener-"};
  const std::filesystem::path path = scratch.path() / "socket";
  const std::optional<Descriptor> listening = listen_unix(path);
  ReserveDescriptor reserve;
};

TEST_F(Listeners, OnlyItsOwnerMayUseTheSocketAndTheMaskIsAsItWas) {
  const mode_t before = ::umask(0027);
  const auto other = listen_unix(scratch.path() / "other");
  EXPECT_EQ(::umask(before), 0027U);
  for (const char* const name : {"socket", "other"}) {
    struct stat found {};
    ASSERT_EQ(::stat((scratch.path() / name).c_str(), &found), 0);
    EXPECT_EQ(found.st_mode & 0777U, 0600U) << name;
  }
}

TEST_F(Listeners, AnAddressThatIsTakenOrTooLongIsNoSocketAndTheSystemSaysWhy) {
  EXPECT_FALSE(listen_unix(path).has_value());
  EXPECT_EQ(errno, EADDRINUSE);
  EXPECT_FALSE(listen_unix(scratch.path() / std::string(120, 'x')).has_value());
  EXPECT_EQ(errno, ENAMETOOLONG);
  EXPECT_FALSE(listen_unix("").has_value());
  EXPECT_FALSE(ask(scratch.path() / std::string(120, 'x'), "x\n", 10).has_value());
}

/// How the bytes come is up to the system.
TEST_F(Listeners, ARequestIsTheSameInHoweverManyPiecesItComes) {
  const std::string request = "swap /some/model.plumb\n";
  for (std::size_t piece = 1; piece <= request.size(); ++piece) {
    const Descriptor peer = connect();
    std::thread sender([&] {
      for (std::size_t at = 0; at < request.size(); at += piece)
        send(peer, std::string_view(request).substr(at, piece));
    });
    const auto asked = take({.most_bytes = 4096, .within_ms = 5000});
    sender.join();
    ASSERT_TRUE(asked) << piece;
    EXPECT_EQ(asked->request + "\n", request);
    EXPECT_EQ(asked->uid, static_cast<std::int64_t>(::geteuid()));
  }
}

TEST_F(Listeners, ARequestOfTheMostBytesIsTakenAndOneMoreIsNot) {
  for (const std::size_t most : {std::size_t{1}, std::size_t{10}, std::size_t{4096}})
    for (const std::size_t more : {std::size_t{0}, std::size_t{1}, std::size_t{500}}) {
      const Descriptor peer = connect();
      send(peer, std::string(most + more, 'x') + "\n");
      const auto asked = take({.most_bytes = most, .within_ms = 1000});
      EXPECT_EQ(asked.has_value(), more == 0) << most << " " << more;
    }
}

TEST_F(Listeners, WhoIsSilentOrGoesIsNotWaitedForLongerThanAllowed) {
  const std::int64_t begin_ns = MonotonicTime::now_ns();
  const Descriptor silent = connect();
  EXPECT_FALSE(take({.most_bytes = 100, .within_ms = 50}).has_value());
  const Descriptor slow = connect();
  send(slow, "half a requ");
  EXPECT_FALSE(take({.most_bytes = 100, .within_ms = 50}).has_value());
  Descriptor gone = connect();
  send(gone, "half");
  gone = Descriptor();
  EXPECT_FALSE(take({.most_bytes = 100, .within_ms = 60'000}).has_value());
  EXPECT_FALSE(take().has_value()) << "nobody is there";
  EXPECT_LT(MonotonicTime::now_ns() - begin_ns, 10'000'000'000);
}

TEST_F(Listeners, WhoDoesNotReadItsAnswerHoldsNobodyUp) {
  const Descriptor peer = connect();
  send(peer, "status\n");
  const std::int64_t begin_ns = MonotonicTime::now_ns();
  serve_one(listening->get(), reserve, "\n", {.most_bytes = 100, .within_ms = 50},
            [](const std::string&) { return std::string(std::size_t{64} << 20, 'x'); });
  EXPECT_LT(MonotonicTime::now_ns() - begin_ns, 10'000'000'000);
}

TEST_F(Listeners, WhoAsksGetsTheWholeAnswer) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{300'000}}) {
    const std::string answer(size, 'a');
    std::thread server([&] {
      pollfd at{.fd = listening->get(), .events = POLLIN, .revents = 0};
      ::poll(&at, 1, 5000);
      serve_one(listening->get(), reserve, "\n", {.most_bytes = 100, .within_ms = 5000},
                [&](const std::string& request) {
                  EXPECT_EQ(request, "status");
                  return answer;
                });
    });
    EXPECT_EQ(ask(path, "status\n", 5000), answer);
    server.join();
  }
  std::filesystem::remove(path);
  EXPECT_FALSE(ask(path, "status\n", 100).has_value()) << "nobody listens";
}

/// A process without descriptors still answers how it stands.
TEST_F(Listeners, TheReserveIsGivenUpOnlyWhereNoOtherDescriptorIsLeft) {
  const Descriptor first = connect();
  send(first, "status\n");
  EXPECT_TRUE(take({.most_bytes = 100, .within_ms = 1000}).has_value());
  EXPECT_TRUE(reserve.held());
  const Descriptor second = connect();
  send(second, "status\n");
  std::vector<Descriptor> all;
  while (true) {
    Descriptor one(::dup(0));
    if (!one.open()) break;
    all.push_back(std::move(one));
  }
  const auto asked = take({.most_bytes = 100, .within_ms = 1000});
  const bool held = reserve.held();
  all.clear();
  EXPECT_TRUE(asked.has_value());
  EXPECT_FALSE(held);
  reserve.take();
  EXPECT_TRUE(reserve.held());
}

}  // namespace
}  // namespace plumb::drivers::rt

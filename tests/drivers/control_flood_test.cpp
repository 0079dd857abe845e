// SPDX-License-Identifier: Apache-2.0
// The control socket under requests of people who mean no good, while the cycle runs.
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <random>

#include "rt/control_path.hpp"
#include "tests/drivers/child.hpp"
#include "tests/drivers/rights.hpp"
#include "tests/drivers/signed_folder.hpp"

namespace plumb::tests {
namespace {

namespace fs = std::filesystem;

/// A connection to a Unix domain socket; -1 with errno.
int connect_to(const fs::path& path) {
  const int fd = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.string().copy(address.sun_path, sizeof(address.sun_path) - 1);
  if (::connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0) return fd;
  const int error = errno;
  ::close(fd);
  errno = error;
  return -1;
}

class Flood : public testing::Test {
 protected:
  Flood() {
    write_endless_targets(folder);
    ::chmod(folder.folder.c_str(), 0755);  // so that only the socket itself keeps others out
    fs::remove_all(machine.keys());
    run.emplace(
        std::vector<std::string>{"run", folder.folder.string(), "--etc", machine.etc().string()},
        machine.root);
    EXPECT_TRUE(becomes([&] {
      auto now = status();
      return now.is_object() && now["state"] == "active";
    }));
    for (const auto& path : drivers::rt::control_paths(folder.folder))
      if (fs::is_socket(path)) socket = path;
  }
  ~Flood() override {
    run->kill(SIGTERM);
    EXPECT_EQ(run->wait().exit, 0);
  }
  nlohmann::json status() const {
    return plumb_rt({"status", folder.folder.string(), "--json"}, machine.root).json()["result"];
  }

  const Machine machine;
  const Deployed folder;
  std::optional<RtProgram> run;
  fs::path socket;
};

TEST_F(Flood, AHundredThousandRequestsOfAnotherUserAreRefusedByTheSystem) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can become another user";
  ASSERT_FALSE(socket.empty());
  struct stat found {};
  ASSERT_EQ(::stat(socket.c_str(), &found), 0);
  EXPECT_EQ(found.st_mode & 077, 0U);
  auto before = status();
  const int result = in_child([&] {
    become_nobody();
    for (int i = 0; i < 100'000; ++i)
      if (connect_to(socket) >= 0 || errno != EACCES) return 1;
    return 0;
  });
  EXPECT_EQ(result, 0) << "each is refused with EACCES";
  auto after = status();
  EXPECT_EQ(after["state"], before["state"]);
  EXPECT_EQ(after["counters"]["stalls"], 0);
  EXPECT_EQ(after["counters"]["faults"], 0);
  EXPECT_GT(after["counters"]["answered"], before["counters"]["answered"]);
}

TEST_F(Flood, GarbageOfTheOwnUserIsAnsweredOrDroppedAndTheCycleGoesOn) {
  std::mt19937 random(11);
  const std::string words[] = {"",
                               "\n",
                               "status",
                               "swap\n",
                               "swap \n",
                               "swap /dev/zero\n",
                               "swap /dev/stdin\n",
                               "swap within_um=nan /x\n",
                               "swap within_um=1e308 ../../etc/passwd\n",
                               std::string(5000, 'a'),
                               std::string(4096, '\0') + "\n",
                               "{\"install\": \"/\"}\n"};
  constexpr int kRequests = 2000;
  for (int i = 0; i < kRequests; ++i) {
    const int fd = connect_to(socket);
    if (fd < 0) continue;
    std::string text = words[random() % std::size(words)];
    for (std::size_t k = 0; k < text.size() && random() % 4 == 0; ++k)
      text[k] = static_cast<char>(random());
    std::ignore = ::send(fd, text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    ::close(fd);
  }
  EXPECT_TRUE(becomes([&] { return status().is_object(); })) << "it answers as ever";
  auto after = status();
  EXPECT_EQ(after["counters"]["swaps"], 0);
  EXPECT_EQ(after["counters"]["faults"], 0);
  EXPECT_EQ(after["counters"]["stalls"], 0);
  EXPECT_EQ(after["state"], "active");
}

/// A mistyped name of a file is no reason to end the program that corrects a robot.
TEST_F(Flood, AFileWhoseNameIsNoTextIsRefusedByNameAndTheCycleGoesOn) {
  const auto answer = drivers::rt::ask(socket, "swap /srv/no-\xff-text.plumb\n", 10'000);
  ASSERT_TRUE(answer);
  const auto said = nlohmann::json::parse(*answer, nullptr, false);
  ASSERT_TRUE(said.is_object()) << *answer;
  EXPECT_EQ(said["ok"], false);
  EXPECT_NE(said["error"]["message"].get<std::string>().find("-text.plumb"), std::string::npos);
  auto after = status();
  ASSERT_TRUE(after.is_object()) << "it lives";
  EXPECT_EQ(after["state"], "active");
  EXPECT_EQ(after["counters"]["stalls"], 0);
}

}  // namespace
}  // namespace plumb::tests

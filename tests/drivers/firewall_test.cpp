// SPDX-License-Identifier: Apache-2.0
// The rules by which the kernel's firewall keeps a bus for the user of the service.
#include "rt/firewall.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <net/if.h>
#include <netinet/tcp.h>
#include <sched.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>

#include "tests/drivers/fake_machine.hpp"

namespace plumb::drivers::rt {
namespace {

using tests::FakeMachine;
using Kind = BusEndpoint::Kind;

constexpr char kNobody[] = "nobody";
constexpr uid_t kNobodyId = 65534, kOtherId = 1;
constexpr std::uint16_t kPort = 1502;

const BusEndpoint kClient{.kind = Kind::kConnects, .address = "127.0.0.1", .port = kPort};
const BusEndpoint kServer{
    .kind = Kind::kListens, .address = "127.0.0.1", .port = kPort, .peers = {"127.0.0.7"}};

std::string text_of(const std::optional<FirewallRule>& rule) {
  return rule ? firewall_settings({*rule}).front().text : "";
}

/// A place as plumb-rt install makes it, with this [source].
void install(const FakeMachine& machine, const std::string& name, const std::string& source) {
  const std::string place = "var/lib/plumb/" + name + "/", id = "0123456789abcdef";
  machine.write(place + "versions/" + id + "/rt.toml", "schema = \"rt/1\"\n[source]\n" + source);
  std::filesystem::create_symlink("versions/" + id, machine.root() / place / "current");
}

FirewallRules rules_of(const FakeMachine& machine) {
  return firewall_rules(machine.root() / "var/lib/plumb");
}

TEST(Firewall, AClientsControllerIsForTheServiceOnly) {
  const std::string text = text_of(firewall_rule("cell4", kClient, "plumb"));
  for (const char* line :
       {"ip daddr 127.0.0.1 tcp dport 1502 meta skuid \"plumb\" counter accept",
        "ip daddr 127.0.0.1 tcp dport 1502 tcp flags & syn == 0 ip length 40 counter accept",
        "ip daddr 127.0.0.1 tcp dport 1502 counter reject with tcp reset"})
    EXPECT_NE(text.find(line), std::string::npos) << line << "\n" << text;
  EXPECT_NE(text.find("cell4: only user plumb may connect to 127.0.0.1, port 1502, and nothing is "
                      "forwarded there"),
            std::string::npos);
  EXPECT_EQ(text.rfind("# Written by plumb-rt doctor --fix", 0), 0U);  // as postrm asks
}

TEST(Firewall, AServersPortIsForItsPeersOnlyInBothFamilies) {
  BusEndpoint bus{.kind = Kind::kListens,
                  .interface = "eth1",
                  .port = 502,
                  .peers = {"192.168.0.10", "::ffff:192.168.0.11", "fd00::7"}};
  const std::string text = text_of(firewall_rule("cell4", bus, "plumb"));
  for (const char* line :
       {"iifname \"eth1\" meta nfproto ipv4 tcp dport 502 ip saddr != { "
        "192.168.0.10, 192.168.0.11 } counter drop",
        "iifname \"eth1\" meta nfproto ipv6 tcp dport 502 ip6 saddr != { fd00::7 "
        "} counter drop",
        "oifname \"eth1\" tcp sport 502 meta skuid \"plumb\" counter accept",
        "oifname \"eth1\" tcp sport 502 tcp flags & syn == 0 ip length 40 counter accept",
        "oifname \"eth1\" tcp sport 502 tcp flags & syn == 0 ip6 length 32 tcp doff 8 counter "
        "accept",
        "oifname \"eth1\" tcp sport 502 counter drop"})
    EXPECT_NE(text.find(line), std::string::npos) << line << "\n" << text;
}

TEST(Firewall, WhatIsNoAddressOrInterfaceMakesNoRule) {
  for (const char* word : {"robot7", "", "10.0.0.1; flush ruleset"})
    EXPECT_FALSE(firewall_rule("a", {.kind = Kind::kConnects, .address = word}, "plumb")) << word;
  for (const char* word : {"", "can0\"; flush ruleset; #", "a b", "0123456789abcdef"})
    EXPECT_FALSE(firewall_rule("a", {.kind = Kind::kCan, .interface = word}, "plumb")) << word;
  BusEndpoint bus = kServer;
  bus.peers = {"10.0.0.1\n } }\nflush ruleset"};
  EXPECT_EQ(text_of(firewall_rule("a", bus, "plumb")).find("flush"), std::string::npos);
}

TEST(Firewall, AServersAddressMayStandAsInterfaceAndTheOtherWayRound) {
  const FakeMachine machine;
  const std::string peers = "peers = [\"192.168.1.2\"]\n";
  install(machine, "one",
          "kind = \"modbus\"\nrole = \"server\"\ninterface = \"192.168.1.1\"\n" + peers);
  install(machine, "two", "kind = \"modbus\"\nrole = \"server\"\naddress = \"eth1\"\n" + peers);
  const auto files = firewall_settings(rules_of(machine).rules);
  ASSERT_EQ(files.size(), 1U);
  for (const char* line : {"ip saddr 192.168.1.1 tcp sport", "oifname \"eth1\" tcp sport"})
    EXPECT_NE(files.front().text.find(line), std::string::npos) << line << files.front().text;
}

TEST(Firewall, EveryPlaceHasItsRulesAndCanAFileOfItsOwn) {
  const FakeMachine machine;
  install(machine, "one", "kind = \"modbus\"\naddress = \"192.168.0.7\"\n");
  install(machine, "two",
          "kind = \"modbus\"\nrole = \"server\"\naddress = \"192.168.1.1\"\npeers = "
          "[\"192.168.1.2\"]\n");
  install(machine, "three", "kind = \"can\"\ninterface = \"can1\"\n");
  install(machine, "serial", "kind = \"modbus\"\ndevice = \"/dev/ttyS0\"\n");
  install(machine, "wrong", "kind = \"modbus\"\nrole = \"server\"\n");
  const FirewallRules found = rules_of(machine);
  ASSERT_EQ(found.rules.size(), 3U);
  ASSERT_EQ(found.unread.size(), 1U);
  EXPECT_EQ(found.unread.front().rfind("wrong: ", 0), 0U) << found.unread.front();
  const auto files = firewall_settings(found.rules);
  ASSERT_EQ(files.size(), 2U);
  EXPECT_EQ(files[0].file, "etc/plumb/firewall-can1.nft");
  EXPECT_NE(files[0].text.find("hook egress device \"can1\" priority filter; policy drop;"),
            std::string::npos);
  EXPECT_EQ(files[1].file, "etc/plumb/firewall.nft");
  EXPECT_NE(files[1].text.find("192.168.0.7"), std::string::npos);
  EXPECT_NE(files[1].text.find("192.168.1.2"), std::string::npos);
}

TEST(Firewall, DoctorSaysWhetherTheRuleIsInForce) {
  const FirewallRule rule = firewall_rule("cell4", kServer, "plumb").value();
  const auto said = [&](const FirewallInForce& now) {
    return firewall_checks({.rules = {rule}}, now).front().finding;
  };
  EXPECT_EQ(said({.listed = text_of(rule)}).grant, Grant::kGranted);
  EXPECT_EQ(said({.listed = ""}).grant, Grant::kDenied);
  EXPECT_EQ(said({.listed = ""}).remedy, "sudo plumb-rt doctor --fix");
  std::string part = text_of(rule);
  part.erase(part.find("chain input"));  // a rule of which a part is gone is not in force
  EXPECT_EQ(said({.listed = part}).grant, Grant::kDenied);
  EXPECT_EQ(said({.why_not = "not known"}).grant, Grant::kSkipped);
  EXPECT_EQ(firewall_checks({}, {.listed = ""}).front().finding.grant, Grant::kSkipped);
}

void load(const std::string& rules) {
  const std::string file =
      std::filesystem::temp_directory_path() / ("plumb-rules-" + std::to_string(::getpid()));
  std::ofstream(file) << rules;
  const auto refused = load_firewall(file);
  ::unlink(file.c_str());
  if (refused) std::fprintf(stderr, "nft: %s\n", refused->c_str());
}

/// A child in a network of its own, in which these rules are in force; false: it can have none.
class OwnNetwork {
 public:
  static int run(const std::string& rules, const std::function<int()>& in_it) {
    const pid_t child = ::fork();
    if (child == 0) ::_exit(entered(rules) ? in_it() : kImpossible);
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  static constexpr int kImpossible = 77;

 private:
  static bool entered(const std::string& rules) {
    if (::access("/usr/sbin/nft", X_OK) != 0 || ::unshare(CLONE_NEWNET) != 0) return false;
    ifreq loopback{};
    std::snprintf(loopback.ifr_name, sizeof loopback.ifr_name, "lo");
    loopback.ifr_flags = IFF_UP;
    const int any = ::socket(AF_INET, SOCK_DGRAM, 0);
    if (::ioctl(any, SIOCSIFFLAGS, &loopback) != 0 || !read_firewall().listed) return false;
    load(rules);
    load(rules);  // again: it replaces itself
    return true;
  }
};

sockaddr_in at(const char* host, int port) {
  sockaddr_in out{};
  out.sin_family = AF_INET;
  out.sin_port = htons(static_cast<std::uint16_t>(port));
  ::inet_pton(AF_INET, host, &out.sin_addr);
  return out;
}

int bound(const char* host, int port) {
  const int out = ::socket(AF_INET, SOCK_STREAM, 0);
  const sockaddr_in address = at(host, port);
  const int on = 1;
  ::setsockopt(out, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  return ::bind(out, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 ? out : -1;
}

/// Whether a connection from this address to our port is made.
bool connects(const char* from) {
  const int own = bound(from, 0);
  const timeval soon{.tv_sec = 0, .tv_usec = 300'000};
  ::setsockopt(own, SOL_SOCKET, SO_SNDTIMEO, &soon, sizeof soon);
  const sockaddr_in to = at("127.0.0.1", kPort);
  return ::connect(own, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0;
}

/// What a child of this user sees: the owner of a socket is the user who made it.
bool as(uid_t user, const std::function<bool()>& seen) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(::setuid(user) == 0 && seen() ? 0 : 1);
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

bool connects_as(uid_t user) {
  return as(user, [] { return connects("127.0.0.1"); });
}

int listen_as(uid_t user) {
  if (::seteuid(user) != 0) return -1;
  const int out = bound("127.0.0.1", kPort);
  (void)::seteuid(0);
  return ::listen(out, 4) == 0 ? out : -1;
}

TEST(FirewallInTheKernel, OnlyTheServicesUserReachesTheController) {
  const int seen = OwnNetwork::run(text_of(firewall_rule("a", kClient, kNobody)), [] {
    if (listen_as(0) < 0) return 70;
    return (connects_as(kNobodyId) ? 0 : 1) + (connects_as(kOtherId) ? 2 : 0) +
           (connects_as(0) ? 4 : 0);
  });
  if (seen == OwnNetwork::kImpossible) GTEST_SKIP() << "no nft, or no right to a network";
  EXPECT_EQ(seen, 0) << "1: the service cannot; 2: another user can; 4: root can";
  const int open =
      OwnNetwork::run("", [] { return listen_as(0) >= 0 && connects_as(kOtherId) ? 0 : 1; });
  EXPECT_EQ(open, 0) << "without the rule anyone can";
}

/// Whether a byte reaches the controller that a user wrote and left to the kernel, connected before
/// the rules: it is sent a second later, when his socket is closed and has no owner.
bool leaves_a_byte(const std::string& later) {
  const int listening = listen_as(0);
  std::array<int, 2> go{};
  if (listening < 0 || ::pipe(go.data()) != 0) return false;
  const pid_t user = ::fork();
  if (user == 0) {
    const int own = ::socket(AF_INET, SOCK_STREAM, 0), at_once = 1, bytes_a_second = 1;
    const sockaddr_in to = at("127.0.0.1", kPort);
    ::setsockopt(own, IPPROTO_TCP, TCP_NODELAY, &at_once, sizeof at_once);
    if (::setuid(kOtherId) != 0 ||
        ::connect(own, reinterpret_cast<const sockaddr*>(&to), sizeof to) != 0)
      ::_exit(0);
    for (int i = 0; i < 12; ++i) {  // the first ten are not paced
      if (i == 11)
        ::setsockopt(own, SOL_SOCKET, SO_MAX_PACING_RATE, &bytes_a_second, sizeof bytes_a_second);
      (void)!::write(own, "p", 1);
      ::usleep(2000);
    }
    char byte = 0;
    (void)!::read(go[0], &byte, 1);
    (void)!::write(own, "x", 1);
    ::close(own);
    ::pause();
  }
  const int one = ::accept(listening, nullptr, nullptr);
  char heard = 0;
  for (int i = 0; i < 12; ++i) (void)!::read(one, &heard, 1);
  load(later);
  (void)!::write(go[1], "!", 1);
  const timeval wait{.tv_sec = 4, .tv_usec = 0};
  ::setsockopt(one, SOL_SOCKET, SO_RCVTIMEO, &wait, sizeof wait);
  const bool out = ::read(one, &heard, 1) == 1;
  ::kill(user, SIGKILL);
  return out;
}

TEST(FirewallInTheKernel, WhatAUserLeftToTheKernelDoesNotReachTheController) {
  const std::string rules = text_of(firewall_rule("a", kClient, kNobody));
  const int seen = OwnNetwork::run("", [&] { return leaves_a_byte(rules) ? 1 : 0; });
  if (seen == OwnNetwork::kImpossible) GTEST_SKIP() << "no nft, or no right to a network";
  EXPECT_EQ(seen, 0);
  EXPECT_EQ(OwnNetwork::run("", [] { return leaves_a_byte("") ? 1 : 0; }), 1)
      << "without the rule it does";
}

TEST(FirewallInTheKernel, OnlyPeersReachTheServerAndOnlyTheServiceAnswersThere) {
  const std::string rules = text_of(firewall_rule("a", kServer, kNobody));
  const int seen = OwnNetwork::run(rules, [] {
    if (listen_as(kNobodyId) < 0) return 70;
    return (connects("127.0.0.7") ? 0 : 1) + (connects("127.0.0.1") ? 2 : 0);
  });
  if (seen == OwnNetwork::kImpossible) GTEST_SKIP() << "no nft, or no right to a network";
  EXPECT_EQ(seen, 0) << "1: the peer cannot; 2: another address can";
  const int other = OwnNetwork::run(
      rules, [] { return listen_as(kOtherId) >= 0 && connects("127.0.0.7") ? 1 : 0; });
  EXPECT_EQ(other, 0) << "another user stands in for plumb-rt";
}

/// Answers `calls` on a connection, each received byte with itself, and closes it.
void answer(int listening, int calls) {
  const int one = ::accept(listening, nullptr, nullptr);
  char byte = 0;
  for (int i = 0; i < calls && ::read(one, &byte, 1) == 1; ++i) (void)!::write(one, &byte, 1);
  ::close(one);
}

pid_t answering(int listening, int calls, uid_t user) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  if (::setuid(user) == 0) answer(listening, calls);
  ::close(listening);
  ::pause();
  ::_exit(0);
}

/// A socket of the peer's, connected to our port within half a second; -1: it is not, with errno.
int peer_socket() {
  const int own = bound("127.0.0.7", 0);
  const timeval soon{.tv_sec = 0, .tv_usec = 500'000};
  ::setsockopt(own, SOL_SOCKET, SO_SNDTIMEO, &soon, sizeof soon);
  ::setsockopt(own, SOL_SOCKET, SO_RCVTIMEO, &soon, sizeof soon);
  const sockaddr_in to = at("127.0.0.1", kPort);
  return ::connect(own, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0 ? own : -1;
}

bool echoes(int own, char byte) {
  char heard = 0;
  return ::write(own, &byte, 1) == 1 && ::read(own, &heard, 1) == 1 && heard == byte;
}

/// True if the kernel keeps nothing of a connection that both sides have closed; this one last.
bool is_forgotten(int own) {
  sockaddr_in here{};
  socklen_t size = sizeof here;
  ::getsockname(own, reinterpret_cast<sockaddr*>(&here), &size);
  const std::string row = fmt::format("0700007F:{:04X} 0100007F", ntohs(here.sin_port));
  ::close(own);
  ::usleep(300'000);
  std::ifstream table("/proc/self/net/tcp");
  for (std::string line; std::getline(table, line);)
    if (line.find(row) != std::string::npos) return false;
  return true;
}

TEST(FirewallInTheKernel, AConversationWithTheServiceIsCompleteFromItsBeginningToItsEnd) {
  const int seen = OwnNetwork::run(text_of(firewall_rule("a", kServer, kNobody)), [] {
    if (peer_socket() >= 0 || errno != ECONNREFUSED) return 1;
    const int listening = listen_as(kNobodyId);
    const pid_t service = answering(listening, 3, kNobodyId);
    ::close(listening);
    const int own = peer_socket();
    int wrong = own < 0 ? 2 : 0;
    for (const char byte : {'a', 'b', 'c'}) wrong += echoes(own, byte) ? 0 : 4;
    char end = 0;
    wrong += ::read(own, &end, 1) == 0 ? 0 : 16;
    wrong += is_forgotten(own) ? 0 : 32;
    ::kill(service, SIGKILL);
    return wrong;
  });
  if (seen == OwnNetwork::kImpossible) GTEST_SKIP() << "no nft, or no right to a network";
  EXPECT_EQ(seen, 0) << "1: not refused while nobody listens; 2: no connection; 4, 8, 12: no "
                        "answer; 16: no end; 32: the peer waits for the last acknowledgement";
}

/// Whether a byte of a forger reaches the peer. His socket answers a SYN by a cookie, which has no
/// owner; so has what he writes when he has closed it. `later`: rules that come when he is
/// connected already.
bool forges(const std::string& later) {
  std::ofstream("/proc/sys/net/ipv4/tcp_syncookies") << 2;
  const int listening = listen_as(kOtherId);
  const pid_t forger = ::fork();
  if (forger == 0) {
    if (::setuid(kOtherId) != 0) ::_exit(0);
    const int one = ::accept(listening, nullptr, nullptr);
    char asked = 0;
    (void)!::read(one, &asked, 1);
    (void)!::write(one, "x", 1);
    ::close(one);
    ::pause();
  }
  const int own = peer_socket();
  load(later);
  char heard = 0;
  const bool out = own >= 0 && ::write(own, "?", 1) == 1 && ::read(own, &heard, 1) == 1;
  ::kill(forger, SIGKILL);
  return out;
}

TEST(FirewallInTheKernel, AForgerDeliversNoByteFromASocketThatHeCloses) {
  const std::string rules = text_of(firewall_rule("a", kServer, kNobody));
  const auto before = [] { return forges("") ? 1 : 0; };
  const int seen = OwnNetwork::run(rules, before);
  if (seen == OwnNetwork::kImpossible) GTEST_SKIP() << "no nft, or no right to a network";
  EXPECT_EQ(seen, 0) << "he is connected in spite of the rule";
  EXPECT_EQ(OwnNetwork::run("", [&] { return forges(rules) ? 1 : 0; }), 0) << "he was before it";
  EXPECT_EQ(OwnNetwork::run("", before), 1) << "without the rule he can";
}

/// A process in a network of its own that listens at our port of whatever address it gets.
class Neighbour {
 public:
  Neighbour() {
    const int before = ::eventfd(0, 0);
    child_ = ::fork();
    if (child_ == 0) {
      (void)::unshare(CLONE_NEWNET);
      ::listen(bound("0.0.0.0", kPort), 4);
      ::eventfd_write(before, 1);
      for (;;) ::pause();
    }
    eventfd_t made = 0;
    ::eventfd_read(before, &made);
    ::close(before);
  }
  ~Neighbour() {
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
  }

  /// A cable to it: we are 10.9.N.1, it is 10.9.N.2 and sends through us what goes elsewhere.
  bool plug(int n) const {
    return std::system(
               fmt::format("ip link add v{0} type veth peer name v0 netns {1} && "
                           "ip address add 10.9.{0}.1/24 dev v{0} && ip link set v{0} up && "
                           "nsenter -t {1} -n sh -c 'ip address add 10.9.{0}.2/24 dev v0 && "
                           "ip link set v0 up && ip route add default via 10.9.{0}.1'",
                           n, child_)
                   .c_str()) == 0;
  }

  /// Whether this is so there.
  bool sees(const std::function<bool()>& so) const {
    return as(0, [&] { return enter() && so(); });
  }

 private:
  bool enter() const {
    const int network = ::open(fmt::format("/proc/{}/ns/net", child_).c_str(), O_RDONLY);
    return ::setns(network, CLONE_NEWNET) == 0;
  }

  pid_t child_ = -1;
};

bool reaches(const char* host) {
  const int own = ::socket(AF_INET, SOCK_STREAM, 0);
  const timeval soon{.tv_sec = 1, .tv_usec = 0};
  ::setsockopt(own, SOL_SOCKET, SO_SNDTIMEO, &soon, sizeof soon);
  const sockaddr_in to = at(host, kPort);
  return ::connect(own, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0;
}

TEST(FirewallInTheKernel, NothingIsForwardedToTheController) {
  BusEndpoint bus = kClient;
  bus.address = "10.9.2.2";
  const auto in_it = [] {
    const Neighbour container, controller;
    if (!container.plug(1) || !controller.plug(2)) return OwnNetwork::kImpossible;
    std::ofstream("/proc/sys/net/ipv4/ip_forward") << 1;
    const auto there = [] { return reaches("10.9.2.2"); };
    return container.sees(there) + 2 * as(kNobodyId, there);
  };
  const int seen = OwnNetwork::run(text_of(firewall_rule("a", bus, kNobody)), in_it);
  if (seen == OwnNetwork::kImpossible) GTEST_SKIP() << "no nft, or no right to a network";
  EXPECT_EQ(seen, 2) << "1: the container reaches the controller";
  EXPECT_EQ(OwnNetwork::run("", in_it), 3) << "without the rule it does";
}

TEST(FirewallInTheKernel, IsNotInForceWhileItsTableIsDormant) {
  const FirewallRule rule = firewall_rule("a", kClient, kNobody).value();
  const int seen = OwnNetwork::run(text_of(rule) + "table inet other {\n}\n", [&] {
    const auto said = [&] {
      return firewall_checks({.rules = {rule}}, read_firewall()).front().finding;
    };
    load("add table inet other { flags dormant; }\n");
    const bool before = said().grant == Grant::kGranted;
    load("add table inet plumb_rt { flags dormant; }\n");
    const Finding asleep = said();
    const bool told = asleep.grant == Grant::kDenied &&
                      asleep.why.find("every user") != std::string::npos &&
                      asleep.why.find("dormant") != std::string::npos;
    load(text_of(rule));  // as the remedy does
    return (before ? 0 : 1) + (told ? 0 : 2) + (said().grant == Grant::kGranted ? 0 : 4);
  });
  if (seen == OwnNetwork::kImpossible) GTEST_SKIP() << "no nft, or no right to a network";
  EXPECT_EQ(seen, 0)
      << "1: another table's sleep counts; 2: it is said to be in force; 4: stays so";
}

TEST(FirewallInTheKernel, IsSeenByDoctorOnceItIsLoaded) {
  const BusEndpoint both_families{
      .kind = Kind::kListens, .interface = "lo", .port = kPort, .peers = {"10.0.0.1", "fd00::7"}};
  for (const BusEndpoint& bus : {kClient, kServer, both_families}) {
    const FirewallRule rule = firewall_rule("a", bus, kNobody).value();
    const int seen = OwnNetwork::run(text_of(rule), [&] {
      const auto checks = firewall_checks({.rules = {rule}}, read_firewall());
      return checks.front().finding.grant == Grant::kGranted ? 0 : 1;
    });
    if (seen == OwnNetwork::kImpossible) GTEST_SKIP() << "no nft, or no right to a network";
    EXPECT_EQ(seen, 0);
  }
}

}  // namespace
}  // namespace plumb::drivers::rt

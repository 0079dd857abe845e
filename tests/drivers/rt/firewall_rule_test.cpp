// SPDX-License-Identifier: Apache-2.0
#include "rt/firewall_rule.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace plumb::drivers::rt {
namespace {

using Kind = BusEndpoint::Kind;

const BusEndpoint kClientBus{.kind = Kind::kConnects, .address = "192.168.0.9", .port = 502};
const BusEndpoint kServerBus{.kind = Kind::kListens,
                             .address = "192.168.0.1",
                             .port = 1502,
                             .peers = {"192.168.0.7", "192.168.0.8"}};
const BusEndpoint kCanBus{.kind = Kind::kCan, .interface = "can0"};

std::vector<std::string> statements_of(const FirewallRule& rule) {
  std::vector<std::string> out = rule.output;
  out.insert(out.end(), rule.input.begin(), rule.input.end());
  out.insert(out.end(), rule.forward.begin(), rule.forward.end());
  return out;
}

/// rt.toml is edited by hand, and root loads what is made of it.
TEST(FirewallRules, WhatIsNoAddressAndNoInterfaceNeverReachesAStatement) {
  for (const std::string bad :
       {"", "x; flush ruleset", "can0\"", "can0\nadd", "a b", "{", "0123456789abcdef", "localhost",
        "192.168.0.9/0", "192.168.0.300"}) {
    BusEndpoint client = kClientBus, server = kServerBus, can = kCanBus;
    client.address = server.address = can.interface = bad;
    EXPECT_FALSE(firewall_rule("cell4", client, "plumb").has_value()) << bad;
    EXPECT_FALSE(firewall_rule("cell4", server, "plumb").has_value()) << bad;
    if (bad != "localhost" && bad != "192.168.0.300") {  // names that an interface may have
      EXPECT_FALSE(firewall_rule("cell4", can, "plumb").has_value()) << bad;
    }
    server = kServerBus;
    server.peers.push_back(bad);
    const auto rule = firewall_rule("cell4", server, "plumb");
    ASSERT_TRUE(rule);
    EXPECT_EQ(statements_of(*rule), statements_of(*firewall_rule("cell4", kServerBus, "plumb")))
        << "no peer is added by " << bad;
  }
  EXPECT_FALSE(firewall_rule("cell4", {}, "plumb").has_value());
}

/// The kernel's list is compared by the comments.
TEST(FirewallRules, EveryStatementHasAMarkOfItsOwnThatDependsOnAllThatItSays) {
  std::set<std::string> marks;
  std::size_t statements = 0;
  BusEndpoint other_port = kClientBus, other_address = kClientBus, other_peer = kServerBus;
  other_port.port = 503;
  other_address.address = "192.168.0.10";
  other_peer.peers.pop_back();
  for (const BusEndpoint& bus : {kClientBus, other_port, other_address}) {
    const auto rule = firewall_rule("cell4", bus, "plumb");
    ASSERT_TRUE(rule);
    for (const std::string& one : rule->output) {
      marks.insert(one.substr(one.find("comment ")));
      ++statements;
    }
  }
  EXPECT_EQ(marks.size(), statements);
  const auto two = firewall_rule("cell4", kServerBus, "plumb"),
             one = firewall_rule("cell4", other_peer, "plumb");
  EXPECT_NE(two->input, one->input);
  EXPECT_EQ(two->output, one->output) << "who may answer does not depend on who may ask";
}

TEST(FirewallRules, ThePlaceIsOnlyNamedInWords) {
  for (const BusEndpoint& bus : {kClientBus, kServerBus, kCanBus}) {
    const auto a = firewall_rule("cell4", bus, "plumb"), b = firewall_rule("cell5", bus, "plumb");
    EXPECT_EQ(statements_of(*a), statements_of(*b));
    EXPECT_EQ(a->file, b->file);
    EXPECT_TRUE(a->says.starts_with("cell4: ") && a->without.starts_with("cell4: "));
  }
}

/// What the service sends passes first, and what follows stops everybody else.
TEST(FirewallRules, TheUserOfTheServicePassesBeforeAnybodyIsStopped) {
  for (const BusEndpoint& bus : {kClientBus, kServerBus, kCanBus}) {
    const auto rule = firewall_rule("cell4", bus, "robot-user");
    ASSERT_TRUE(rule);
    EXPECT_NE(rule->output.front().find("skuid \"robot-user\""), std::string::npos);
    EXPECT_NE(rule->output.front().find("accept"), std::string::npos);
    const auto stops = [](const std::string& one) {
      return one.find("drop") != std::string::npos || one.find("reject") != std::string::npos;
    };
    EXPECT_EQ(std::ranges::count_if(rule->output, stops), bus.kind == Kind::kCan ? 0 : 1);
    if (bus.kind != Kind::kCan) {
      EXPECT_TRUE(stops(rule->output.back()));
    }
    EXPECT_EQ(rule->can, bus.kind == Kind::kCan ? "can0" : "") << "its chain stops the rest";
  }
}

TEST(FirewallRules, AnAddressIsTheSameHoweverItIsWritten) {
  BusEndpoint mapped = kClientBus, wide = kClientBus, narrow = kClientBus;
  mapped.address = "::ffff:192.168.0.9";
  wide.address = "fd00:0:0:0:0:0:0:7";
  narrow.address = "fd00::7";
  const auto statements = [](const BusEndpoint& bus) {
    return statements_of(*firewall_rule("cell4", bus, "plumb"));
  };
  EXPECT_EQ(statements(mapped), statements(kClientBus));
  EXPECT_EQ(statements(wide), statements(narrow));
}

}  // namespace
}  // namespace plumb::drivers::rt

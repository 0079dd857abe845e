// SPDX-License-Identifier: Apache-2.0
// Bad configurations: a clear error, with code and place, before anything is opened or sent.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>

#include "tests/drivers/deployed.hpp"
#include "tests/drivers/rights.hpp"
#include "tests/drivers/rt_program.hpp"

namespace plumb::tests {
namespace {

const std::string kCan = "schema = \"rt/1\"\n[cycle]\npriority = 0\n[source]\nkind = \"can\"\n";

struct Bad {
  const char* name;
  std::string toml;
  int exit;
  const char* code;
  const char* words;  // of the message
};

const Bad kBad[] = {
    {"no schema", "[cycle]\npriority = 0\n", 3, "E-RT-MISSING", "'schema' is missing"},
    {"other schema", "schema = \"rt/2\"\n", 3, "E-RT-RANGE", "rt/2"},
    {"unknown key", Deployed::csv("modes = 1\n"), 3, "E-RT-KEY", "did you mean 'mode'?"},
    {"unknown table", Deployed::csv("[synch]\n"), 3, "E-RT-KEY", "sync"},
    {"wrong type", Deployed::csv("target_step_mm = \"far\"\n"), 3, "E-RT-TYPE", "a number"},
    {"no TOML", "schema = rt/1\n", 3, "E-TOML", ""},
    {"cycle of 0", "schema = \"rt/1\"\n[cycle]\ncycle_us = 0\n", 3, "E-RT-RANGE", "cycle_us"},
    {"priority of 100", "schema = \"rt/1\"\n[cycle]\npriority = 100\n", 3, "E-RT-RANGE",
     "priority"},
    {"unknown mode", "schema = \"rt/1\"\n[limits]\nmode = \"ful\"\n", 3, "E-RT-RANGE", "full"},
    {"scale beyond 1", Deployed::csv("limited_scale = 1.5\n"), 3, "E-RT-RANGE", "limited_scale"},
    {"tool of 256", Deployed::csv("[expect]\ntool = 256\n"), 3, "E-RT-RANGE", "tool"},
    {"port of 0", "schema = \"rt/1\"\n[source]\nkind = \"modbus\"\nport = 0\n", 3, "E-RT-RANGE",
     "port"},
    {"identifier out of range", kCan + "[bus.target]\ncan_id = 0x900\n", 3, "E-RT-BUS", "can_id"},
    {"identifiers twice", kCan + "[bus.target]\ncan_id = 0x120\n", 3, "E-RT-BUS", ""},
    {"registers twice", Deployed::csv("[bus.target]\nregister = 1000\n"), 3, "E-RT-BUS", ""},
    {"count of 0", kCan + "[bus.target]\ncount_um = 0\n", 3, "", "count_um"},
    {"period of 0", kCan + "[bus.target]\nperiod_us = 0\n", 3, "", "period_us"},
    {"robot seldom", kCan + "[bus.robot]\nperiod_us = 2000000\n", 3, "E-RT-BUS",
     "too seldom for robot"},
    {"actual seldom", Deployed::csv("[bus.actual]\nperiod_us = 600000\n"), 3, "E-RT-BUS",
     "too seldom for actual"},
    {"cycle so slow that all are silent",
     "schema = \"rt/1\"\n[cycle]\ncycle_us = 200000\n[source]\nkind = \"csv\"\n"
     "file = \"targets.csv\"\n",
     3, "E-RT-BUS", "too seldom for joints"},
    {"missing interface", kCan + "interface = \"nocan9\"\n", 5, "E-RT-LINK", ""},
    {"other robot", Deployed::csv("[model]\nserial = \"UR-2\"\n"), 3, "E-RT-SERIAL", "UR-2"},
    {"no model", Deployed::csv("[model]\nfile = \"none.plumb\"\n"), 3, "", "none.plumb"},
    {"garbage model", Deployed::csv("[model]\nfile = \"targets.csv\"\n"), 3, "E-RT-MODEL", ""},
    {"no targets", "schema = \"rt/1\"\n[cycle]\npriority = 0\n[source]\nkind = \"csv\"\n", 3,
     "E-RT-MISSING", "file"},
};

TEST(RunConfig, WhatIsWrongIsSaidBeforeAnythingIsSent) {
  for (const Bad& bad : kBad) {
    SCOPED_TRACE(bad.name);
    const Deployed folder(bad.toml);
    const RtRan ran = plumb_rt({"run", folder.folder.string()}, folder.folder);
    EXPECT_EQ(ran.exit, bad.exit);
    EXPECT_NE(ran.err.find(std::string("error[") + bad.code), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find(bad.words), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find("= help: "), std::string::npos) << ran.err;
    EXPECT_FALSE(std::filesystem::exists(folder.folder / "corrected.csv"));
  }
}

TEST(RunConfig, AFolderThatIsNoneIsAnInputError) {
  const Deployed folder;
  EXPECT_EQ(plumb_rt({"run", (folder.folder / "none").string()}, folder.folder).exit, 3);
  EXPECT_EQ(plumb_rt({"run"}, folder.folder).exit, 2);
}

TEST(RunConfig, AFileThatTheSumsDoNotKnowIsRefused) {
  const Deployed folder;
  folder.write("SHA256SUMS", std::string(64, '0') + "  robot.plumb\n");
  const RtRan ran = plumb_rt({"run", folder.folder.string()}, folder.folder);
  EXPECT_EQ(ran.exit, 3);
  EXPECT_NE(ran.err.find("error[E-RT-SUMS]"), std::string::npos) << ran.err;
}

TEST(RunConfig, APortInUseIsAnEnvironmentError) {
  const int fd = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  ASSERT_EQ(::bind(fd, reinterpret_cast<const sockaddr*>(&address), size), 0);
  ASSERT_EQ(::listen(fd, 1), 0);
  ::getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size);
  const std::string port = std::to_string(ntohs(address.sin_port));
  const Deployed metrics(Deployed::csv("[log]\nmetrics_port = " + port + "\n"));
  const RtRan first = plumb_rt({"run", metrics.folder.string()}, metrics.folder);
  EXPECT_EQ(first.exit, 5);
  EXPECT_NE(first.err.find("error[E-RT-METRICS]"), std::string::npos) << first.err;
  const Deployed server(
      "schema = \"rt/1\"\n[cycle]\npriority = 0\n[source]\nkind = \"modbus\"\n"
      "role = \"server\"\nport = " +
      port + "\n");
  const RtRan second = plumb_rt({"run", server.folder.string()}, server.folder);
  EXPECT_EQ(second.exit, 5);
  EXPECT_NE(second.err.find("error[E-RT-LINK]"), std::string::npos) << second.err;
  ::close(fd);
}

TEST(RunConfig, WithoutTheRightToBeRealTimeNothingIsOpened) {
  std::string toml = Deployed::csv("");
  toml.replace(toml.find("priority = 0"), 12, "priority = 80");
  const Deployed folder(toml);
  std::filesystem::permissions(folder.folder, std::filesystem::perms::all);
  const RtRan ran =
      RtProgram({"run", folder.folder.string()}, folder.folder, [] { drop_rights(); }).wait();
  EXPECT_EQ(ran.exit, 5) << ran.err;
  EXPECT_NE(ran.err.find("error[E-RT-RIGHTS]"), std::string::npos) << ran.err;
  EXPECT_NE(ran.err.find("= help: "), std::string::npos) << ran.err;
  EXPECT_FALSE(std::filesystem::exists(folder.folder / "corrected.csv"));
}

TEST(RunConfig, CheckOpensEverythingAndSendsNothing) {
  const Deployed folder(Deployed::csv("[log]\nrecord = \"record.log\"\n"));
  const RtRan ran = plumb_rt({"run", folder.folder.string(), "--check"}, folder.folder);
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_EQ(folder.text("record.log"), "");
}

}  // namespace
}  // namespace plumb::tests

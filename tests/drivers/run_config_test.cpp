// SPDX-License-Identifier: Apache-2.0
// Bad configurations: a clear error, with code and place, before anything is opened or sent.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include <fstream>
#include <sstream>

#include "tests/drivers/deployed.hpp"
#include "tests/drivers/rights.hpp"
#include "tests/drivers/rt_program.hpp"

namespace plumb::tests {
namespace {

const std::string kCan = "schema = \"rt/1\"\n[cycle]\npriority = 0\n[source]\nkind = \"can\"\n";
const std::string kServer =
    "schema = \"rt/1\"\n[cycle]\npriority = 0\n[source]\nkind = \"modbus\"\nrole = "
    "\"server\"\n";

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
    {"ceiling of a metre", Deployed::csv("max_correction_mm = 1000\n"), 3, "E-RT-RANGE",
     "50 at most"},
    {"model beyond the ceiling", Deployed::csv("max_correction_mm = 2.5\n"), 3, "E-RT-CEILING",
     "corrections of up to 3 mm, and [limits] max_correction_mm is 2.5"},
    {"model faster than the ceiling", Deployed::csv("max_slew_mm_s = 9\n"), 3, "E-RT-CEILING",
     "changes of up to 10 mm/s, and [limits] max_slew_mm_s is 9"},
    {"ramp shorter than the ceiling", Deployed::csv("min_ramp_s = 0.5\n"), 3, "E-RT-CEILING",
     "a ramp of only 0.1 s, and [limits] min_ramp_s is 0.5"},
    {"comparison within a metre", Deployed::csv("[sync]\nposition_um = 1e6\n"), 3, "E-RT-RANGE",
     "500 at most: beyond it another tool"},
    {"comparison within a turn", Deployed::csv("[sync]\nrotation_urad = 6e6\n"), 3, "E-RT-RANGE",
     "1000 at most: beyond it another tool"},
    {"record of no size", Deployed::csv("[record]\nmax_file_mb = 0\n"), 3, "E-RT-RANGE",
     "a whole number, 1 to 10000"},
    {"floor below nothing", Deployed::csv("[record]\nfree_space_floor_mb = -1\n"), 3, "E-RT-RANGE",
     "a whole number, 0 to 1000000"},
    {"snapshot of an hour", Deployed::csv("[record]\nbefore_s = 3600\n"), 3, "E-RT-RANGE",
     "60 at most: it is kept in memory"},
    {"unknown key of the record", Deployed::csv("[record]\nmax_age_h = 1\n"), 3, "E-RT-KEY",
     "known here: after_s, before_s, free_space_floor_mb, max_age_days"},
    {"tool of 256", Deployed::csv("[expect]\ntool = 256\n"), 3, "E-RT-RANGE", "tool"},
    {"port of 0", "schema = \"rt/1\"\n[source]\nkind = \"modbus\"\nport = 0\n", 3, "E-RT-RANGE",
     "port"},
    {"server for everyone", kServer, 3, "E-RT-PEERS", "role = \"server\""},
    {"server for nobody", kServer + "peers = []\n", 3, "E-RT-PEERS", "needs 'peers' beside it"},
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

RtRan checked(const Deployed& folder) {
  return plumb_rt({"run", folder.folder.string(), "--check"}, folder.folder);
}

TEST(RunConfig, NothingOfAFileThatTheSumsDoNotListIsParsed) {
  const Deployed folder;
  std::ofstream(folder.folder / "rt.toml") << "[cycle\n";  // behind the back of the sums
  const RtRan ran = checked(folder);
  EXPECT_EQ(ran.exit, 3);
  EXPECT_NE(ran.err.find("error[E-RT-SUMS]"), std::string::npos) << ran.err;
}

TEST(RunConfig, APipeIsNoConfiguration) {
  const Deployed folder;
  const auto file = folder.folder / "rt.toml";
  std::filesystem::remove(file);
  ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
  const RtRan ran = checked(folder);
  EXPECT_EQ(ran.exit, 3);
  EXPECT_NE(ran.err.find("rt.toml"), std::string::npos) << ran.err;
}

TEST(RunConfig, AConfigurationOfManyMegabytesIsRefusedUnread) {
  const Deployed folder;
  std::ofstream(folder.folder / "rt.toml").put('#');
  std::filesystem::resize_file(folder.folder / "rt.toml", 300u << 20);  // a file with a hole
  const RtRan ran = checked(folder);
  EXPECT_EQ(ran.exit, 3);
  EXPECT_NE(ran.err.find("rt.toml"), std::string::npos) << ran.err;
}

TEST(RunConfig, AListOfSumsThatIsMissingEmptyOrShortIsRefused) {
  const Deployed folder;
  const std::string whole = folder.text("SHA256SUMS");
  ASSERT_EQ(checked(folder).exit, 0);
  const std::string lines[] = {"", "no sum\n", whole.substr(0, whole.find('\n') + 1)};
  for (const std::string& text : lines) {
    folder.write("SHA256SUMS", text);
    const RtRan ran = checked(folder);
    EXPECT_EQ(ran.exit, 3) << text;
    EXPECT_NE(ran.err.find("error[E-RT-SUMS]"), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find("plumb-rt seal"), std::string::npos) << ran.err;
  }
  for (const char* const left_out : {"rt.toml", "robot.plumb"}) {
    std::string text, line;
    for (std::istringstream in(whole); std::getline(in, line);)
      if (line.find(left_out) == std::string::npos) text += line + "\n";
    folder.write("SHA256SUMS", text);
    EXPECT_NE(checked(folder).err.find(std::string("does not list ") + left_out), std::string::npos)
        << left_out;
  }
  std::filesystem::remove(folder.folder / "SHA256SUMS");
  EXPECT_NE(checked(folder).err.find("SHA256SUMS is missing"), std::string::npos);
}

TEST(RunConfig, AnEditedConfigurationRunsOnceItIsSealed) {
  const Deployed folder;
  const auto seal = [&](std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"seal", folder.folder.string()});
    return plumb_rt(more, folder.folder);
  };
  std::ofstream(folder.folder / "rt.toml") << Deployed::csv("target_step_mm = 20\n");
  const RtRan refused = checked(folder);
  EXPECT_EQ(refused.exit, 3);
  EXPECT_NE(refused.err.find("rt.toml is not the file that SHA256SUMS lists"), std::string::npos);
  EXPECT_NE(refused.err.find("if you edited it: plumb-rt seal"), std::string::npos) << refused.err;
  const RtRan sealed = seal();
  EXPECT_EQ(sealed.exit, 0) << sealed.err;
  EXPECT_NE(sealed.out.find("changed since the last time: rt.toml"), std::string::npos);
  EXPECT_EQ(checked(folder).exit, 0);

  std::ofstream(folder.folder / "rt.toml") << Deployed::csv("target_step_m = 20\n");
  EXPECT_EQ(seal().exit, 3) << "what plumb-rt would not run is not sealed";
  std::ofstream(folder.folder / "rt.toml") << Deployed::csv("");
  const std::string targets = folder.text("targets.csv");
  std::ofstream(folder.folder / "targets.csv") << targets << targets.substr(targets.find('\n') + 1);
  EXPECT_EQ(seal().exit, 3) << "the seal of rt.toml does not cover another file";
  EXPECT_EQ(seal({"--all"}).exit, 0);
  EXPECT_EQ(checked(folder).exit, 0);
  std::filesystem::remove(folder.folder / "SHA256SUMS");
  EXPECT_EQ(seal().exit, 3);
  EXPECT_EQ(seal({"--all"}).exit, 0);
  EXPECT_EQ(checked(folder).exit, 0);
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
  const Deployed server(Deployed::modbus_server(ntohs(address.sin_port)));
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

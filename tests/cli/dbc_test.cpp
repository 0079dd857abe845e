// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "sandbox.hpp"

namespace {

class DbcVerb : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(box.plumb({"demo", "clean", "cell"}).exit, 0);
    cell = box.read("cell/cell.toml");
  }
  void deploy_section(const std::string& text) {
    const auto at = cell.find("[deploy]");
    box.write("cell/cell.toml", cell.substr(0, at) + text);
  }
  Sandbox box;
  std::string cell;
};

TEST_F(DbcVerb, PrintsTheFileOrWritesIt) {
  const Ran printed = box.plumb({"-C", "cell", "dbc"});
  ASSERT_EQ(printed.exit, 0) << printed.err;
  EXPECT_EQ(printed.out.rfind("VERSION \"\"\n", 0), 0U);
  EXPECT_NE(printed.out.find("\nBO_ 280 target_1: 8 controller\n"), std::string::npos);
  const Ran wrote = box.plumb({"-C", "cell", "dbc", "-o", "bus.dbc"});
  ASSERT_EQ(wrote.exit, 0) << wrote.err;
  EXPECT_EQ(box.read("bus.dbc"), printed.out);
  EXPECT_NE(wrote.out.find("wrote bus.dbc\n"), std::string::npos);
}

TEST_F(DbcVerb, JsonSaysHowMuchOfTheBusItTakes) {
  const auto result = box.plumb({"-C", "cell", "dbc", "--json"}).json().at("result");
  EXPECT_EQ(result.at("messages"), 9);
  EXPECT_EQ(result.at("frames"), 23);
  EXPECT_NEAR(result.at("worst_bus_load_pct").get<double>(), 42.2, 0.05);
  EXPECT_EQ(result.at("dbc").get<std::string>(), box.plumb({"-C", "cell", "dbc"}).out);
}

TEST_F(DbcVerb, FollowsTheDeploySection) {
  deploy_section(
      "[deploy]\ncycle_us = 1000\n[deploy.bus]\ncan_format = \"fd\"\n"
      "[deploy.bus.target]\ncan_id = 0x200\n");
  const Ran ran = box.plumb({"-C", "cell", "dbc"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_NE(ran.out.find("\nBO_ 512 target: 32 controller\n"), std::string::npos);
}

TEST_F(DbcVerb, RefusesABusThatWouldBeTooFull) {
  deploy_section("[deploy]\ncycle_us = 1000\n");
  const Ran ran = box.plumb({"-C", "cell", "dbc"});
  EXPECT_EQ(ran.exit, 3);
  EXPECT_NE(ran.err.find("error[E-CELL-BUS]: at worst the messages take "), std::string::npos)
      << ran.err;
  EXPECT_EQ(ran.out, "");
  EXPECT_EQ(box.plumb({"-C", "cell", "check"}).exit, 0);  // whoever has no bus need not care
  EXPECT_EQ(box.plumb({"-C", "cell", "modbus-map"}).exit, 0);
}

TEST_F(DbcVerb, BadTablesAreToldWhereTheyStand) {
  deploy_section("[deploy]\ncycle_us = 4000\n[deploy.bus.target]\ncan_id = 0x122\nperod_us = 1\n");
  Ran ran = box.plumb({"-C", "cell", "dbc"});
  EXPECT_EQ(ran.exit, 3);
  EXPECT_NE(ran.err.find("E-CELL-KEY"), std::string::npos) << ran.err;
  EXPECT_NE(ran.err.find("rename it to 'period_us'"), std::string::npos) << ran.err;
  deploy_section(
      "[deploy]\n[deploy.bus.target]\ncan_id = 0x122\n[deploy.bus.joints]\nregister = 1\n");
  ran = box.plumb({"-C", "cell", "dbc"});
  EXPECT_EQ(ran.exit, 3);
  EXPECT_NE(ran.err.find("error[E-CELL-BUS]: joints (0x120 to 0x122) and target (0x122 to 0x124) "
                         "share identifiers"),
            std::string::npos)
      << ran.err;
  deploy_section("[deploy]\nmax_correction_mm = 5\n[deploy.bus]\ncorrection = \"offset\"\n");
  ran = box.plumb({"-C", "cell", "dbc"});
  EXPECT_NE(ran.err.find("help: [deploy.bus.offset] count_um = 0.2"), std::string::npos) << ran.err;
}

}  // namespace

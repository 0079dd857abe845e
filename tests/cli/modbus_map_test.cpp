// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "sandbox.hpp"

namespace {

TEST(ModbusMapVerb, PrintsMarkdownOrCsvOrWritesIt) {
  const Sandbox box;
  ASSERT_EQ(box.plumb({"demo", "clean", "cell"}).exit, 0);
  const Ran printed = box.plumb({"-C", "cell", "modbus-map"});
  ASSERT_EQ(printed.exit, 0) << printed.err;
  EXPECT_EQ(printed.out.rfind("# Modbus map: ", 0), 0U);
  ASSERT_EQ(box.plumb({"-C", "cell", "modbus-map", "-o", "map.md"}).exit, 0);
  EXPECT_EQ(box.read("map.md"), printed.out);
  ASSERT_EQ(box.plumb({"-C", "cell", "modbus-map", "--csv", "-o", "map.csv"}).exit, 0);
  const Csv csv = box.csv("map.csv");
  EXPECT_EQ(csv.header.front(), "register");
  EXPECT_EQ(csv.columns.at("message").front(), "controller");
  EXPECT_EQ(csv.columns.at("register").front(), "1096");
}

TEST(ModbusMapVerb, FollowsTheDeploySection) {
  const Sandbox box;
  ASSERT_EQ(box.plumb({"demo", "clean", "cell"}).exit, 0);
  const std::string cell = box.read("cell/cell.toml");
  box.write("cell/cell.toml", cell.substr(0, cell.find("[deploy]")) +
                                  "[deploy]\nlink = \"modbus\"\ncycle_us = 1000\n"
                                  "[deploy.bus]\nword_order = \"little\"\n"
                                  "[deploy.bus.target]\nregister = 40\n");
  const Ran ran = box.plumb({"-C", "cell", "modbus-map"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_NE(ran.out.find("\n| 40 | x | int32 | um | 1 |  |\n"), std::string::npos) << ran.out;
  EXPECT_NE(ran.out.find("the first holds the low word"), std::string::npos);
}

}  // namespace

// SPDX-License-Identifier: Apache-2.0
#include "rt/restart_reasons.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/drivers/deployed.hpp"
#include "tests/drivers/rt/problem_of.hpp"

namespace plumb::drivers::rt {
namespace {

using Reasons = std::vector<std::string>;

class RestartReasons : public testing::Test {
 protected:
  static Reasons sorted(Reasons reasons) {
    std::sort(reasons.begin(), reasons.end());
    return reasons;
  }
  Reasons reasons() const { return sorted(restart_reasons(running.folder, next.folder)); }
  void list(const tests::Deployed& folder, const std::string& line) const {
    std::ofstream(folder.folder / "SHA256SUMS", std::ios::app) << line << "\n";
  }
  const tests::Deployed running, next;
};

const std::string kSum(64, 'a'), kOther(64, 'b');

TEST_F(RestartReasons, AnotherModelAndItsTableAreNone) {
  EXPECT_EQ(reasons(), Reasons{});
  format::Model model = tests::Deployed::arm();
  model.calibrated.joints[0].a += 1e-4;
  next.write_model("robot.plumb", model);
  next.write("rt.toml", tests::Deployed::csv("[model]\nmade = \"2026-11-28T00:00:00Z\"\n"));
  EXPECT_EQ(reasons(), Reasons{});
}

/// Which of the two runs does not matter: what differs differs for both.
TEST_F(RestartReasons, EveryKeyThatDiffersIsNamedOnceWithItsTableInBothDirections) {
  next.write("rt.toml",
             tests::Deployed::csv("limited_scale = 0.5\n[log]\nmetrics_port = 9100\n"
                                  "[sync]\nposition_um = 300\n[model]\nserial = \"UR-1\"\n"));
  const Reasons wanted{"[limits] limited_scale", "log", "sync"};
  EXPECT_EQ(reasons(), wanted);
  EXPECT_EQ(sorted(restart_reasons(next.folder, running.folder)), wanted);
}

TEST_F(RestartReasons, TheOrderOfTablesAndKeysRemarksAndSpacesAreNone) {
  running.write("rt.toml",
                "schema = \"rt/1\"\n[cycle]\ncycle_us = 1000\npriority = 0\n"
                "[limits]\nmode = \"full\"\nmax_change_mm = 5\n");
  next.write("rt.toml",
             "# a remark\nschema   = \"rt/1\"\n[limits]\nmax_change_mm = 5\n\n"
             "mode = 'full'\n[cycle]\npriority = 0\ncycle_us = 1000\n");
  EXPECT_EQ(reasons(), Reasons{});
}

TEST_F(RestartReasons, AFileThatDecidesIsNamedIfItDiffersOrIsInOneOfThemOnly) {
  list(running, kSum + "  urdf/arm.urdf");
  list(next, kOther + "  urdf/arm.urdf");
  list(running, kSum + "  gone.csv");
  list(next, kSum + "  new.csv");
  list(running, kSum + "  same.csv");
  list(next, kSum + "  same.csv");
  EXPECT_EQ(reasons(), (Reasons{"gone.csv", "new.csv", "urdf/arm.urdf"}));
}

TEST_F(RestartReasons, WhatPeopleReadIsNone) {
  list(running, kSum + "  robot.dbc");
  list(next, kOther + "  robot.dbc");
  list(next, kSum + "  registers.md");
  EXPECT_EQ(reasons(), Reasons{});
}

/// sha256sum -b marks its files by a star; plumb-rt runs such a folder.
TEST_F(RestartReasons, HowAListMarksItsFilesIsNone) {
  std::string sums = next.text("SHA256SUMS");
  for (std::size_t at = sums.find("  "); at != std::string::npos; at = sums.find("  ", at))
    sums.replace(at, 2, " *");
  std::ofstream(next.folder / "SHA256SUMS") << sums;
  EXPECT_EQ(reasons(), Reasons{});
}

TEST_F(RestartReasons, AnotherSpellingOfTheModelsNameIsNone) {
  format::Model model = tests::Deployed::arm();
  model.calibrated.joints[0].a += 1e-4;
  next.write_model("robot.plumb", model);
  next.write("rt.toml", tests::Deployed::csv("[model]\nfile = \"./robot.plumb\"\n"));
  EXPECT_EQ(reasons(), Reasons{});
}

TEST_F(RestartReasons, AFolderThatCannotBeReadIsRefusedWhicheverItIs) {
  const auto code = [](const auto& a, const auto& b) {
    return tests::problem_of([&] { std::ignore = restart_reasons(a.folder, b.folder); }).code;
  };
  std::ofstream(next.folder / "rt.toml") << "schema = rt/1\n";
  EXPECT_EQ(code(running, next), "E-TOML");
  EXPECT_EQ(code(next, running), "E-TOML");
  next.write("rt.toml", tests::Deployed::csv(""));
  std::filesystem::remove(next.folder / "SHA256SUMS");
  EXPECT_EQ(code(running, next), "E-RT-SUMS");
  EXPECT_EQ(code(next, running), "E-RT-SUMS");
}

}  // namespace
}  // namespace plumb::drivers::rt

// SPDX-License-Identifier: Apache-2.0
#include "rt/install_checks.hpp"

#include <gtest/gtest.h>

#include "rt/utc.hpp"
#include "tests/drivers/rt/placed.hpp"
#include "tests/drivers/rt/problem_of.hpp"

namespace plumb::drivers::rt {
namespace {

namespace fs = std::filesystem;
using Older = InstallRequest::Older;

std::string hours_from_now(int hours) {
  return utc_second(utc_ns() / 1'000'000'000 + 3600LL * hours);
}

class InstallChecks : public testing::Test {
 protected:
  InstallRequest request(Older older = Older::kRefused) const {
    InstallRequest out;
    out.change.place = placed.place;
    out.change.etc = placed.etc;
    out.from = "the new one";
    out.older = older;
    return out;
  }
  static PlaceBefore before(const std::string& current, const std::string& newest) {
    PlaceBefore out;
    out.current = current;
    out.history.newest_made = newest;
    return out;
  }
  Problem older_fault(const std::string& made, const std::string& newest,
                      const std::string& id = std::string(16, 'd')) const {
    return tests::problem_of(
        [&] { refuse_older(request(), made, id, before(std::string(16, 'c'), newest)); });
  }
  tests::Placed placed;
};

/// Times, oldest first; a folder that does not say when it was made is older than all that do.
TEST_F(InstallChecks, AFolderIsRefusedExactlyIfItWasMadeBeforeTheNewest) {
  const std::vector<std::string> times{"",
                                       "2019-01-01T00:00:00Z",
                                       "2026-11-25T09:59:59Z",
                                       "2026-11-25T10:00:00Z",
                                       "2026-12-01T00:00:00Z",
                                       "2031-01-01T00:00:00Z"};
  for (std::size_t made = 0; made < times.size(); ++made)
    for (std::size_t newest = 0; newest < times.size(); ++newest) {
      const Problem problem = older_fault(times[made], times[newest]);
      EXPECT_EQ(problem.code, made < newest ? "E-RT-OLDER" : "") << made << " " << newest;
      if (made >= newest) continue;
      EXPECT_NE(problem.message.find(times[newest]), std::string::npos) << problem.message;
      EXPECT_NE(problem.message.find("the new one"), std::string::npos) << problem.message;
    }
}

TEST_F(InstallChecks, WhoMeansItOrInstallsWhatIsCurrentIsNotRefused) {
  const std::string old = "2020-01-01T00:00:00Z", recent = "2026-01-01T00:00:00Z", id(16, 'c');
  refuse_older(request(Older::kAllowed), old, "another", before(id, recent));
  refuse_older(request(), old, id, before(id, recent));
  EXPECT_EQ(older_fault(old, recent).code, "E-RT-OLDER");
}

TEST_F(InstallChecks, AVersionThatIsStillThereIsGoneBackToAndAnotherOneIsMeant) {
  const tests::Deployed folder;
  const std::string id = placed.add(folder);
  const std::string there = older_fault("", "2026-01-01T00:00:00Z", id).help;
  EXPECT_NE(there.find("plumb-rt rollback --to "), std::string::npos) << there;
  EXPECT_NE(there.find("--version " + id), std::string::npos) << there;
  const std::string elsewhere = older_fault("", "2026-01-01T00:00:00Z").help;
  EXPECT_NE(elsewhere.find("--older"), std::string::npos) << elsewhere;
  EXPECT_EQ(elsewhere.find("rollback"), std::string::npos) << elsewhere;
}

/// The message must not send a person to look for an older folder where a clock is to blame.
TEST_F(InstallChecks, AClockIsNamedWhereOneLooksWrongAndOnlyThere) {
  const auto blames_clock = [&](const std::string& made, const std::string& newest) {
    return older_fault(made, newest).message.find("clock") != std::string::npos;
  };
  const std::string usual = "2026-01-01T00:00:00Z";
  EXPECT_TRUE(blames_clock(usual, hours_from_now(25))) << "made tomorrow";
  EXPECT_TRUE(blames_clock("1970-01-01T00:00:09Z", usual)) << "a clock without a battery";
  EXPECT_FALSE(blames_clock(usual, hours_from_now(23))) << "a time zone away";
  EXPECT_FALSE(blames_clock("2020-01-01T00:00:00Z", usual));
  EXPECT_FALSE(blames_clock("", usual)) << "it does not say";
}

TEST_F(InstallChecks, ANewFolderOfTheFutureIsTakenAndSaid) {
  const auto remarks_of = [&](const std::string& made) {
    Outcome outcome;
    warn_of_clock(request(), made, outcome);
    return outcome.remarks;
  };
  const std::string made = hours_from_now(25);
  const auto remarks = remarks_of(made);
  ASSERT_EQ(remarks.size(), 1U);
  EXPECT_EQ(remarks[0].code, "W-RT-CLOCK");
  EXPECT_EQ(remarks[0].severity, Severity::kWarning);
  EXPECT_NE(remarks[0].message.find(made), std::string::npos) << remarks[0].message;
  for (const std::string& usual : {std::string(), hours_from_now(23), hours_from_now(-9000)})
    EXPECT_TRUE(remarks_of(usual).empty()) << usual;
}

TEST_F(InstallChecks, APlaceTakesTheFoldersOfItsOwnRobotOnly) {
  const tests::Deployed own, better, other;
  better.write_model("robot.plumb", tests::arm_shifted(1e-4));
  format::Model model = tests::Deployed::arm();
  model.serial = "UR-2";
  other.write_model("robot.plumb", model);
  const auto fault = [&](const tests::Deployed& next, const std::string& current) {
    return tests::problem_of(
        [&] { refuse_other_robot(request(), load_deployment(next.folder), before(current, "")); });
  };
  const std::string id = placed.add(own);
  EXPECT_EQ(fault(better, id).code, "");
  const Problem problem = fault(other, id);
  EXPECT_EQ(problem.code, "E-RT-SERIAL");
  for (const char* const robot : {"made for robot 'UR-2'", "that of robot 'UR-1'"})
    EXPECT_NE(problem.message.find(robot), std::string::npos) << problem.message;
  EXPECT_EQ(fault(other, "").code, "") << "nothing is installed there";
  fs::permissions(placed.place.version(id), fs::perms::owner_all);
  fs::remove(placed.place.version(id) / "robot.plumb");
  EXPECT_EQ(fault(other, id).code, "") << "it cannot be told any more, and is mended";
}

}  // namespace
}  // namespace plumb::drivers::rt

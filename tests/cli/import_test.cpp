// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "sandbox.hpp"

namespace {

TEST(ImportVerb, TheHelpOfAMissingUnitIsACommandThatWorks) {
  const Sandbox box;
  ASSERT_EQ(box.plumb({"demo", "clean", "cell"}).exit, 0);
  box.write("tracker.csv", "pose,q1_deg,x,y_mm\nA,1,2.5,3\nB,4,5,6\n");
  const Ran refused = box.plumb({"import", "tracker.csv"});
  EXPECT_EQ(refused.exit, 3);
  EXPECT_NE(refused.err.find("--map \"x=x_mm\""), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("tracker.csv:1:13"), std::string::npos) << refused.err;
  const Ran done =
      box.plumb({"import", "tracker.csv", "--map", "x=x_mm", "-o", "out.csv", "--json"});
  ASSERT_EQ(done.exit, 0) << done.err;
  EXPECT_EQ(done.json().at("result").at("rows"), 2);
  EXPECT_EQ(box.csv("out.csv").columns.at("x_mm"), (std::vector<std::string>{"2.5", "5"}));
}

TEST(ImportVerb, APreviewWritesNothingAndAsksNothing) {
  const Sandbox box;
  box.write("tracker.txt", "Report\n\nJoint 1;X\n1,5;2,25\n2,5;3,25\n");
  const auto before = box.listing();
  const Ran ran = box.plumb({"import", "tracker.txt", "--preview"});
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_EQ(ran.out.find("Understood 2 rows; separated by semicolon, decimal comma."), 0U);
  EXPECT_NE(ran.out.find("x_?"), std::string::npos) << ran.out;
  EXPECT_EQ(box.listing(), before);
  const auto result =
      box.plumb({"import", "tracker.txt", "--preview", "--json"}).json().at("result");
  EXPECT_EQ(result.at("dry_run"), true) << "for programs a preview is a dry run";
  EXPECT_TRUE(result.at("files").empty());
}

TEST(ImportVerb, ReplacesNothingWithoutForceAndKeepsTheFirstFileWhole) {
  const Sandbox box;
  box.write("log.csv", "q1_deg,x_mm\n1,2\n");
  box.write("measurements.csv", "precious\n");
  const Ran ran = box.plumb({"import", "log.csv"});
  EXPECT_EQ(ran.exit, 2);
  EXPECT_NE(ran.err.find("E-EXISTS"), std::string::npos) << ran.err;
  EXPECT_EQ(box.read("measurements.csv"), "precious\n");
  EXPECT_EQ(box.plumb({"import", "log.csv", "--force"}).exit, 0);
  EXPECT_NE(box.read("measurements.csv").find("q1_deg,x_mm\n1,2\n"), std::string::npos);
}

TEST(ImportVerb, RowsWithoutAMeasurementAreLeftOutWhenAskedForAndListed) {
  const Sandbox box;
  for (const char* none : {"---", "NaN", "", "n/a", "inf"}) {
    const std::string cell = none;
    box.write("log.csv",
              "q1_deg,x_mm,note\n0,1,a\n10," + cell + ",b\n10,3,---\n" + cell + ",4,c\n5,5,\n");
    const Ran refused = box.plumb({"import", "log.csv", "-o", "out.csv", "--force"});
    EXPECT_EQ(refused.exit, 3) << cell;
    EXPECT_NE(refused.err.find("--skip-bad"), std::string::npos) << cell << refused.err;
    const Ran ran = box.plumb({"import", "log.csv", "-o", "out.csv", "--force", "--skip-bad"});
    EXPECT_EQ(ran.exit, 0) << cell << ran.err;
    EXPECT_NE(ran.err.find("W-IMPORT-SKIPPED"), std::string::npos) << cell << ran.err;
    EXPECT_NE(ran.err.find("lines 3, 5"), std::string::npos) << cell << ran.err;
    EXPECT_EQ(box.csv("out.csv").numbers("x_mm"), (std::vector<double>{1, 3, 5})) << cell;
  }
  box.write("log.csv", "q1_deg,x_mm\n---,1\n---,2\n3,---\n");
  EXPECT_EQ(box.plumb({"import", "log.csv", "-o", "o.csv", "--skip-bad"}).exit, 3);
  EXPECT_EQ(
      box.plumb({"import", "log.csv", "-o", "o.csv", "--skip-bad", "--dir", "from-order"}).exit, 2);
}

TEST(ImportVerb, ConsecutiveMovesGetTheirDirections) {
  const Sandbox box;
  box.write("log.csv", "q1_deg,x_mm\n0,1\n10,2\n10,3\n4,4\n");
  ASSERT_EQ(box.plumb({"import", "log.csv", "--dir", "from-order", "-o", "out.csv"}).exit, 0);
  const Csv csv = box.csv("out.csv");
  EXPECT_EQ(csv.columns.at("dir_j1"), (std::vector<std::string>{"0", "1", "1", "-1"}));
  EXPECT_EQ(csv.numbers("travel_j1_deg"), (std::vector<double>{0, 10, 10, 6}));
}

TEST(ImportVerb, BadFilesEndWithCodeThreeAndNothingWritten) {
  const Sandbox box;
  box.write("empty.csv", "");
  box.write("binary.csv", std::string("\x7f"
                                      "ELF\0\0\1",
                                      7));
  box.write("ragged.csv", "q1_deg,x_mm\n1,2\n3\n");
  const auto before = box.listing();
  for (const char* file : {"empty.csv", "binary.csv", "ragged.csv", "missing.csv", "."}) {
    const Ran ran = box.plumb({"import", file, "--json"});
    EXPECT_EQ(ran.exit, 3) << file;
    EXPECT_FALSE(ran.json().at("ok").get<bool>());
    EXPECT_NE(ran.err.find("help:"), std::string::npos) << file << ran.err;
  }
  EXPECT_EQ(box.listing(), before);
}

TEST(ImportVerb, WithoutJointsOrPointsNothingIsWrittenAndTheNextTryWorks) {
  const Sandbox box;
  box.write("log.csv", "pose,S1,S2,Px,Py,Pz\nA,10,90,1000,2,3\nB,4,80,900,5,6\n");
  const auto before = box.listing();
  const Ran refused = box.plumb({"import", "log.csv"});
  EXPECT_EQ(refused.exit, 3) << refused.out;
  EXPECT_NE(refused.err.find("E-IMPORT-MISSING"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("columns not used: S1, S2, Px, Py, Pz"), std::string::npos)
      << refused.err;
  EXPECT_EQ(box.listing(), before);
  EXPECT_EQ(box.plumb({"import", "log.csv", "--preview"}).exit, 0);
  EXPECT_EQ(box.listing(), before);
  const auto first = refused.err.find("--map \"", refused.err.find("E-IMPORT-MISSING")) + 7;
  const std::string map = refused.err.substr(first, refused.err.find('"', first) - first);
  const Ran done = box.plumb({"import", "log.csv", "--map", map});
  EXPECT_EQ(done.exit, 0) << done.err;
  EXPECT_EQ(box.csv("measurements.csv").columns.at("x_mm"),
            (std::vector<std::string>{"1000", "900"}));
}

TEST(ImportVerb, OneMapServesTwoFiles) {
  const Sandbox box;
  box.write("joints.csv", "pose,S1\nA,10\nB,20\n");
  box.write("tracker.csv", "pose,Xm\nA,1000\nB,900\n");
  const Ran done = box.plumb(
      {"import", "joints.csv", "tracker.csv", "--join", "pose", "--map", "S1=q1_deg,Xm=x_mm"});
  ASSERT_EQ(done.exit, 0) << done.err;
  EXPECT_EQ(box.csv("measurements.csv").columns.at("x_mm"),
            (std::vector<std::string>{"1000", "900"}));
  const Ran wrong = box.plumb({"import", "joints.csv", "tracker.csv", "--map", "S2=q1_deg"});
  EXPECT_EQ(wrong.exit, 2);
  EXPECT_NE(wrong.err.find("E-IMPORT-MAP"), std::string::npos) << wrong.err;
}

TEST(ImportVerb, OptionsThatCannotBeMeantAreRefused) {
  const Sandbox box;
  box.write("log.csv", "q1_deg,x_mm\n1,2\n");
  EXPECT_EQ(box.plumb({"import", "log.csv", "--join", "pose"}).exit, 2);
  EXPECT_EQ(box.plumb({"import", "log.csv", "--rot", "abc"}).exit, 2);
  EXPECT_EQ(box.plumb({"import", "log.csv", "--date", "abc"}).exit, 2);
}

TEST(ImportVerb, AsksForTheOrderOfDayAndMonthWhereItMatters) {
  const Sandbox box;
  box.write("log.csv", "Time,q1_deg,x_mm\n03/04/2022 16:57,1,2\n04/04/2022 16:57,2,3\n");
  const Ran asked = box.plumb({"import", "log.csv"});
  EXPECT_EQ(asked.exit, 3);
  EXPECT_NE(asked.err.find("E-IMPORT-DATE"), std::string::npos) << asked.err;
  ASSERT_EQ(box.plumb({"import", "log.csv", "--date", "month-first"}).exit, 0);
  EXPECT_EQ(box.csv("measurements.csv").numbers("t_s"), (std::vector<double>{0, 31 * 86400.0}));
}

}  // namespace

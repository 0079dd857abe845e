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

}  // namespace

// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/import/imported_text.hpp"

namespace plumb::offline {
namespace {

using tests::imported_text;
using tests::in_short;
using tests::refusal_of;
using tests::remark_of;

constexpr const char* kRows = "pose=A|B q1_deg=1.5|2.5 x_mm=10.5|20.5";

TEST(OtherLines, LinesAboveBetweenAndBelowTheRowsAreNoRows) {
  const char* texts[] = {
      "Date;2026-03-04\nTemperature;20.1\n\npose;q1_deg;x_mm\nA;1.5;10.5\nB;2.5;20.5\n",
      "Report\nOperator: me\nTemperature: 20.1\npose,q1_deg,x_mm\nA,1.5,10.5\nB,2.5,20.5\n",
      "# robot: arm\n# serial: 1 2\npose q1_deg x_mm\nA 1.5 10.5\nB 2.5 20.5\n",
      "// Units: mm  Frame: A::WORLD\npose q1_deg x_mm\nA 1.5 10.5\nB 2.5 20.5\n",
      "pose;q1;x\n;deg;mm\nA;1.5;10.5\nB;2.5;20.5\n",
      "pose;q1;x\n-;[deg];[mm]\n---;---;---\nA;1.5;10.5\nB;2.5;20.5\n",
      "pose,q1_deg,x_mm\n====\nA,1.5,10.5\nB,2.5,20.5\n====\n",
      "pose,q1_deg,x_mm\nA,1.5,10.5\npose,q1_deg,x_mm\nB,2.5,20.5\n",
      "pose;q1;x\n;deg;mm\nA;1.5;10.5\n\npose;q1;x\n;deg;mm\nB;2.5;20.5\n",
      "pose,q1_deg,x_mm\nA,1.5,10.5\nsecond series\nB,2.5,20.5\n",
      "pose,q1_deg,x_mm\nA,1.5,10.5\nB,2.5,20.5\n,,\n,,\n",
      "pose,q1_deg,x_mm\nA,1.5,10.5\nB,2.5,20.5\n2 points\n",
      "pose,q1_deg,x_mm\nA,1.5,10.5\nB,2.5,20.5\nMean,2.0,15.5\nStd. Dev.,0.7,7\n",
      "pose,q1_deg,x_mm\nA,1.5,10.5\nB,2.5,20.5\n\nMittelwert,2.0,15.5\nStabw.,0.7,7\nMax,9,9\n",
      "pose,q1_deg,x_mm\nA,1.5,10.5\nB,2.5,20.5\nMin,1.5,10.5\nMax,2.5,20.5\n",
      ("pose,q1_deg,x_mm\nA,1.5,10.5\nB,2.5,20.5\nMoyenne,2.0,15.5\n\xC3\x89"
       "cart-type,1,7\n"),
      "pose,q1_deg,x_mm\nA,1.5,10.5\nB,2.5,20.5\nRMS: 0.02\n",
      "pose,q1_deg,x_mm\r\nA,1.5,10.5\r\nB,2.5,20.5\r\n\x1A",
      "pose,q1_deg,x_mm\nA,1.5,10.5\nB,2.5,20.5\n\x1A\x1A\n",
      "Units: millimeters, degrees\npose,q1,x\nA,1.5,10.5\nB,2.5,20.5\n",
      "Units in mm and deg\n\npose\tq1\tx\nA\t1.5\t10.5\nB\t2.5\t20.5\n",
      ";deg;mm\npose;q1;x\nA;1.5;10.5\nB;2.5;20.5\n",
      "pose;q1\xC2\xB0;x mm\nA;1.5;10.5\nB;2.5;20.5\n",
      "pose;q1 [\xC2\xBA];x {mm}\nA;1.5;10.5\nB;2.5;20.5\n",
      "pose;q1_deg;x_mm;nr\nA;1.5;10.5;1\nB;2.5;20.5;2\n;2;15;Mean\n;1;7;Std\n",
      "Length unit: mm\nAngle unit: deg\npose,q1,x\nA,1.5,10.5\nB,2.5,20.5\n",
      "Einheiten;mm;Grad\npose;q1;x\nA;1,5;10,5\nB;2,5;20,5\n",
  };
  for (const char* text : texts) {
    const Problem refused = refusal_of(text);
    ASSERT_EQ(refused.code, "") << refused.message << "\n" << text;
    EXPECT_EQ(in_short(imported_text(text)), kRows) << text;
  }
}

TEST(OtherLines, TheyAreNamedByTheirNumbers) {
  const auto said = [](const std::string& text, const char* code) {
    return remark_of(imported_text(text), code);
  };
  EXPECT_NE(said("Date;2026-03-04\nT;20.1\npose;q1_deg;x_mm\nA;1;2\nB;3;4\n", "N-IMPORT-PREAMBLE")
                .find("lines 1, 2"),
            std::string::npos);
  EXPECT_NE(said("q1_deg,x_mm\n1,2\nq1_deg,x_mm\n3,4\n", "N-IMPORT-LINES").find("line 3"),
            std::string::npos);
  EXPECT_NE(
      said("pose,q1_deg,x_mm\nA,1,2\nB,2,3\nMean,1,2\nStd,1,2\nMax,1,2\n", "N-IMPORT-STATISTICS")
          .find("lines 4 to 6"),
      std::string::npos);
  EXPECT_NE(said("Units: m, rad\nq1,x\n1,2\n", "N-IMPORT-STATED").find("line 1 says"),
            std::string::npos);
}

TEST(OtherLines, AMeasurementIsNeverOneOfThem) {
  EXPECT_EQ(imported_text("pose,q1_deg,x_mm\nhome,1,2\nmax,5,6\nmin,7,8\n").rows(), 3);
  EXPECT_EQ(imported_text("pose,q1_deg,x_mm\nmean,1,2\nA,5,6\n").rows(), 2);
  EXPECT_EQ(refusal_of("q1_deg,x_mm\n1,2\n3\n").code, "E-IMPORT-RAGGED");
  EXPECT_EQ(refusal_of("pose,q1_deg,x_mm\nA,1,2\nB,3\n").code, "E-IMPORT-RAGGED");
  EXPECT_EQ(refusal_of("pose,q1_deg,x_mm\nA,1\nB,3,4\nC,5,6\n").place->line, 2);
}

TEST(OtherLines, TwoUnitsOfOneKindAboveTheTableDecideNothing) {
  EXPECT_EQ(refusal_of("Units: mm, m\nq1_deg,x\n1,2\n").code, "E-IMPORT-UNIT");
  EXPECT_EQ(in_short(imported_text("Units: mm\nq1_deg,x_m\n1,2\n")), "q1_deg=1 x_m=2");
}

TEST(OtherLines, AllRowsWithTooFewCellsAreNamedAtOnce) {
  try {
    (void)imported_text("pose,q1_deg,x_mm\nA,1,2\nB,3\nC,4,5\nD,6,7\nE,8,9,10\n");
    FAIL();
  } catch (const Failure& f) {
    ASSERT_EQ(f.problems().size(), 2u);
    EXPECT_EQ(f.problems()[1].place->line, 6);
  }
}

TEST(OtherLines, AllThatIsWrongIsSaidAtOnce) {
  try {
    (void)imported_text("q1_deg,x,y_mm\n1,oops,2\n1,2,3,4\nbad,3,4\n");
    FAIL();
  } catch (const Failure& f) {
    std::string codes;
    for (const auto& problem : f.problems()) codes += problem.code.substr(9) + " ";
    EXPECT_EQ(codes, "RAGGED UNIT NUMBER NUMBER ");
  }
}

TEST(OtherFormats, AreNamed) {
  const std::pair<const char*, const char*> table[] = {
      {"<?xml version=\"1.0\"?>\n<a><p x=\"1\"/></a>\n", "XML"},
      {"[{\"q1\":1,\"x\":2},{\"q1\":3,\"x\":4}]\n", "JSON"},
      {"header:\n  stamp:\n    sec: 1\nposition:\n- 0.1\n- 0.2\n---\n", "YAML"}};
  for (const auto& [text, format] : table)
    EXPECT_EQ(refusal_of(text).message, std::string("this is ") + format + ", no table");
}

TEST(Headerless, TheOrderIsProposedAndPointsWithCollectionsAreKnown) {
  EXPECT_NE(refusal_of("A 10.5 20 30 100 90 80\nB 1 2 3 4 5 6\n")
                .help.find("--header \"pose,q1_deg,q2_deg,q3_deg,q4_deg"),
            std::string::npos);
  EXPECT_NE(refusal_of("1000.5,900,800\n1,2,3\n").help.find("--header \"x_mm,y_mm,z_mm\""),
            std::string::npos);
  EXPECT_EQ(in_short(imported_text("// Units: mm  Frame: A::W\nA::r::p1  1.5  2.5  3\n")),
            "pose=A::r::p1 x_mm=1.5 y_mm=2.5 z_mm=3");
  EXPECT_EQ(refusal_of("A::r::p1  1.5  2.5  3\nA::r::p2  1.5  2.5  3\n").code, "E-IMPORT-UNIT");
}

TEST(VectorCells, EachNumberBecomesAColumn) {
  const char* texts[] = {
      "time_s,joints [rad],position [m]\n0,\"[0.1, 0.2]\",\"[1, 2, 3]\"\n",
      "time_s;joints [rad];position [m]\n0;[0.1 0.2];[1 2 3]\n",
      "time_s,joints [rad],position [m]\n0,[0.1, 0.2],[1, 2, 3]\n",
      "time_s;joints [rad];position [m]\n0;(0.1, 0.2);(1, 2, 3)\n",
  };
  for (const char* text : texts)
    EXPECT_EQ(in_short(imported_text(text)), "t_s=0 q1_rad=0.1 q2_rad=0.2 x_m=1 y_m=2 z_m=3")
        << text;
}

}  // namespace
}  // namespace plumb::offline

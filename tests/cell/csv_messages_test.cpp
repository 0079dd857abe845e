// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "cell/measurement_reader.hpp"
#include "cell/measurements.hpp"
#include "cell/table_file.hpp"
#include "support.hpp"

namespace plumb::offline {
namespace {

std::vector<Problem> of_table(const std::string& text) {
  return problems_of([&] { parse_table(text, "t.csv"); });
}

/// What read_measurements says of a two-joint arm's file.
std::vector<Problem> of_arm(const std::string& text, Needs needs = Needs::kJointsAndPosition) {
  const Folder folder;
  const auto file = folder.put("t.csv", text);
  return problems_of([&] { read_measurements({file}, {true, true}, needs); });
}

std::vector<Problem> remarks_of_arm(const std::string& text) {
  const Folder folder;
  const auto file = folder.put("t.csv", text);
  return read_measurements({file}, {true, true}, Needs::kJointsAndPosition).tables[0].remarks;
}

TEST(CsvMessage, OfAMissingUnitIsTheExampleOfTheInterface) {
  const auto problems =
      problems_of([] { parse_table("pose,q1_deg,q2_deg,x,y_mm\nA,1,2,3,4\n", "tracker.csv"); });
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(render(problems[0]),
            "error[E-CSV-UNIT]: column 'x' has no unit\n"
            "  --> tracker.csv:1:20\n"
            "   |\n"
            " 1 | pose,q1_deg,q2_deg,x,y_mm\n"
            "   |                    ^ add a unit suffix\n"
            "   = help: rename it to 'x_mm', or: plumb import tracker.csv --map x=x_mm");
}

TEST(CsvMessage, ProposesTheUsualUnitAndQuotesForTheShell) {
  EXPECT_EQ(of_table("q1\n1\n")[0].help,
            "rename it to 'q1_deg', or: plumb import t.csv --map q1=q1_deg");
  EXPECT_EQ(of_table("payload\n1\n")[0].help,
            "rename it to 'payload_kg', or: plumb import t.csv --map payload=payload_kg");
  EXPECT_EQ(of_table("Goal x\n1\n")[0].help,
            "rename it to 'Goal_x_mm', or: plumb import t.csv --map 'Goal x=Goal_x_mm'");
}

TEST(CsvMessage, OfAMisspeltNameWithoutUnitProposesTheKnownOne) {
  const auto help = [](const std::string& header) { return of_table(header + "\n1\n")[0].help; };
  EXPECT_EQ(help("psoe"), "rename it to 'pose', or: plumb import t.csv --map psoe=pose");
  EXPECT_EQ(help("Pose"), "rename it to 'pose', or: plumb import t.csv --map Pose=pose");
  EXPECT_EQ(help("Q1"), "rename it to 'q1_deg', or: plumb import t.csv --map Q1=q1_deg");
  EXPECT_EQ(help("direction_j3"),
            "rename it to 'dir_j3', or: plumb import t.csv --map direction_j3=dir_j3");
  EXPECT_EQ(help("payload_cx"),
            "rename it to 'payload_cx_mm', or: plumb import t.csv --map payload_cx=payload_cx_mm");
  EXPECT_EQ(of_table("psoe\n1\n")[0].place->label, "did you mean 'pose'?");
  EXPECT_EQ(help("Q1_DEG"), "did you mean 'q1_deg'?");
}

/// No unit helps a column of texts, however its heading looks.
TEST(CsvMessage, OfTextsUnderAHeadingWithoutUnitNeverProposesAUnit) {
  for (const char* header : {"operator", "tool_id", "Serial no.", "name", "x", "load", "part_no"}) {
    const auto problems =
        of_table(std::string("pose,") + header + ",y_mm\nA,,1\nB,Anna,2\nC,S-12,3\n");
    EXPECT_EQ(summary(problems), Summary{"E-CSV-TEXT 1:6"}) << header;
    EXPECT_EQ(
        problems[0].message,
        fmt::format("column '{}' holds texts such as 'Anna', which plumb does not read", header));
    EXPECT_EQ(problems[0].help,
              "remove it, or rename it to 'note': a column of that name may hold any text");
  }
}

TEST(CsvMessage, OfSeveralColumnsOfTextsOnlyOneCanBeTheNote) {
  const auto problems = of_table("operator,x,tool,y_mm\nAnna,1,T1,2\nBert,n/a,T2,bad\n");
  EXPECT_EQ(summary(problems),
            (Summary{"E-CSV-TEXT 1:1", "E-CSV-UNIT 1:10", "E-CSV-TEXT 1:12", "E-CSV-NUMBER 3:13"}));
  EXPECT_EQ(problems[1].help, "rename it to 'x_mm', or: plumb import t.csv --map x=x_mm");
  EXPECT_EQ(problems[2].help, "remove it, or move its texts to the column 'note'");
  EXPECT_EQ(of_table("note,tool\nhot,T1\n")[0].help, problems[2].help);
  EXPECT_EQ(of_table("psoe,x_mm\nA,1\n")[0].place->label, "did you mean 'pose'?");
}

/// The nearest unit of plumb would be wrong by a factor of ten.
TEST(CsvMessage, OfAForeignUnitSaysHowToConvert) {
  const auto problems = of_table("x_cm,payload_lb\n1,2\n");
  EXPECT_EQ(summary(problems), (Summary{"E-CSV-UNIT 1:1", "E-CSV-UNIT 1:6"}));
  EXPECT_EQ(problems[0].help, "convert the numbers and rename it to 'x_mm'");
  EXPECT_EQ(problems[0].place->label, "not one of plumb's: 1 cm = 10 mm");
}

TEST(CsvMessage, OfAnUnknownUnitProposesTheNearest) {
  const auto problems = of_table("x_mmm,y_parsec\n1,2\n");
  EXPECT_EQ(summary(problems), (Summary{"E-CSV-UNIT 1:1", "E-CSV-UNIT 1:7"}));
  EXPECT_EQ(problems[0].help, "did you mean 'x_mm'?");
  EXPECT_EQ(problems[1].help, "known units: mm m um in deg rad mrad urad kg g degC K s ms us N Nm");
}

TEST(CsvMessage, OfTheWrongKindOfUnit) {
  const auto problems =
      of_table("pose,x_deg,rx_mm,payload_mm,temp_s,t_mm,q1_kg,sx_rad\nA,1,1,1,1,1,1,1\n");
  EXPECT_EQ(summary(problems),
            (Summary{"E-CSV-KIND 1:6", "E-CSV-KIND 1:12", "E-CSV-KIND 1:18", "E-CSV-KIND 1:29",
                     "E-CSV-KIND 1:36", "E-CSV-KIND 1:41", "E-CSV-KIND 1:47"}));
  EXPECT_EQ(problems[0].message, "column 'x_deg' is in 'deg', but 'x' is a length");
}

TEST(CsvMessage, OfDuplicateColumns) {
  EXPECT_EQ(summary(of_table("x_mm,x_mm\n1,2\n")), Summary{"E-CSV-DUPLICATE 1:6"});
  const auto same = of_table("q1_deg,q1_rad\n1,2\n");
  EXPECT_EQ(summary(same), Summary{"E-CSV-DUPLICATE 1:8"});
  EXPECT_EQ(same[0].message, "columns 'q1_deg' and 'q1_rad' are the same quantity");
}

TEST(CsvMessage, OfAColumnWithoutName) {
  EXPECT_EQ(summary(of_table("x_mm,\n1,2\n")), Summary{"E-CSV-HEADER 1:6"});
}

TEST(CsvMessage, OfRaggedRowsPointsAtTheExtraCellOrTheEnd) {
  const auto problems = of_table("x_mm,y_mm\n1\n1,2,3\n1,2\n");
  EXPECT_EQ(summary(problems), (Summary{"E-CSV-RAGGED 2:2", "E-CSV-RAGGED 3:5"}));
  EXPECT_EQ(problems[0].place->label, "'y_mm' is missing");
  EXPECT_EQ(problems[1].place->label, "one too many");
}

TEST(CsvMessage, OfAHeaderThatFitsNoRowPointsAtTheHeader) {
  const auto problems = of_table("# of the cell\nx_mm,y_mm\n1,2,3\n4,5,6\n7,8,9\n");
  EXPECT_EQ(summary(problems), Summary{"E-CSV-RAGGED 2:1"});
  EXPECT_EQ(problems[0].message, "every row has 3 cells where the header has 2");
  EXPECT_EQ(of_table("x_mm,y_mm\n1,2,3\n4,5,6\n7,8,9\n1,2\n").size(), 3U) << "one row fits";
  EXPECT_EQ(of_table("x_mm,y_mm\n1,2,3\n4\n7,8,9\n").size(), 3U) << "they differ";
}

TEST(CsvMessage, OfCellsThatAreNoFiniteNumbers) {
  const auto problems =
      of_table("x_mm,y_mm\nabc,\nnan,inf\n-INF,1e999\n1e-999,0x10\n1 2,--1\n+-1,1,2\n");
  EXPECT_EQ(summary(problems),
            (Summary{"E-CSV-NUMBER 2:1", "E-CSV-MISSING 2:5", "E-CSV-NAN 3:1", "E-CSV-NAN 3:5",
                     "E-CSV-NAN 4:1", "E-CSV-RANGE 4:6", "E-CSV-RANGE 5:1", "E-CSV-NUMBER 5:8",
                     "E-CSV-NUMBER 6:1", "E-CSV-NUMBER 6:5", "E-CSV-RAGGED 7:7"}));
  EXPECT_EQ(problems[0].message, "column 'x_mm': 'abc' is not a number");
  EXPECT_EQ(problems[2].message, "column 'x_mm' holds 'nan'");
}

TEST(CsvMessage, OfNumbersThatNoArmCanHave) {
  const auto problems =
      of_arm("q1_deg,q2_deg,x_mm,y_mm,z_mm\n1e7,2,3,4,5\n1,2,1e308,4,-2e7\n1,360000,9.9e6,4,5\n");
  EXPECT_EQ(summary(problems), (Summary{"E-CSV-FAR 2:1", "E-CSV-FAR 3:5", "E-CSV-FAR 3:13"}));
  EXPECT_EQ(problems[0].message, "column 'q1_deg': 2.78e+04 turns is nothing a joint can have");
  EXPECT_NE(problems[0].help.find("unit"), std::string::npos);
}

TEST(CsvMessage, OfADecimalCommaBetweenCommasIsARaggedRow) {
  EXPECT_EQ(summary(of_table("x_mm,y_mm\n1,5,2,5\n")), Summary{"E-CSV-RAGGED 2:5"});
}

TEST(CsvMessage, OfThousandsThatAreGrouped) {
  EXPECT_EQ(summary(of_table("x_mm;y_mm\n1.234,5;2\n")), Summary{"E-CSV-NUMBER 2:1"});
}

TEST(CsvMessage, OfEmptyFilesAndHeadersAlone) {
  EXPECT_EQ(summary(of_table("")), Summary{"E-CSV-EMPTY 0:0"});
  EXPECT_EQ(summary(of_table("\n\n# only: comments\n")), Summary{"E-CSV-EMPTY 0:0"});
  EXPECT_EQ(summary(of_table("\xEF\xBB\xBF")), Summary{"E-CSV-EMPTY 0:0"});
  EXPECT_EQ(summary(of_table("x_mm,y_mm\n")), Summary{"E-CSV-ROWS 0:0"});
}

TEST(CsvMessage, OfBinaryAndForeignEncodings) {
  EXPECT_EQ(summary(of_table(std::string("x_mm\n1\n\0\1", 9))), Summary{"E-CSV-BINARY 3:1"});
  EXPECT_EQ(summary(of_table("note,x_mm\nM\xFCller,1\n")), Summary{"E-CSV-UTF8 2:2"});
  EXPECT_EQ(summary(of_table("\xFF\xFEx\0")), Summary{"E-CSV-UTF8 0:0"});
  EXPECT_EQ(summary(of_table("x_mm\n\xC0\xAF\n")), Summary{"E-CSV-UTF8 2:1"});      // overlong
  EXPECT_EQ(summary(of_table("x_mm\n\xED\xA0\x80\n")), Summary{"E-CSV-UTF8 2:1"});  // surrogate
}

TEST(CsvMessage, OfUtf16WithoutItsMarkSaysWhatItIsAndWhatToDo) {
  for (const bool big_endian : {false, true}) {
    std::string wide;
    for (char c : std::string("q1_deg,x_mm\n1.5,2.25\n"))
      (big_endian ? (wide += '\0') += c : (wide += c) += '\0');
    const auto problems = of_table(wide);
    EXPECT_EQ(summary(problems), Summary{"E-CSV-UTF8 0:0"});
    EXPECT_NE(problems[0].message.find("UTF-16 without a byte-order mark"), std::string::npos);
    EXPECT_NE(problems[0].help.find("plumb import "), std::string::npos) << problems[0].help;
    EXPECT_NE(problems[0].help.find(big_endian ? "iconv -f UTF-16BE" : "iconv -f UTF-16LE"),
              std::string::npos)
        << problems[0].help;
  }
  EXPECT_EQ(summary(of_table(std::string("q1_deg,x_mm\n1.5,2\0\0\0\n", 20))),
            Summary{"E-CSV-BINARY 2:6"});
}

TEST(CsvMessage, OfTabs) {
  EXPECT_EQ(summary(of_table("x_mm\ty_mm\n1\t2\n")), Summary{"E-CSV-SEPARATOR 1:1"});
}

TEST(CsvMessage, OfQuotes) {
  const auto open = of_table("note,x_mm\n\"abc,1\n\"a\"b,1\n");
  EXPECT_EQ(summary(open), (Summary{"E-CSV-QUOTE 2:1", "E-CSV-QUOTE 3:4"}));
}

TEST(CsvMessage, CountsCharactersNotBytes) {
  EXPECT_EQ(summary(of_table("note,x_mm\n\xC3\xA4\xC3\xB6\xE2\x82\xAC,a\n")),
            Summary{"E-CSV-NUMBER 2:5"});
}

TEST(CsvMessage, OfPosesWithoutName) {
  EXPECT_EQ(summary(of_table("pose,x_mm\n,1\n")), Summary{"E-CSV-MISSING 2:1"});
}

TEST(CsvMessage, GivesAllProblemsOfAFileInOnePassButBoundedlyMany) {
  std::string text = "x,y_mm\n";
  for (int i = 0; i < 3000; ++i) text += "1,bad\n";
  const auto problems = of_table(text);
  EXPECT_EQ(problems.size(), 1000u);
  EXPECT_EQ(problems[0].code, "E-CSV-UNIT");
  EXPECT_EQ(problems[999].place->line, 1000);
}

TEST(CsvMessage, DoesNotCopyGiganticLines) {
  const auto problems = of_table("x_mm\n" + std::string(1000000, '9') + "x\n");
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_TRUE(problems[0].place->source.empty());
}

TEST(ArmMessage, OfMissingAndSurplusJoints) {
  const auto missing = of_arm("q1_deg,x_mm\n1,2\n");
  EXPECT_EQ(summary(missing), Summary{"E-CSV-JOINT 1:12"});
  EXPECT_EQ(missing[0].message, "no column for joint 2");
  EXPECT_EQ(missing[0].place->label, "'q2_deg' is missing");
  const auto surplus = of_arm("q1_deg,q2_deg,q7_deg,x_mm\n1,2,3,4\n");
  EXPECT_EQ(summary(surplus), Summary{"E-CSV-JOINT 1:15"});
  EXPECT_EQ(surplus[0].message, "column 'q7_deg', but the arm has 2 joints");
}

TEST(ArmMessage, OfATurningJointInMillimetres) {
  const auto problems = of_arm("q1_deg,q2_mm,x_mm\n1,2,3\n");
  EXPECT_EQ(summary(problems), Summary{"E-CSV-KIND 1:8"});
  EXPECT_EQ(problems[0].message, "column 'q2_mm' is a length, but joint 2 turns");
}

TEST(ArmMessage, OfNoPositionUnlessNoneIsNeeded) {
  EXPECT_EQ(summary(of_arm("q1_deg,q2_deg\n1,2\n")), Summary{"E-CSV-POSITION 1:14"});
  EXPECT_TRUE(of_arm("q1_deg,q2_deg\n1,2\n", Needs::kJoints).empty());
}

TEST(ArmMessage, OfQuaternionsThatAreNot) {
  const std::string header = "q1_deg,q2_deg,x_mm,qw,qx,qy,qz\n";
  const auto problems = of_arm(header + "1,2,3,1.0009,0,0,0\n1,2,4,1.0011,0,0,0\n1,3,3,0,0,0,0\n");
  EXPECT_EQ(summary(problems), (Summary{"E-CSV-QUATERNION 3:7", "E-CSV-QUATERNION 4:7"}));
  EXPECT_EQ(problems[0].message, "the quaternion has length 1.0011, not 1");
  EXPECT_EQ(summary(of_arm("q1_deg,q2_deg,x_mm,qw,qx\n1,2,3,1,0\n")),
            Summary{"E-CSV-ORIENTATION 1:20"});
}

TEST(ArmMessage, OfAnglesWithoutConvention) {
  const std::string header = "q1_deg,q2_deg,x_mm,rx_deg,ry_deg,rz_deg\n";
  EXPECT_EQ(summary(of_arm(header + "1,2,3,4,5,6\n")), Summary{"E-CSV-ROTATION 1:20"});
  EXPECT_TRUE(of_arm("# rot: xyz-fixed\n" + header + "1,2,3,4,5,6\n").empty());
  for (const char* name : {"zyx-moving", "zyz-fixed", "rotation-vector"})
    EXPECT_TRUE(of_arm("# rot: " + std::string(name) + "\n" + header + "1,2,3,4,5,6\n").empty());
  EXPECT_EQ(summary(of_arm("# rot: zyx\n" + header + "1,2,3,4,5,6\n")),
            Summary{"E-CSV-ROTATION 2:20"});
  EXPECT_EQ(summary(of_arm("# rot: xyz-fixed\nq1_deg,q2_deg,x_mm,rx_deg,rz_deg\n1,2,3,4,6\n")),
            Summary{"E-CSV-ORIENTATION 2:20"});
  EXPECT_EQ(summary(of_arm("# rot: xyz-fixed\n"
                           "q1_deg,q2_deg,x_mm,qw,qx,qy,qz,rx_deg,ry_deg,rz_deg\n"
                           "1,2,3,1,0,0,0,4,5,6\n")),
            Summary{"E-CSV-ORIENTATION 2:32"});
}

TEST(ArmMessage, OfStandardDeviations) {
  EXPECT_EQ(summary(of_arm("q1_deg,q2_deg,x_mm,y_mm,sx_um\n1,2,3,4,5\n")),
            Summary{"E-CSV-AXIS 1:25"});
  EXPECT_EQ(summary(of_arm("q1_deg,q2_deg,x_mm,sx_um\n1,2,3,5\n1,2,4,0\n1,2,5,-1\n")),
            Summary{"E-CSV-SIGMA 4:7"});
}

MeasurementFiles of_sigmas(const std::string& rows) {
  const Folder folder;
  const auto file = folder.put("t.csv", "q1_deg,q2_deg,x_mm,y_mm,sx_um,sy_um\n" + rows);
  return read_measurements({file}, {true, true}, Needs::kJointsAndPosition);
}

TEST(ArmMessage, OfAStandardDeviationOfZeroWhichIsReplacedByTheSmallestOfItsAxis) {
  const auto m = of_sigmas("1,2,3,4,5,9\n2,2,4,4,0,8\n3,2,5,4,7,0\n");
  EXPECT_EQ(summary(m.tables[0].remarks), Summary{"W-CSV-SIGMA 3:9"});
  EXPECT_DOUBLE_EQ(m.sigma_m(1, 0), 5e-6);
  EXPECT_DOUBLE_EQ(m.sigma_m(2, 1), 8e-6);
  EXPECT_DOUBLE_EQ(m.sigma_m(2, 0), 7e-6);
  EXPECT_EQ(of_sigmas("1,2,3,4,0,9\n2,2,4,4,0,8\n").sigma_m(0, 0), 8e-6);
  const auto none = of_sigmas("1,2,3,4,0,0\n2,2,4,4,0,0\n");
  EXPECT_EQ(none.sigma_m.rows(), 0);
  EXPECT_EQ(summary(none.tables[0].remarks), Summary{"W-CSV-SIGMA 2:9"});
  EXPECT_EQ(summary(of_sigmas("1,2,3,4,5,9\n").tables[0].remarks), Summary{});
}

TEST(ArmMessage, OfColumnsWhoseNameIsASlip) {
  const auto remarks = remarks_of_arm(
      "q1_deg,q2_deg,x_mm,paylod_kg,tmep_degC,sigma_x_um,travl_j1_deg,time_s,tmep_arm_degC\n"
      "1,2,3,4,5,6,7,8,9\n");
  EXPECT_EQ(summary(remarks),
            (Summary{"W-CSV-COLUMN 1:20", "W-CSV-COLUMN 1:30", "W-CSV-COLUMN 1:40",
                     "W-CSV-COLUMN 1:51", "W-CSV-COLUMN 1:64", "W-CSV-COLUMN 1:71"}));
  std::vector<std::string> labels;
  for (const auto& remark : remarks) labels.push_back(remark.place->label);
  EXPECT_EQ(labels,
            (std::vector<std::string>{"did you mean 'payload_kg'?", "did you mean 'temp_degC'?",
                                      "did you mean 'sx_um'?", "did you mean 'travel_j1_deg'?",
                                      "did you mean 't_s'?", "did you mean 'temp_arm_degC'?"}));
}

TEST(ArmMessage, NeverOfColumnsOfOnesOwn) {
  EXPECT_EQ(summary(remarks_of_arm(
                "q1_deg,q2_deg,x_mm,dx_mm,ex_um,err_mm,speed_mm,room_degC,w_mm,force_N,mass_kg,"
                "payload_kg,payload2_kg\n1,2,3,4,5,6,7,8,9,10,11,12,13\n")),
            Summary{});
}

TEST(ArmMessage, OfContextThatCannotBe) {
  const std::string head = "q1_deg,q2_deg,x_mm,";
  EXPECT_EQ(summary(of_arm(head + "dir_j1\n1,2,3,1\n1,2,3,-1\n1,2,3,0\n1,2,3,2\n")),
            Summary{"E-CSV-CONTEXT 5:7"});
  EXPECT_EQ(summary(of_arm(head + "dir_j9,travel_j9_deg\n1,2,3,1,4\n")),
            (Summary{"E-CSV-JOINT 1:20", "E-CSV-JOINT 1:27"}));
  EXPECT_EQ(summary(of_arm(head + "travel_j1_deg\n1,2,3,-5\n")), Summary{"E-CSV-CONTEXT 2:7"});
  EXPECT_EQ(summary(of_arm(head + "travel_j1_mm\n1,2,3,5\n")), Summary{"E-CSV-KIND 1:20"});
  EXPECT_EQ(summary(of_arm(head + "payload_kg\n1,2,3,-5\n")), Summary{"E-CSV-CONTEXT 2:7"});
  EXPECT_EQ(summary(of_arm(head + "temp_arm_degC\n1,2,3,-300\n")), Summary{"E-CSV-CONTEXT 2:7"});
}

TEST(ArmMessage, OfTimesThatAreNoneOfIso8601) {
  const auto of = [](const std::string& time) {
    return summary(of_arm("q1_deg,q2_deg,x_mm,time\n1,2,3," + time + "\n"));
  };
  for (const char* good :
       {"2026-03-01T12:30:00", "2026-03-01 12:30", "2026-03-01T12:30:00.5Z",
        "2026-03-01T12:30:00+01:00", "20260301T123000Z", "2026-03-01T12:30-0530"})
    EXPECT_EQ(of(good), Summary{}) << good;
  for (const char* bad :
       {"", "12:30", "01.03.2026 12:30", "3/1/2026 12:30", "2026-03-01", "2026-02-30T12:30:00",
        "2026-03-01T25:30:00", "2026-03-01T12:30:00 PM", "2026-03-01T12:30:", "1772368200"})
    EXPECT_EQ(of(bad), Summary{"E-CSV-TIME 2:7"}) << bad;
}

TEST(ArmMessage, OfUnknownMarks) {
  EXPECT_EQ(summary(of_arm("q1_deg,q2_deg,x_mm,set\n1,2,3,fit\n1,2,4,train\n1,2,5,\n")),
            Summary{"E-CSV-SET 3:7"});
}

TEST(ArmMessage, OfRowsCopiedByMistake) {
  const auto remarks =
      remarks_of_arm("pose,q1_deg,q2_deg,x_mm\nA,1,2,3\nB,1,3,3\nA,1,2,3\nA,1,2,3\n");
  EXPECT_EQ(summary(remarks), Summary{"W-CSV-DOUBLE 4:1"});
  EXPECT_EQ(remarks[0].message, "2 rows are identical to an earlier one");
  EXPECT_EQ(remarks[0].place->label, "the same as line 2");
}

TEST(ArmMessage, OfOneNameForTwoPoses) {
  const auto remarks = remarks_of_arm("pose,q1_deg,q2_deg,x_mm\nA,1,2,3\nA,1.1,2,4\nA,9,2,5\n");
  EXPECT_EQ(summary(remarks), Summary{"W-CSV-POSE 4:1"});
}

TEST(ArmMessage, OfNamesInUpperCase) {
  const auto remarks = remarks_of_arm("q1_deg,q2_deg,x_mm,Y_mm\n1,2,3,4\n");
  EXPECT_EQ(summary(remarks), Summary{"W-CSV-NAME 1:20"});
  EXPECT_EQ(remarks[0].help, "rename it to 'y_mm' if it is meant");
}

TEST(ArmMessage, CollectsTheProblemsOfAllFiles) {
  const Folder folder;
  const auto a = folder.put("a.csv", "q1,q2_deg,x_mm\n1,2,3\n");
  const auto b = folder.put("b.csv", "q1_deg,x_mm\n1,2\n");
  const auto problems = problems_of([&] {
    read_measurements({a, folder.path() / "none.csv", folder.path(), b}, {true, true},
                      Needs::kJointsAndPosition);
  });
  EXPECT_EQ(summary(problems),
            (Summary{"E-CSV-UNIT 1:1", "E-READ 0:0", "E-READ 0:0", "E-CSV-JOINT 1:12"}));
  EXPECT_EQ(summary(problems_of([] {
              read_measurements({}, {true, true}, Needs::kJointsAndPosition);
            })),
            Summary{"E-CSV-NONE 0:0"});
}

}  // namespace
}  // namespace plumb::offline

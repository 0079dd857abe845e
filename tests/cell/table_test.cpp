// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "cell/measurements.hpp"
#include "cell/table_file.hpp"
#include "support.hpp"

namespace plumb::offline {
namespace {

TEST(Table, HoldsNumbersInSi) {
  const auto t = parse_table(
      "a_mm,b_um,c_in,d_deg,e_mrad,f_g,g_K,h_degC,i_ms,j_us,k_N,l_Nm,m_m,n_rad,o_kg,p_s\n"
      "123.4,5,2,180,3,250,300,23.5,7,8,9,10,11,12,13,14\n",
      "t.csv");
  const double want[] = {0.1234, 5e-6, 0.0508, M_PI, 3e-3, 0.25, 26.85, 23.5,
                         7e-3,   8e-6, 9,      10,   11,   12,   13,    14};
  ASSERT_EQ(t.columns.size(), std::size(want));
  for (std::size_t k = 0; k < std::size(want); ++k)
    EXPECT_NEAR(t.columns[k].values.at(0), want[k], 1e-13) << t.columns[k].header;
}

TEST(Table, ReadsCommentsBlankLinesMarksAndCarriageReturns) {
  const auto t = parse_table(
      "\xEF\xBB\xBF# robot: UR10\r\n\r\n// frame : tracker\r\n# free words\r\nnote,x_mm\r\n"
      "a,1\r\n# rot: xyz-fixed\r\n\r\nb, +2.5e0 \r\n",
      "t.csv");
  const std::vector<std::pair<std::string, std::string>> want{
      {"robot", "UR10"}, {"frame", "tracker"}, {"rot", "xyz-fixed"}};
  EXPECT_EQ(t.comments, want);
  EXPECT_EQ(t.lines, (std::vector<int>{6, 9}));
  EXPECT_EQ(t.find("x")->values, (std::vector<double>{0.001, 0.0025}));
  EXPECT_EQ(t.raw_header, "note,x_mm");
  EXPECT_EQ(t.raw_rows[0], "a,1");
}

TEST(Table, ReadsQuotedTexts) {
  const auto t = parse_table(
      "note,x_mm\n\"a, b\",1\n\"say \"\"hi\"\"\",2\n  \"#1\" , 3\n3\" bolt,4\n\"\",5\n", "t.csv");
  EXPECT_EQ(t.find("note")->text,
            (std::vector<std::string>{"a, b", "say \"hi\"", "#1", "3\" bolt", ""}));
  EXPECT_EQ(t.raw_rows[0], "\"a, b\",1");
}

TEST(Table, AnnouncesSemicolonsAndKeepsCanonicalRows) {
  const auto t = parse_table("pose;x_mm;note;y_mm\nA;1,5;a, b;-2,5e1\nB;1.25;\"c;d\";3\n", "t.csv");
  ASSERT_EQ(summary(t.remarks), Summary{"N-CSV-SEMICOLON 1:5"});
  EXPECT_EQ(t.remarks[0].severity, Severity::kNote);
  EXPECT_EQ(t.remarks[0].message, "read with ';' between columns and decimal commas");
  EXPECT_EQ(parse_table("pose;x_mm;note\nA;1.5;a, b\n", "t.csv").remarks.at(0).message,
            "read with ';' between columns and decimal points");
  EXPECT_EQ(t.find("x")->values, (std::vector<double>{0.0015, 0.00125}));
  EXPECT_EQ(t.find("y")->values, (std::vector<double>{-0.025, 0.003}));
  EXPECT_EQ(t.raw_header, "pose,x_mm,note,y_mm");
  EXPECT_EQ(t.raw_rows[0], "A,1.5,\"a, b\",-2.5e1");
  EXPECT_EQ(t.raw_rows[1], "B,1.25,\"c;d\",3");
}

TEST(Table, OfCanonicalRowsReadsTheSame) {
  const auto t = parse_table("pose;x_mm;note\nA;1,5;a, b\nB;2;\"q \"\"x\"\"\"\n", "t.csv");
  std::string again = t.raw_header + "\n";
  for (const std::string& row : t.raw_rows) again += row + "\n";
  const auto u = parse_table(again, "t.csv");
  EXPECT_EQ(u.find("x")->values, t.find("x")->values);
  EXPECT_EQ(u.find("note")->text, t.find("note")->text);
}

TEST(Table, NeedsNoLastLineBreak) { EXPECT_EQ(parse_table("x_mm\n1\n2", "t.csv").rows(), 2); }

TEST(Table, KnowsTheNamesWithoutUnit) {
  const auto t = parse_table(
      "pose,repeat,set,note,qw,qx,qy,qz,dir_j1,dir_j12,time,status,fold\n"
      "A,1,fit,n,1,0,0,0,-1,1,2021-10-07T00:00:00Z,ok,-1\n",
      "t.csv");
  EXPECT_EQ(t.columns.size(), 13u);
  EXPECT_EQ(t.find("dir_j1")->values[0], -1.0);
  EXPECT_EQ(t.find("time")->quantity, Quantity::kText);
}

TEST(Table, NeverCrashesOnATruncatedOrFlippedFile) {
  const std::string whole =
      "\xEF\xBB\xBF# rot: "
      "xyz-fixed\r\npose;q1_deg;x_mm;note\r\nA;1,5;2;\"\xC3\xA4;\"\"b\"\r\nB;+2;1e3;c\n";
  int accepted = 0;
  for (std::size_t i = 0; i <= whole.size(); ++i)
    accepted += problems_of([&] { parse_table(whole.substr(0, i), "t.csv"); }).empty() ? 1 : 0;
  for (std::size_t i = 0; i < whole.size(); ++i)
    for (int flip = 1; flip < 256; ++flip) {
      std::string text = whole;
      text[i] = static_cast<char>(text[i] ^ flip);
      for (const auto& p : problems_of([&] { parse_table(text, "t.csv"); }))
        EXPECT_FALSE(render(p).empty());
    }
  EXPECT_GT(accepted, 3);
}

}  // namespace
}  // namespace plumb::offline

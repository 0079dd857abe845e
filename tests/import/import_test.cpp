// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "cell/measurements.hpp"
#include "import/euler.hpp"
#include "import/importer.hpp"
#include "import/moves.hpp"
#include "import/timestamps.hpp"
#include "tests/import/imported_text.hpp"
#include "tests/import/temporary_file.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::offline {
namespace {

using tests::Random;
using tests::scaled;
using tests::TemporaryFolder;

Imported imported(const std::string& bytes, const ImportWishes& wishes = {}) {
  const TemporaryFolder folder;
  return import_file(folder.put("log.txt", bytes), wishes);
}

Table table_of(const std::string& bytes, const ImportWishes& wishes = {}) {
  return tests::table_of(imported(bytes, wishes));
}

/// Code and place of the first problem.
std::string refusal(const std::string& bytes, const ImportWishes& wishes = {}) {
  try {
    (void)imported(bytes, wishes);
  } catch (const Failure& f) {
    const Problem& p = f.problems().front();
    EXPECT_FALSE(p.help.empty()) << p.code;
    return p.code + (p.place && p.place->line > 0 ? ":" + std::to_string(p.place->line) : "");
  }
  return "accepted";
}

ImportWishes mapped(const std::vector<std::string>& map) {
  ImportWishes out;
  out.map = map;
  return out;
}

struct Style {
  const char* separator;
  char decimal;
  const char* mark;      // of the encoding
  const char* preamble;  // above the header
  const char* end;
};

constexpr Style kStyles[] = {{",", '.', "", "", "\n"},
                             {";", ',', "\xEF\xBB\xBF", "", "\r\n"},
                             {"\t", '.', "", "# robot: arm\n\n", "\n"},
                             {" | ", ',', "", "Report of today\n", "\n"},
                             {"   ", '.', "", "% made by a program\n", "\n"},
                             {";", '.', "", "Tracker AT960; serial 7\n\n", ";\n"}};

struct Spelling {
  const char* joint;  // %d
  const char* axis;   // %c
};
constexpr Spelling kSpellings[] = {{"q%d_deg", "%c_mm"},
                                   {"Joint%d[deg]", "%c[mm]"},
                                   {"A%d(deg)", "X_%c_mm"},
                                   {"axis%d/deg", "Measured_%c(mm)"},
                                   {"J%d_deg", "POS_%c[mm]"}};

std::string formatted(const char* pattern, int argument) {
  char out[64];
  std::snprintf(out, sizeof out, pattern, argument);
  return out;
}

std::string number(double value, char decimal) {
  char out[64];
  std::snprintf(out, sizeof out, "%.10g", value);
  std::string text = out;
  for (char& c : text)
    if (c == '.') c = decimal;
  return text;
}

TEST(Import, ReadsRandomTablesOfEveryDialectBackToTheLastDigit) {
  const long cases = scaled(300);
  for (long seed = 1; seed <= cases; ++seed) {
    Random dice(seed);
    const Style& style = kStyles[dice.below(std::size(kStyles))];
    const Spelling& words = kSpellings[dice.below(std::size(kSpellings))];
    const bool plain_axis = std::string(words.axis).find("X_") == 0;
    const int joints = 3 + dice.below(5), rows = 2 + dice.below(30);
    std::string text = std::string(style.mark) + style.preamble;
    std::vector<std::string> names;
    for (int j = 1; j <= joints; ++j) names.push_back(formatted(words.joint, j));
    for (char axis : {'x', 'y', 'z'})
      names.push_back(plain_axis ? formatted("%c_mm", axis) : formatted(words.axis, axis));
    const auto line = [&](const std::vector<std::string>& cells) {
      for (std::size_t k = 0; k < cells.size(); ++k)
        text += (k > 0 ? style.separator : "") + cells[k];
      text += style.end;
    };
    line(names);
    std::vector<std::vector<double>> values;
    for (int i = 0; i < rows; ++i) {
      std::vector<std::string> cells;
      values.emplace_back();
      for (std::size_t k = 0; k < names.size(); ++k) {
        values.back().push_back(dice.uniform(-2000, 2000) + 1e-5);
        cells.push_back(number(values.back().back(), style.decimal));
      }
      line(cells);
    }
    const Table table = table_of(text);
    ASSERT_EQ(table.rows(), rows) << text;
    for (std::size_t k = 0; k < names.size(); ++k) {
      const bool joint = static_cast<int>(k) < joints;
      const std::string name = joint ? "q" + std::to_string(k + 1)
                                     : std::string(1, "xyz"[k - static_cast<std::size_t>(joints)]);
      const Column* column = table.find(name);
      ASSERT_NE(column, nullptr) << name << "\n" << text;
      const double unit = joint ? M_PI / 180.0 : 1e-3;
      for (int i = 0; i < rows; ++i)
        EXPECT_NEAR(column->values[i] / unit, values[i][k], 1e-6) << "seed " << seed;
    }
  }
}

TEST(Import, UnderstandsUtf16AndLatin1AndSaysSo) {
  const std::string text = "pose;q1_deg;x_mm;note\nA;1,5;2,25;H\xE4lfte\n";
  const Imported latin = imported(text);
  EXPECT_EQ(latin.remarks.front().code, "N-IMPORT-ENCODING");
  EXPECT_EQ(latin.find("note")->text.front(), "H\xC3\xA4lfte");
  std::string wide = "\xFF\xFE";
  for (char c : std::string("q1_deg;x_mm\n1,5;2,25\n")) wide += c, wide += '\0';
  EXPECT_EQ(imported(wide).find("q1")->text.front(), "1.5");
}

TEST(Import, UnderstandsUtf16WithoutItsMarkInBothOrdersAndSaysSo) {
  for (const bool big_endian : {false, true}) {
    std::string wide;
    for (char c : std::string("q1_deg;x_mm;Kraft \xB5\n1,5;2,25;3\n"))
      (big_endian ? (wide += '\0') += c : (wide += c) += '\0');
    const Imported data = imported(wide);
    EXPECT_EQ(data.find("q1")->text.front(), "1.5") << big_endian;
    EXPECT_EQ(data.remarks.front().code, "N-IMPORT-ENCODING") << big_endian;
    EXPECT_NE(data.remarks.front().message.find("no byte-order mark"), std::string::npos);
  }
  EXPECT_EQ(refusal(std::string("q1_deg;x_mm\n1,5;2\0\0\0\n", 21)), "E-IMPORT-BINARY");
}

TEST(Import, ARowOfUnitsUnderTheHeaderCounts) {
  const Table t = table_of("Point;A1;A2;X;Y;Z\n-;deg;deg;m;m;m\np;1,5;2;0,5;1;2\n");
  EXPECT_NEAR(t.find("x")->values[0], 0.5, 1e-15);
  EXPECT_NEAR(t.find("q1")->values[0], 1.5 * M_PI / 180.0, 1e-15);
  EXPECT_EQ(t.find("pose")->text[0], "p");
}

TEST(Import, ThousandsSignsFallAwayBesideADecimalComma) {
  EXPECT_EQ(imported("q1_deg;x_mm\n1,5;1.234,5\n").find("x")->text[0], "1234.5");
}

TEST(Import, ACommaThatMayDivideThousandsIsAskedForAndObeyed) {
  const std::string text = "q1_deg;x_mm\n10;1,234\n20;2,345\n";
  EXPECT_EQ(refusal(text), "E-IMPORT-DECIMAL:2");
  ImportWishes comma;
  comma.dialect.decimal = ',';
  EXPECT_EQ(imported(text, comma).find("x")->text[0], "1.234");
}

TEST(Import, MapsAColumnUnderAnyNameAndLeavesOthersOut) {
  ImportWishes wishes;
  wishes.map = {"Goal x=nx_m", "q1_deg=-"};
  const Imported data = imported("Goal x;q1_deg;x_mm\n0,5;1;2,5\n", wishes);
  EXPECT_EQ(data.find("nx")->unit, "m");
  EXPECT_EQ(data.find("q1"), nullptr);
}

TEST(Import, TheHelpOfAColumnWithoutUnitCanBePasted) {
  EXPECT_EQ(refusal("q1_deg,x\n1,2\n"), "E-IMPORT-UNIT:1");
  ImportWishes wishes;
  wishes.map = {"x=x_mm"};
  EXPECT_NEAR(table_of("q1_deg,x\n1,2\n", wishes).find("x")->values[0], 2e-3, 1e-18);
}

/// A column in a unit that plumb does not convert is not a column of the user's own.
TEST(Import, RefusesAForeignUnitByName) {
  for (const char* header : {"q1_deg,x_cm,y_mm", "q1_deg,X [cm],y_mm", "q1_deg,Pos X (cm),y_mm"}) {
    const std::string bytes = std::string(header) + "\n1,2,3\n4,5,6\n";
    EXPECT_EQ(refusal(bytes), "E-IMPORT-UNIT:1") << header;
    try {
      (void)imported(bytes);
    } catch (const Failure& f) {
      EXPECT_NE(f.problems()[0].message.find("is in cm"), std::string::npos) << header;
      EXPECT_NE(f.problems()[0].help.find("x_mm"), std::string::npos) << header;
    }
  }
  EXPECT_EQ(refusal("q1_deg,x,y_mm\ndeg,cm,mm\n1,2,3\n4,5,6\n").substr(0, 13), "E-IMPORT-UNIT");
  EXPECT_EQ(refusal("q1_deg,x_cm\n1,2\n4,5\n", mapped({"x_cm=-"})), "accepted");
  EXPECT_EQ(refusal("q1_deg,x_cm\n1,2\n4,5\n", mapped({"x_cm=x_cm"})), "E-IMPORT-MAP");
  EXPECT_EQ(refusal("q1_deg,remark_cm\n1,2\n4,5\n"), "accepted");
}

TEST(Import, RefusesTwoWishesForOneColumn) {
  EXPECT_EQ(refusal("X,Y\n1,2\n3,4\n", mapped({"X=x_mm", "X=y_mm"})), "E-IMPORT-MAP");
}

TEST(Import, APreviewWarnsWithACodeOfWarnings) {
  for (const char* header : {"q1_deg,x", "q1_deg,x_cm"}) {
    ImportWishes wishes;
    wishes.preview = true;
    const Imported data = imported(std::string(header) + "\n1,2\n4,5\n", wishes);
    ASSERT_FALSE(data.remarks.empty()) << header;
    for (const auto& remark : data.remarks)
      EXPECT_EQ(remark.code[0] == 'W', remark.severity == Severity::kWarning) << remark.code;
    EXPECT_EQ(data.remarks[0].code, "W-IMPORT-UNIT");
  }
}

TEST(Import, RefusesWhatCannotBeMeantWithPlaceAndRemedy) {
  EXPECT_EQ(refusal(""), "E-IMPORT-EMPTY");
  EXPECT_EQ(refusal(" \n\r\n"), "E-IMPORT-EMPTY");
  EXPECT_EQ(refusal(std::string("\x7f"
                                "ELF\x01\x02\0\0",
                                8)),
            "E-IMPORT-BINARY");
  EXPECT_EQ(refusal("q1_deg,x_mm\n"), "E-IMPORT-ROWS:1");
  EXPECT_EQ(refusal("1,2,3\n4,5,6\n"), "E-IMPORT-HEADER:1");
  EXPECT_EQ(refusal("q1_deg,x_mm\n1,2\n3\n"), "E-IMPORT-RAGGED:3");
  EXPECT_EQ(refusal("q1_deg,q2_deg,x_mm\n1,2,3\n1,2,oops\n"), "E-IMPORT-NUMBER:3");
  EXPECT_EQ(refusal("q1_deg,q2_deg,x_mm\n1,2,3\n1,2,nan\n"), "E-IMPORT-NUMBER:3");
  EXPECT_EQ(refusal("q1_deg,q2_deg,x_mm\n1,2,3\n1,2,1e999\n"), "E-IMPORT-NUMBER:3");
  EXPECT_EQ(refusal("A1_deg,J1_deg,x_mm\n1,2,3\n"), "E-IMPORT-TWICE");
  ImportWishes wishes;
  wishes.map = {"Goal_x=nx_m"};
  EXPECT_EQ(refusal("Goal x;x_mm\n1;2\n", wishes), "E-IMPORT-MAP");
  wishes.map = {"Goal x=nx"};
  EXPECT_EQ(refusal("Goal x;x_mm\n1;2\n", wishes), "E-IMPORT-MAP");
  wishes.map = {};
  wishes.rotation = "xxz-fixed";
  EXPECT_EQ(refusal("rx_deg;ry_deg;rz_deg\n1;2;3\n", wishes), "E-IMPORT-ROT");
}

TEST(Import, NamesTheColumnsOfAFileWithoutHeader) {
  ImportWishes wishes;
  wishes.dialect.header = {"q1_deg", "x_mm", "y_mm"};
  const Table t = table_of("1 2 3\n4 5 6\n", wishes);
  ASSERT_EQ(t.rows(), 2);
  EXPECT_NEAR(t.find("y")->values[1], 6e-3, 1e-18);
}

TEST(Euler, EveryOrderIsTheProductOfItsTurns) {
  const auto turn = [](int axis, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    const int i = (axis + 1) % 3, k = (axis + 2) % 3;
    R(i, i) = R(k, k) = c;
    R(i, k) = -s;
    R(k, i) = s;
    return R;
  };
  Random dice(3);
  for (const char* name : {"xyz-fixed", "zyx-fixed", "zyz-fixed", "xyz-moving", "zyx-moving",
                           "zxz-moving", "yxz-moving"}) {
    const EulerConvention c = euler_convention(name);
    const std::array<double, 3> a{dice.uniform(-3, 3), dice.uniform(-3, 3), dice.uniform(-3, 3)};
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    for (int i = 0; i < 3; ++i)
      R = c.moving ? R * turn(c.axes[i], a[i]) : turn(c.axes[i], a[i]) * R;
    const auto q = quaternion(c, a);
    const Eigen::Matrix3d got = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
    EXPECT_LT((got - R).norm(), 1e-14) << name;
  }
}

TEST(Timestamps, EveryFormatCountsTheSameSeconds) {
  const auto seconds = [](std::vector<std::string_view> cells) {
    return tests::timestamps_in(cells, ',').seconds;
  };
  const std::vector<double> expected{0.0, 20.0, 86420.0};
  EXPECT_EQ(seconds({"20200228163904", "20200228163924", "20200229163924"}), expected);
  EXPECT_EQ(seconds({"2020-02-28T16:39:04", "2020-02-28T16:39:24", "2020-02-29T16:39:24"}),
            expected);
  EXPECT_EQ(seconds({"28.02.2020 16:39:04", "28.02.2020 16:39:24", "29.02.2020 16:39:24"}),
            expected);
  const auto days = seconds({"43889,5", "43889,75", "43890,5"});
  EXPECT_NEAR(days[1], 21600.0, 1e-3);
  const Timestamps clock = tests::timestamps_in({"23:59:50", "00:00:10,5"}, ',');
  EXPECT_TRUE(clock.wrapped);
  EXPECT_NEAR(clock.seconds[1], 20.5, 1e-9);
}

TEST(Timestamps, WhatASpreadsheetDestroyedIsNamed) {
  EXPECT_NE(tests::timestamps_in({"2,02011E+13", "2,02011E+13"}, ',').damage.find("rounded"),
            std::string::npos);
  EXPECT_NE(tests::timestamps_in({"12:34,5", "12:40,1"}, ',').damage.find("hours"),
            std::string::npos);
  EXPECT_NE(tests::timestamps_in({"2020-02-28 16:39:04", "43889,5"}, ',').damage.find("changes"),
            std::string::npos);
}

TEST(Moves, AnUnchangedJointKeepsItsLastDirectionAndTravel) {
  const Arrivals a = arrivals_from_order({0.0, 0.5, 0.5, 0.2, 0.2}, 1e-5);
  EXPECT_EQ(a.direction, (std::vector<int>{0, 1, 1, -1, -1}));
  EXPECT_NEAR(a.travel[2], 0.5, 1e-15);
  EXPECT_NEAR(a.travel[4], 0.3, 1e-15);
}

}  // namespace
}  // namespace plumb::offline

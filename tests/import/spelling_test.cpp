// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "import/number_text.hpp"
#include "tests/import/imported_text.hpp"

namespace plumb::offline {
namespace {

using tests::imported_text;
using tests::in_short;
using tests::refusal_of;
using tests::remark_of;

struct Spelling_ {
  const char* cell;
  char decimal;
  const char* number;  // "" if the cell is none
};

TEST(Spelling, ANumberIsReadInEveryWayOfWriting) {
  const Spelling_ table[] = {
      {"2'318.473", '.', "2318.473"},
      {"-1'234'567.5", '.', "-1234567.5"},
      {"2\u2019318.473", '.', "2318.473"},
      {"2\u00A0318,473", ',', "2318.473"},
      {"2\u202F318,473", ',', "2318.473"},
      {"-2\u2009318,4", ',', "-2318.4"},
      {"2 318,473", ',', "2318.473"},
      {"1.234.567,8", ',', "1234567.8"},
      {"1,234,567.8", '.', "1234567.8"},
      {"\u221280.932", '.', "-80.932"},
      {"\u201380.932", '.', "-80.932"},
      {"\u22121\u00A0748,770", ',', "-1748.770"},
      {"+5", '.', "5"},
      {"1.5D+03", '.', "1.5E+03"},
      {"1,5e\u22123", ',', "1.5e-3"},
      {".5", '.', ".5"},
      {"5.", '.', "5."},
      {"0.1234567890123456789", '.', "0.1234567890123456789"},
      {"1'23.4", '.', ""},
      {"1'2345", '.', ""},
      {"0'123", '.', ""},
      {"1'234\u2019567", '.', ""},
      {"1.2.3", '.', ""},
      {"12 34", '.', ""},
      {"- 5", '.', ""},
      {"--5", '.', ""},
      {"nan", '.', ""},
      {"inf", '.', ""},
      {"1e", '.', ""},
      {"", '.', ""},
      {"-", '.', ""},
      {".", '.', ""},
  };
  for (const auto& row : table)
    EXPECT_EQ(plain_number(row.cell, row.decimal).value_or(""), row.number) << row.cell;
}

TEST(Spelling, AnAngleInMinutesAndSecondsIsDegrees) {
  const std::pair<const char*, double> table[] = {
      {"54\u00B049'46.38\"", 54.8295500}, {"-234\u00B000'02.28\"", -234.000633333},
      {"\u22120\u00B030'", -0.5},         {"54\u00B0 49\u2032 46,38\u2033", 54.8295500},
      {"10\u00BA30.5'", 10.508333333},    {"1\u00B000'00.36\"\"", 1.0001},
  };
  for (const auto& [cell, degrees] : table) {
    ASSERT_TRUE(sexagesimal(cell)) << cell;
    EXPECT_NEAR(*sexagesimal(cell), degrees, 1e-8) << cell;
  }
  for (const char* none : {"54\u00B0", "54.8", "54\u00B060'", "5'6\"", "54\u00B049'46.38", ""})
    EXPECT_FALSE(sexagesimal(none)) << none;
}

/// The same two rows, however they are written.
TEST(Spelling, AFileIsReadInEveryWayOfWriting) {
  const char* texts[] = {
      "q1 [deg];x [mm]\n1.5;2'318.473\n-2.5;1'000.125\n",
      "q1 [deg];x [mm]\n1,5;2\u00A0318,473\n\u22122,5;1\u00A0000,125\n",
      "q1 [deg];x [mm]\n1,5;2\xA0"
      "318,473\n\x96"
      "2,5;1\xA0"
      "000,125\n",
      "q1 [\xB0];x [mm]\n1,5;2318,473\n-2,5;1000,125\n",
      "q1 [deg]\tx [mm]\n1,5\t2.318,473\n-2,5\t1.000,125\n",
      "q1 [deg],x [mm]\n1.5,\"2,318.473\"\n-2.5,\"1,000.125\"\n",
      "q1 [deg],x [mm]\n\"1,5\",\"2318,473\"\n\"-2,5\",\"1000,125\"\n",
      "q1;x\n1.5\u00B0;2318.473 mm\n-2.5\u00B0;1000.125 mm\n",
      "q1;x\n1.5 deg;2318.473mm\n-2.5 deg;1000.125mm\n",
      "q1,x\n\"1,5\u00B0\",\"2.318,473 mm\"\n\"-2,5\u00B0\",\"1.000,125 mm\"\n",
      "q1;x [mm]\n1\u00B030'00\";2318.473\n-2\u00B030'00\";1000.125\n",
      "q1,x [mm]\n\"1\u00B030'00\"\"\",2318.473\n\"-2\u00B030'00\"\"\",1000.125\n",
      "q1 (deg) | x (mm)\n1.5 | 2318.473\n-2.5 | 1000.125\n",
  };
  for (const char* text : texts)
    EXPECT_EQ(in_short(imported_text(text)), "q1_deg=1.5|-2.5 x_mm=2318.473|1000.125") << text;
}

TEST(Spelling, Utf16WithoutItsMarkMayHoldTypographicSigns) {
  std::string bytes;
  for (const char16_t c : std::u16string(u"q1_deg;x_mm\n\u22121,5;\u22122\u202F318,4\n"
                                         u"\u22122,5;\u22121\u202F000,5\n"))
    bytes += static_cast<char>(c & 0xFF), bytes += static_cast<char>(c >> 8);
  EXPECT_EQ(in_short(imported_text(bytes)), "q1_deg=-1.5|-2.5 x_mm=-2318.4|-1000.5");
}

TEST(Spelling, WhatIsAssumedIsSaid) {
  EXPECT_NE(remark_of(imported_text("q1_deg;x_mm\n1.5;2'318.4\n"), "N-IMPORT-THOUSANDS")
                .find("'2'318.4' is 2318.4"),
            std::string::npos);
  EXPECT_NE(remark_of(imported_text("q1;x\n1.5 deg;2 mm\n"), "N-IMPORT-CELLS").find("q1 [deg]"),
            std::string::npos);
}

/// Patterns of the standard library recurse over every letter.
TEST(Spelling, AHeadingOfALineLengthIsLeftOut) {
  const std::string endless(300000, 'a');
  EXPECT_EQ(in_short(imported_text("q1_deg;" + endless + ";x_mm\n1;2;3\n2;3;4\n")),
            "q1_deg=1|2 x_mm=3|4");
}

TEST(Spelling, AColumnOfTextsThatIsLeftOutMayBeKeptAsTheNote) {
  const auto remedy = [](const std::string& text) {
    for (const Problem& remark : imported_text(text).remarks)
      if (remark.code == "N-IMPORT-LEFT") return remark.help;
    return std::string();
  };
  EXPECT_EQ(remedy("q1_deg;x_mm;operator\n1;2;Anna\n2;3;Bert\n"),
            "to keep one: --map \"operator=note\"");
  EXPECT_EQ(remedy("q1_deg;x_mm;speed;operator\n1;2;9;Anna\n2;3;8;Bert\n"),
            "to keep one: --map \"speed=NAME_UNIT\"");
}

TEST(Spelling, UnitsInCellsThatDisagreeAreRefused) {
  EXPECT_EQ(refusal_of("q1;x\n1 deg;2 mm\n2 deg;3 m\n").code, "E-IMPORT-CELLS");
  EXPECT_EQ(refusal_of("q1 [rad];x\n1 deg;2 mm\n2 deg;3 mm\n").code, "E-IMPORT-CELLS");
  EXPECT_EQ(refusal_of("q1;x\n1 deg;2 cm\n2 deg;3 cm\n").code, "E-IMPORT-UNIT");
  EXPECT_EQ(in_short(imported_text("q1;x\n1 deg;2 mm\n0;3 mm\n")), "q1_deg=1|0 x_mm=2|3");
  EXPECT_EQ(in_short(imported_text("pose;q1;x\n1m;1 deg;2 mm\n2m;3 deg;4 mm\n")),
            "pose=1m|2m q1_deg=1|3 x_mm=2|4");
}

TEST(Spelling, ASignThatMayDivideThousandsOrDecimalsIsAskedFor) {
  EXPECT_EQ(refusal_of("q1_deg;x_mm\n1.25;1,234\n").code, "E-IMPORT-DECIMAL");
  ImportWishes point;
  point.dialect.decimal = '.';
  EXPECT_EQ(in_short(imported_text("q1_deg;x_mm\n1.25;1,234\n", point)), "q1_deg=1.25 x_mm=1234");
  EXPECT_EQ(in_short(imported_text("q1_deg;x_mm\n1.25;1,234.5\n2.5;1,000\n")),
            "q1_deg=1.25|2.5 x_mm=1234.5|1000");
}

}  // namespace
}  // namespace plumb::offline

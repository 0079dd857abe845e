// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "formula/unit_text.hpp"

namespace plumb::offline {
namespace {

struct Row {
  const char* text;
  const char* dimension;
  double factor;
  const char* si;
};

TEST(Units, AreReadAsPeopleWriteThem) {
  for (const Row& row :
       std::initializer_list<Row>{{"1", "1", 1.0, "1"},
                                  {"rad", "1", 1.0, "rad"},
                                  {"urad/(N m)", "1/(N m)", 1e-6, "rad/(N m)"},
                                  {"rad/Nm", "1/(N m)", 1.0, "rad/(N m)"},
                                  {"rad/N/m", "1/(N m)", 1.0, "rad/N/m"},
                                  {"mm/kN", "m/N", 1e-6, "m/N"},
                                  {"1/K^2", "1/K^2", 1.0, "1/K^2"},
                                  {"m^-1", "1/m", 1.0, "m^-1"},
                                  {"kg m/s^2", "N", 1.0, "kg m/s^2"},
                                  {"J", "N m", 1.0, "J"},
                                  {"W", "N m/s", 1.0, "W"},
                                  {"Pa", "N/m^2", 1.0, "Pa"},
                                  {"um/h", "m/s", 1e-6 / 3600.0, "m/s"},
                                  {"(mm)^2/(K s)", "m^2/(s K)", 1e-6, "(m)^2/(K s)"}}) {
    const auto read = parse_unit(row.text);
    ASSERT_TRUE(std::holds_alternative<WrittenUnit>(read)) << row.text;
    const auto& unit = std::get<WrittenUnit>(read);
    EXPECT_EQ(text_of(unit.dimension), row.dimension) << row.text;
    EXPECT_DOUBLE_EQ(unit.factor, row.factor) << row.text;
    EXPECT_EQ(unit.si, row.si) << row.text;
    // What is shown is a unit again, of the same dimension and already SI.
    const auto again = parse_unit(unit.si);
    ASSERT_TRUE(std::holds_alternative<WrittenUnit>(again)) << unit.si;
    EXPECT_EQ(std::get<WrittenUnit>(again).dimension, unit.dimension) << unit.si;
    EXPECT_EQ(std::get<WrittenUnit>(again).factor, 1.0) << unit.si;
  }
}

TEST(Units, PointAtWhatIsNone) {
  const auto at = [](const char* text) {
    const auto read = parse_unit(text);
    return std::holds_alternative<UnitError>(read) ? static_cast<int>(std::get<UnitError>(read).at)
                                                   : -1;
  };
  EXPECT_EQ(at(""), 0);
  EXPECT_EQ(at("rad/"), 4);
  EXPECT_EQ(at("rad/(N m"), 8);
  EXPECT_EQ(at("rad)"), 3);
  EXPECT_EQ(at("rad/lbf"), 4);
  EXPECT_EQ(at("m^x"), 2);
  EXPECT_EQ(at("m^0"), 2);
  EXPECT_EQ(at("((((((((((m))))))))))"), 8);
}

}  // namespace
}  // namespace plumb::offline

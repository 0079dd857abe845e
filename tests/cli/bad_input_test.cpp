// SPDX-License-Identifier: Apache-2.0
// Whatever is wrong with the input: one clear message, the right exit code, nothing half-written.
#include <gtest/gtest.h>

#include <functional>
#include <regex>
#include <sstream>

#include "sandbox.hpp"

namespace {

/// How a sound cell is spoilt, and what fit must say.
struct Spoilt {
  const char* name;
  std::function<void(const Sandbox&)> spoil;
  int exit;
  const char* code;
};

std::string replaced(const std::string& text, const std::string& pattern, const std::string& by) {
  return std::regex_replace(text, std::regex(pattern), by, std::regex_constants::format_first_only);
}

void in_csv(const Sandbox& box, const std::string& pattern, const std::string& by) {
  box.write("cell/measurements.csv", replaced(box.read("cell/measurements.csv"), pattern, by));
}

void in_cell(const Sandbox& box, const std::string& pattern, const std::string& by) {
  box.write("cell/cell.toml", replaced(box.read("cell/cell.toml"), pattern, by));
}

/// Comments, header, and the rows that `make` gives.
void with_rows(const Sandbox& box,
               const std::function<std::string(const std::vector<std::string>&)>& make) {
  std::istringstream in(box.read("cell/measurements.csv"));
  std::string line, head;
  std::vector<std::string> rows;
  while (std::getline(in, line)) {
    if (line.starts_with("#") || line.starts_with("pose"))
      head += line + "\n";
    else
      rows.push_back(line);
  }
  box.write("cell/measurements.csv", head + make(rows));
}

std::string first_rows(const std::vector<std::string>& rows, std::size_t count) {
  std::string out;
  for (std::size_t i = 0; i < count; ++i) out += rows[i] + "\n";
  return out;
}

const std::vector<Spoilt>& matrix() {
  static const std::vector<Spoilt> all{
      {"EmptyFile", [](const Sandbox& b) { b.write("cell/measurements.csv", ""); }, 3, "E-CSV"},
      {"HeaderOnly", [](const Sandbox& b) { with_rows(b, [](const auto&) { return ""; }); }, 3,
       "E-CSV"},
      {"NoUnit", [](const Sandbox& b) { in_csv(b, "x_mm", "x"); }, 3, "E-CSV-UNIT"},
      {"UnknownUnit", [](const Sandbox& b) { in_csv(b, "x_mm", "x_furlong"); }, 3, "E-CSV-UNIT"},
      {"DuplicateColumn", [](const Sandbox& b) { in_csv(b, "y_mm", "x_mm"); }, 3, "E-CSV"},
      {"RaggedRow", [](const Sandbox& b) { in_csv(b, "\nP([^,]*),[^,]*,", "\nP$1,"); }, 3, "E-CSV"},
      {"TextInANumber", [](const Sandbox& b) { in_csv(b, "\nP([^,]*),[^,]*,", "\nP$1,oops,"); }, 3,
       "E-CSV"},
      {"NaN", [](const Sandbox& b) { in_csv(b, "\nP([^,]*),[^,]*,", "\nP$1,nan,"); }, 3, "E-CSV"},
      {"TooLarge", [](const Sandbox& b) { in_csv(b, "\nP([^,]*),[^,]*,", "\nP$1,1e999,"); }, 3,
       "E-CSV"},
      {"WrongJointCount", [](const Sandbox& b) { in_csv(b, "q6_deg", "q7_deg"); }, 3, "E-CSV"},
      {"AllPosesEqual",
       [](const Sandbox& b) {
         with_rows(b, [](const auto& rows) {
           std::string out;
           for (int i = 0; i < 60; ++i)
             out += "E" + std::to_string(i) + rows[0].substr(rows[0].find(',')) + "\n";
           return out;
         });
       },
       3, "E-SPLIT"},
      {"FewerRowsThanParameters",
       [](const Sandbox& b) { with_rows(b, [](const auto& rows) { return first_rows(rows, 8); }); },
       4, "E-FIT-FEW"},
      {"AnotherConvention",
       [](const Sandbox& b) {
         const bool standard =
             b.read("cell/cell.toml").find("dh_convention = \"standard\"") != std::string::npos;
         in_cell(b, "dh_convention = \"[a-z]*\"",
                 std::string("dh_convention = \"") + (standard ? "modified" : "standard") + "\"");
       },
       4, "E-FIT-"},
      {"MissingFile", [](const Sandbox& b) { in_cell(b, "measurements.csv", "gone.csv"); }, 3,
       "E-"},
      {"DirectoryInsteadOfFile", [](const Sandbox& b) { in_cell(b, "measurements.csv", "."); }, 3,
       "E-"},
      {"BinaryGarbage",
       [](const Sandbox& b) { b.write("cell/measurements.csv", std::string("\x7f\0\1\2", 4)); }, 3,
       "E-CSV"},
      {"BrokenToml", [](const Sandbox& b) { in_cell(b, "\\[robot\\]", "[robot"); }, 3, "E-TOML"},
      {"TruncatedToml",
       [](const Sandbox& b) {
         const std::string text = b.read("cell/cell.toml");
         b.write("cell/cell.toml", text.substr(0, text.find("joints = [") + 40));
       },
       3, "E-TOML"},
      {"NaNInACell", [](const Sandbox& b) { in_cell(b, "alpha = [-0-9.]+", "alpha = nan"); }, 3,
       "E-CELL"},
      {"UnknownKey", [](const Sandbox& b) { in_cell(b, "gravity", "gravitas"); }, 3, "E-CELL"},
      {"UnknownEffect",
       [](const Sandbox& b) {
         in_cell(b, "geometry = true", "geometry = true\n[effects.joint_complience]");
       },
       3, "E-CELL-EFFECT"},
      {"EffectWithoutItsColumn",
       [](const Sandbox& b) {
         in_cell(b, "geometry = true", "geometry = true\n[effects.thermal_growth]");
       },
       3, "E-EFFECT-DATA"},
  };
  return all;
}

class BadInput : public ::testing::TestWithParam<Spoilt> {};

TEST_P(BadInput, IsOneClearMessageTheRightExitCodeAndNothingWritten) {
  const Sandbox box;
  ASSERT_EQ(box.plumb({"demo", "clean", "cell"}).exit, 0);
  GetParam().spoil(box);
  const auto before = box.listing();
  const Ran ran = box.plumb({"-C", "cell", "fit", "--json"});
  EXPECT_EQ(ran.exit, GetParam().exit) << ran.err;
  EXPECT_EQ(box.listing(), before);
  const auto json = ran.json();
  EXPECT_FALSE(json.at("ok").get<bool>());
  EXPECT_NE(ran.err.find(std::string("error[") + GetParam().code), std::string::npos) << ran.err;
  EXPECT_NE(ran.err.find("help:"), std::string::npos) << ran.err;
}

INSTANTIATE_TEST_SUITE_P(Fit, BadInput, ::testing::ValuesIn(matrix()),
                         [](const auto& spoilt) { return std::string(spoilt.param.name); });

TEST(BadInputs, AMistypedEffectIsAskedAboutByItsRightName) {
  const Sandbox box;
  ASSERT_EQ(box.plumb({"demo", "clean", "cell"}).exit, 0);
  in_cell(box, "geometry = true", "geometry = true\n[effects.joint_complience]");
  EXPECT_NE(box.plumb({"-C", "cell", "fit"}).err.find("did you mean 'joint_compliance'?"),
            std::string::npos);
}

TEST(BadInputs, AMissingFileIsShownWhereTheCellNamesItWithItsNeighbour) {
  const Sandbox box;
  ASSERT_EQ(box.plumb({"demo", "clean", "cell"}).exit, 0);
  in_cell(box, "measurements.csv", "measurments.csv");
  const Ran ran = box.plumb({"-C", "cell", "fit"});
  EXPECT_EQ(ran.exit, 3);
  EXPECT_TRUE(std::regex_search(ran.err, std::regex("cell.toml:[0-9]+:10"))) << ran.err;
  EXPECT_NE(ran.err.find("did you mean 'measurements.csv'?"), std::string::npos) << ran.err;
  in_cell(box, "measurments.csv", "measurements.csv");
  in_cell(box, "held_out = \"auto\"", "held_out = \"file:verify.csv\"");
  const Ran verify = box.plumb({"-C", "cell", "fit"});
  EXPECT_EQ(verify.exit, 3);
  EXPECT_TRUE(std::regex_search(verify.err, std::regex("cell.toml:[0-9]+:12"))) << verify.err;
}

/// Rows of the clean demo, changed one by one by `change`.
void change_rows(const Sandbox& box, const std::string& more_header,
                 const std::function<std::string(std::string)>& change) {
  std::istringstream in(box.read("cell/measurements.csv"));
  std::string line, out;
  while (std::getline(in, line))
    out += (line.starts_with("#")      ? line
            : line.starts_with("pose") ? line + more_header
                                       : change(line)) +
           "\n";
  box.write("cell/measurements.csv", out);
}

TEST(BadInputs, EveryRowHeldOutIsSaidInThoseWords) {
  const Sandbox box;
  ASSERT_EQ(box.plumb({"demo", "clean", "cell"}).exit, 0);
  change_rows(box, ",set", [](const std::string& row) { return row + ",held"; });
  in_cell(box, "held_out = \"auto\"", "held_out = \"column:set\"");
  const Ran ran = box.plumb({"-C", "cell", "fit"});
  EXPECT_TRUE(ran.exit == 3 || ran.exit == 4) << ran.err;
  EXPECT_NE(ran.err.find("every row is held out"), std::string::npos) << ran.err;
}

TEST(BadInputs, PosesThatAreNearlyOneAreCalledSo) {
  const Sandbox box;
  ASSERT_EQ(box.plumb({"demo", "clean", "cell"}).exit, 0);
  int i = 0;
  std::string first;
  change_rows(box, "", [&](const std::string& row) {
    if (first.empty()) first = row.substr(row.find(','));
    // Each joint reading a thousandth of a degree apart.
    std::string out = "N" + std::to_string(i);
    std::istringstream cells(first.substr(1));
    std::string cell;
    for (int k = 0; std::getline(cells, cell, ','); ++k)
      out +=
          k < 6 ? "," + std::to_string(std::stod(cell) + 1e-3 * ((i * (k + 3)) % 7)) : "," + cell;
    ++i;
    return out;
  });
  const Ran ran = box.plumb({"-C", "cell", "fit"});
  EXPECT_EQ(ran.exit, 4) << ran.err;
  EXPECT_NE(ran.err.find("E-FIT-ONE-POSE"), std::string::npos) << ran.err;
}

TEST(BadInputs, AnAxisThatLacksIsWarnedOfInSpaceAndNotInThePlane) {
  const Sandbox box;
  ASSERT_EQ(box.plumb({"demo", "clean", "cell"}).exit, 0);
  in_csv(box, "z_mm", "height_mm");
  const Ran ran = box.plumb({"-C", "cell", "fit"});
  EXPECT_NE(ran.err.find("warning[W-CSV-AXES]: z is not measured"), std::string::npos) << ran.err;
  ASSERT_EQ(box.plumb({"demo", "beam", "plane"}).exit, 0);
  EXPECT_EQ(box.plumb({"-C", "plane", "fit"}).err.find("W-CSV-AXES"), std::string::npos);
}

TEST(BadInputs, ReadingsBeyondTheLimitsAreFoundByCheckWithTheirLine) {
  const Sandbox box;
  ASSERT_EQ(box.plumb({"demo", "clean", "cell"}).exit, 0);
  in_csv(box, "\nP([^,]*),[^,]*,", "\nP$1,720.5,");
  const Ran ran = box.plumb({"-C", "cell", "check"});
  EXPECT_EQ(ran.exit, 0) << ran.out;  // one such row is left out, as fit does
  EXPECT_NE(ran.err.find("W-CHECK-LIMITS"), std::string::npos) << ran.err;
  EXPECT_NE(ran.err.find("W-CHECK-OUTLIER"), std::string::npos) << ran.err;
  EXPECT_NE(ran.err.find("measurements.csv:"), std::string::npos) << ran.err;
}

TEST(NewAndExport, AUrdfGoesInAndComesOut) {
  const Sandbox box;
  ASSERT_EQ(box.plumb({"demo", "clean", "cell"}).exit, 0);
  ASSERT_EQ(box.plumb({"-C", "cell", "export", "-o", "arm.urdf"}).exit, 0);
  const Ran again = box.plumb({"new", "other", "--urdf", "arm.urdf", "--convention", "modified"});
  ASSERT_EQ(again.exit, 0) << again.err;
  EXPECT_NE(box.read("other/cell.toml").find("dh_convention = \"modified\""), std::string::npos);
  EXPECT_EQ(box.plumb({"-C", "cell", "export", "-o", "arm.urdf"}).exit, 2);
  box.write("broken.urdf", "<robot");
  EXPECT_EQ(box.plumb({"new", "third", "--urdf", "broken.urdf"}).exit, 3);
}

}  // namespace

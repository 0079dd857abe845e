// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "sandbox.hpp"

namespace {

using Json = nlohmann::ordered_json;

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Screens wrap.
std::string one_line(const std::string& text) {
  return std::regex_replace(text, std::regex("\\s+"), " ");
}

class CheckVerb : public testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(box.plumb({"demo", "clean", "cell"}).exit, 0); }

  /// The second joint counts the other way, angles are labelled rad, the convention is the other.
  void scramble() const {
    std::string csv = box.read("cell/measurements.csv");
    csv = std::regex_replace(csv, std::regex("(q[1-6])_deg"), "$1_rad");
    csv = std::regex_replace(csv, std::regex("\n(P[^,]*,[^,]*),-?"), "\n$1,~");
    const std::string original = box.read("cell/measurements.csv");
    std::string out;
    for (std::size_t i = 0, at = 0; i < csv.size(); ++i) {
      if (csv[i] != '~') {
        out += csv[i];
        continue;
      }
      // What stood there: a minus goes, a plus becomes one.
      const auto row_end = csv.find('\n', i);
      const std::string rest = csv.substr(i + 1, row_end - i - 1);
      at = original.find(rest, at);
      out += original[at - 1] == '-' ? "" : "-";
    }
    box.write("cell/measurements.csv", out);
    std::string cell = box.read("cell/cell.toml");
    const bool standard = has(cell, "dh_convention = \"standard\"");
    cell = std::regex_replace(
        cell, std::regex("dh_convention = \"[a-z]+\""),
        standard ? "dh_convention = \"modified\"" : "dh_convention = \"standard\"");
    box.write("cell/cell.toml", cell);
  }

  Sandbox box;
};

TEST_F(CheckVerb, ASoundCellIsUsableAndTheFirstLineSaysSo) {
  const Ran ran = box.plumb({"-C", "cell", "check"});
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_EQ(ran.out.rfind("Usable: ", 0), 0U) << ran.out;
  const Json result = box.plumb({"-C", "cell", "check", "--json"}).json().at("result");
  EXPECT_EQ(ran.out.substr(0, ran.out.find('\n')), result.at("verdict").get<std::string>());
}

TEST_F(CheckVerb, TheResultHasTheKeysThatChecksRelyOn) {
  const Json result = box.plumb({"-C", "cell", "check", "--json"}).json().at("result");
  for (const auto* key : {"ok", "findings", "convention", "identifiability", "coverage", "effects",
                          "noise_floor_mm", "rounding"})
    EXPECT_TRUE(result.contains(key)) << key;
  for (const auto* key : {"present", "best", "residual_mm", "table", "changed", "same_points"})
    EXPECT_TRUE(result.at("convention").contains(key)) << key;
  for (const auto* key :
       {"rank", "scaled_condition", "calibrability", "observability", "correlations"})
    EXPECT_TRUE(result.at("identifiability").contains(key)) << key;
  EXPECT_EQ(result.at("identifiability").at("rank"), 27);
  for (const auto* key : {"O1", "O2", "O3", "O4", "O5"})
    EXPECT_GT(result.at("identifiability").at("observability").at(key), 0.0) << key;
  EXPECT_EQ(result.at("coverage").size(), 6U);
  for (const auto& effect : result.at("effects"))
    for (const auto* key : {"effect", "testable", "why", "measure"})
      EXPECT_TRUE(effect.at(key).is_string());
  EXPECT_EQ(result.at("effects").size(), 30U);
}

TEST_F(CheckVerb, CalibrabilityIsOfTheOrderThatFitPrints) {
  const Json check = box.plumb({"-C", "cell", "check", "--json"}).json().at("result");
  const Json fit = box.plumb({"-C", "cell", "fit", "--dry-run", "--json"}).json().at("result");
  const double ratio = check.at("identifiability").at("calibrability").get<double>() /
                       fit.at("calibrability").get<double>();
  EXPECT_GT(ratio, 0.5);
  EXPECT_LT(ratio, 2.0);
}

TEST_F(CheckVerb, AScrambledCellIsExitThreeAndNothingIsWritten) {
  scramble();
  const auto before = box.listing();
  const std::string cell = box.read("cell/cell.toml");
  const Ran ran = box.plumb({"-C", "cell", "check", "--json"});
  EXPECT_EQ(ran.exit, 3) << ran.err;
  EXPECT_EQ(ran.json().at("error").at("code"), "E-CHECK-CONVENTION");
  const Json best = ran.json().at("result").at("convention").at("best");
  EXPECT_EQ(best.at("joint_angle_unit"), "deg");
  EXPECT_EQ(best.at("reversed_joints"), Json::array({2}));
  EXPECT_LT(best.at("residual_mm"), 0.1);
  EXPECT_EQ(box.plumb({"-C", "cell", "check", "--fix", "--dry-run"}).exit, 0);
  EXPECT_EQ(box.listing(), before);
  EXPECT_EQ(box.read("cell/cell.toml"), cell);
}

TEST_F(CheckVerb, FixMakesItUsableAndKeepsTheOldMeasurements) {
  const Json sound = box.plumb({"-C", "cell", "fit", "--dry-run", "--json"}).json().at("result");
  scramble();
  const std::string old = box.read("cell/measurements.csv");
  const Ran ran = box.plumb({"-C", "cell", "check", "--fix", "--json"});
  ASSERT_EQ(ran.exit, 0) << ran.err << ran.out;
  EXPECT_EQ(ran.json().at("result").at("files").size(), 2U);
  EXPECT_EQ(box.read("cell/measurements.csv"), old);
  EXPECT_EQ(box.plumb({"-C", "cell", "check"}).exit, 0);
  const Json fit = box.plumb({"-C", "cell", "fit", "--dry-run", "--json"}).json().at("result");
  EXPECT_NEAR(fit.at("held_out").at("rms_mm").get<double>(),
              sound.at("held_out").at("rms_mm").get<double>(), 1e-6);
  EXPECT_TRUE(has(box.read("cell/cell.toml"), "measurements_fixed.csv"));
}

TEST_F(CheckVerb, FixNeverReplacesAFileWithoutForce) {
  scramble();
  box.write("cell/measurements_fixed.csv", "mine\n");
  const std::string cell = box.read("cell/cell.toml");
  const Ran ran = box.plumb({"-C", "cell", "check", "--fix"});
  EXPECT_EQ(ran.exit, 2);
  EXPECT_TRUE(has(ran.err, "E-EXISTS")) << ran.err;
  EXPECT_EQ(box.read("cell/measurements_fixed.csv"), "mine\n");
  EXPECT_EQ(box.read("cell/cell.toml"), cell);
  EXPECT_EQ(box.plumb({"-C", "cell", "check", "--fix", "--force"}).exit, 0);
}

TEST_F(CheckVerb, FixOfASoundCellChangesNothing) {
  const auto before = box.listing();
  const std::string cell = box.read("cell/cell.toml");
  EXPECT_EQ(box.plumb({"-C", "cell", "check", "--fix"}).exit, 0);
  EXPECT_EQ(box.listing(), before);
  EXPECT_EQ(box.read("cell/cell.toml"), cell);
}

TEST_F(CheckVerb, ATrackerThatMovedIsNamedWhereCompareNamesItAndIsNotCalledPlainlyUsable) {
  ASSERT_EQ(box.plumb({"-C", "cell", "simulate", "--force", "--poses", "120", "--effect",
                       "step_base=15mm", "--geometry-mm", "0.3", "--noise-um", "20"})
                .exit,
            0);
  const Ran screen = box.plumb({"-C", "cell", "check"});
  EXPECT_EQ(screen.exit, 0) << screen.err;
  EXPECT_EQ(screen.out.rfind("Usable only with the effect 'step'", 0), 0U) << screen.out;
  EXPECT_TRUE(has(screen.err, "W-CHECK-MOVED")) << screen.err;
  EXPECT_TRUE(has(screen.out, "Next: plumb -C cell compare")) << screen.out;
  const Json compared =
      box.plumb({"-C", "cell", "compare", "--json"}).json().at("result").at("change_points");
  ASSERT_EQ(compared.size(), 1U);
  EXPECT_EQ(compared[0].at("of"), "base");
  const int row = compared[0].at("after_row");
  const std::string csv = box.read("cell/measurements.csv");
  const auto pose = csv.find("\n" + compared[0].at("after_pose").get<std::string>() + ",");
  ASSERT_NE(pose, std::string::npos);
  const auto line = 2 + std::count(csv.begin(), csv.begin() + static_cast<long>(pose), '\n');
  EXPECT_TRUE(has(one_line(screen.out), "lines " + std::to_string(line) + " and " +
                                            std::to_string(line + 1) + " of measurements.csv"))
      << screen.out;
  const std::string fit = one_line(box.plumb({"-C", "cell", "fit", "--dry-run"}).out);
  EXPECT_TRUE(has(fit, "the tracker or the base moved between rows " + std::to_string(row) +
                           " and " + std::to_string(row + 1)))
      << fit;
  EXPECT_TRUE(has(fit, "see plumb compare")) << fit;
  // What check advises mends it.
  const std::string advice =
      "plumb -C cell add step --set after_row=" + std::to_string(row) + " --set of=base";
  EXPECT_TRUE(has(one_line(screen.err), advice)) << screen.err;
  ASSERT_EQ(box.plumb({"-C", "cell", "add", "step", "--set", "after_row=" + std::to_string(row),
                       "--set", "of=base"})
                .exit,
            0);
  const Ran mended = box.plumb({"-C", "cell", "check"});
  EXPECT_EQ(mended.out.rfind("Usable: ", 0), 0U) << mended.out;
  EXPECT_FALSE(has(mended.err, "W-CHECK-MOVED")) << mended.err;
  EXPECT_FALSE(has(box.plumb({"-C", "cell", "fit", "--dry-run"}).out, "It looks as if"));
}

TEST_F(CheckVerb, NoSampleCellButTheBumpedOneIsSaidToHaveMoved) {
  for (const char* name : {"clean", "gear", "ripple", "reversal", "thermal", "unknown", "mixed",
                           "compliance", "beam", "scara"}) {
    ASSERT_EQ(box.plumb({"demo", name, name}).exit, 0) << name;
    const Ran ran = box.plumb({"-C", name, "check"});
    EXPECT_FALSE(has(ran.err, "W-CHECK-MOVED")) << name << ran.err;
  }
  ASSERT_EQ(box.plumb({"demo", "bumped", "bumped"}).exit, 0);
  const Ran ran = box.plumb({"-C", "bumped", "check"});
  EXPECT_TRUE(has(ran.err, "W-CHECK-MOVED")) << ran.err;
  EXPECT_TRUE(has(one_line(ran.out), "the reflector or the tool moved by some")) << ran.out;
}

TEST_F(CheckVerb, TooFewPosesAreExitFour) {
  const std::string csv = box.read("cell/measurements.csv");
  std::size_t at = csv.find("\nP");
  for (int row = 0; row < 7; ++row) at = csv.find('\n', at + 1);
  box.write("cell/measurements.csv", csv.substr(0, at + 1));
  EXPECT_EQ(box.plumb({"-C", "cell", "check"}).exit, 4);
}

}  // namespace

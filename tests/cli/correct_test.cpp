// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <tuple>

#include "sandbox.hpp"

namespace {

using Json = nlohmann::ordered_json;

class CorrectVerb : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    box = new Sandbox;
    ASSERT_EQ(box->plumb({"demo", "gear", "cell"}).exit, 0);
    ASSERT_EQ(box->plumb({"-C", "cell", "compile"}).exit, 0);
  }
  static void TearDownTestSuite() { delete box; }

  static Sandbox* box;
};
Sandbox* CorrectVerb::box = nullptr;

TEST_F(CorrectVerb, CorrectsEveryTargetOfTheDemoByMillimetres) {
  const Ran ran = box->plumb(
      {"correct", "cell/robot.plumb", "--data", "cell/targets.csv", "-o", "all.csv", "--json"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const Json result = ran.json().at("result");
  EXPECT_EQ(result.at("rows"), 20);
  EXPECT_EQ(result.at("status").value("ok", 0) + result.at("status").value("outside-domain", 0), 20)
      << result.dump();
  const Csv csv = box->csv("all.csv");
  double largest = 0.0;
  for (std::size_t i = 0; i < csv.rows(); ++i) {
    double squares = 0.0;
    for (const auto* axis : {"x_mm", "y_mm", "z_mm"})
      squares += std::pow(csv.numbers(std::string("c") + axis)[i] - csv.numbers(axis)[i], 2);
    largest = std::max(largest, std::sqrt(squares));
    double norm = 0.0;
    for (const auto* part : {"cqw", "cqx", "cqy", "cqz"}) norm += std::pow(csv.numbers(part)[i], 2);
    EXPECT_NEAR(norm, 1.0, 1e-12);
  }
  EXPECT_NEAR(largest, result.at("largest_mm").get<double>(), 1e-9);
  EXPECT_GT(largest, 0.05);
  EXPECT_LT(largest, 20.0);
  EXPECT_TRUE(result.at("likely_mistake").is_null());
  EXPECT_EQ(result.at("likely_mistake_reason"), "no target was refused");
}

TEST_F(CorrectVerb, WithoutAJointStateThereIsNothingToStartFrom) {
  const Csv csv = box->csv("cell/targets.csv");
  box->write("bare.csv", csv.without({"q1_deg", "q2_deg", "q3_deg", "q4_deg", "q5_deg", "q6_deg"}));
  const Ran none =
      box->plumb({"correct", "cell/robot.plumb", "--data", "bare.csv", "-o", "n.csv", "--json"});
  EXPECT_EQ(none.exit, 3);
  EXPECT_EQ(none.json().at("error").at("code"), "E-TARGET-SEED");
  std::string start;
  for (int j = 1; j <= 6; ++j)
    start += (j == 1 ? "" : ",") + csv.columns.at("q" + std::to_string(j) + "_deg")[0];
  const Ran some = box->plumb(
      {"correct", "cell/robot.plumb", "--data", "bare.csv", "--start=" + start, "-o", "s.csv"});
  ASSERT_EQ(some.exit, 0) << some.err;
  EXPECT_EQ(box->csv("s.csv").columns.at("status")[0], "ok");
}

TEST_F(CorrectVerb, WithoutAQuaternionTheSeedsOrientationIsMeantAndSaid) {
  box->write("plain.csv", box->csv("cell/targets.csv").without({"qw", "qx", "qy", "qz"}));
  const Ran ran = box->plumb({"correct", "cell/robot.plumb", "--data", "plain.csv", "-o", "o.csv"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_NE(ran.err.find("note[N-TARGET-ORIENTATION]"), std::string::npos) << ran.err;
  ASSERT_EQ(
      box->plumb({"correct", "cell/robot.plumb", "--data", "cell/targets.csv", "-o", "w.csv"}).exit,
      0);
  const Csv with = box->csv("w.csv"), out = box->csv("o.csv");
  for (const auto* column : {"cx_mm", "cy_mm", "cz_mm", "cqw", "cqx", "cqy", "cqz"})
    for (std::size_t i = 0; i < out.rows(); ++i)
      EXPECT_NEAR(out.numbers(column)[i], with.numbers(column)[i], 2e-6) << column;
}

TEST_F(CorrectVerb, ATargetOutOfReachIsRefusedAndStaysItself) {
  box->write("far.csv",
             "x_mm,y_mm,z_mm,qw,qx,qy,qz,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n"
             "9000,0,500,1,0,0,0,10,-60,70,20,40,30\n");
  const Ran ran =
      box->plumb({"correct", "cell/robot.plumb", "--data", "far.csv", "-o", "far_out.csv"});
  EXPECT_EQ(ran.exit, 4) << ran.err;
  EXPECT_NE(ran.err.find("error[E-CORRECT-NONE]: Corrected 0 of 1 targets"), std::string::npos)
      << ran.err;
  EXPECT_FALSE(std::filesystem::exists(box->path() / "far_out.csv"));
}

TEST_F(CorrectVerb, BadTargetsAreExitThreeWithTheirPlace) {
  box->write("bad.csv", "x_mm,y_mm,z\n1,2,3\n");
  const Ran ran = box->plumb({"correct", "cell/robot.plumb", "--data", "bad.csv", "-o", "b.csv"});
  EXPECT_EQ(ran.exit, 3);
  EXPECT_NE(ran.err.find("bad.csv:1:11"), std::string::npos) << ran.err;
  EXPECT_FALSE(std::filesystem::exists(box->path() / "b.csv"));
}

TEST_F(CorrectVerb, NoCorrectionIsLargerThanTheGuardAllowsAndThoseThatWereAreMarked) {
  ASSERT_EQ(box->plumb({"demo", "gear", "tight"}).exit, 0);
  std::string text = box->read("tight/cell.toml");
  const std::size_t at = text.find("max_correction_mm");
  ASSERT_NE(at, std::string::npos) << text;
  text.replace(at, text.find('\n', at) - at, "max_correction_mm = 0.05");
  box->write("tight/cell.toml", text);
  ASSERT_EQ(box->plumb({"-C", "tight", "compile"}).exit, 0);
  const Ran ran = box->plumb(
      {"correct", "tight/robot.plumb", "--data", "tight/targets.csv", "-o", "cut.csv", "--json"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const Csv csv = box->csv("cut.csv");
  int limited = 0;
  for (std::size_t i = 0; i < csv.rows(); ++i) {
    double squares = 0.0;
    for (const auto* axis : {"x_mm", "y_mm", "z_mm"})
      squares += std::pow(csv.numbers(std::string("c") + axis)[i] - csv.numbers(axis)[i], 2);
    EXPECT_LT(std::sqrt(squares), 0.05 + 1e-9);
    limited += csv.columns.at("status")[i] == "limited" ? 1 : 0;
  }
  EXPECT_GT(limited, 0);
  EXPECT_EQ(ran.json().at("result").at("limited"), limited);
  EXPECT_NE(ran.out.find("W-CORRECT-LIMITED"), std::string::npos) << ran.out;
  const Ran predicted = box->plumb({"predict", "tight/robot.plumb", "--data",
                                    "tight/measurements.csv", "-o", "whole.csv", "--json"});
  ASSERT_EQ(predicted.exit, 0) << predicted.err;
  const auto status = predicted.json().at("result").at("status").at("limited").get<int>();
  const auto warnings = predicted.json().at("warnings");
  const auto found = std::find_if(warnings.begin(), warnings.end(), [](const auto& warning) {
    return warning.at("code") == "W-PREDICT-LIMITED";
  });
  ASSERT_NE(found, warnings.end()) << predicted.out;
  const auto message = found->at("message").template get<std::string>();
  EXPECT_EQ(message.rfind("in " + std::to_string(status) + " of ", 0), 0U) << message;
  EXPECT_NE(message.find("0.050 mm"), std::string::npos) << message;
}

/// A model of an arm fitted with 0 and 4 kg and around 20 degC, and one of its targets.
class FarInputs : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    box = new Sandbox;
    ASSERT_EQ(box->plumb({"demo", "thermal", "cell"}).exit, 0);
    ASSERT_EQ(box->plumb({"-C", "cell", "simulate", "--force", "--effect", "thermal_growth::4",
                          "--payloads", "0,4"})
                  .exit,
              0);
    std::string text = box->read("cell/cell.toml");
    const std::size_t at = text.find("geometry = true");
    ASSERT_NE(at, std::string::npos);
    text.insert(at + std::string("geometry = true").size(),
                "\n[effects.joint_compliance]\njoints = [\"J2\"]\n[effects.thermal_growth]\nsensor "
                "= \"temp\"\n");
    box->write("cell/cell.toml", text);
    const Ran ran = box->plumb({"-C", "cell", "compile"});
    ASSERT_EQ(ran.exit, 0) << ran.err;
    const Csv rows = box->csv("cell/measurements.csv");
    const Ran point = box->plumb(
        {"predict", "cell/robot.plumb", "--data", "cell/measurements.csv", "-o", "points.csv"});
    ASSERT_EQ(point.exit, 0) << point.err;
  }
  static void TearDownTestSuite() { delete box; }

  /// correct or predict of row 10 with this payload and temperature.
  static Csv one(const std::string& verb, const std::string& kg, const std::string& degC) {
    const Csv csv = box->csv("points.csv");
    std::string head, row;
    for (int j = 1; j <= 6; ++j) {
      head += "q" + std::to_string(j) + "_deg,";
      row += csv.columns.at("q" + std::to_string(j) + "_deg")[10] + ",";
    }
    if (verb == "correct") {
      head += "x_mm,y_mm,z_mm,qw,qx,qy,qz,";
      for (const auto* name : {"px_mm", "py_mm", "pz_mm", "pqw", "pqx", "pqy", "pqz"})
        row += csv.columns.at(name)[10] + ",";
    }
    // The first row is sound, so that something is corrected.
    box->write("one.csv",
               head + "payload_kg,temp_degC\n" + row + "4,21\n" + row + kg + "," + degC + "\n");
    const Ran ran =
        box->plumb({verb, "cell/robot.plumb", "--data", "one.csv", "-o", "one_out.csv", "--force"});
    EXPECT_EQ(ran.exit, 0) << ran.err;
    said = ran.err;
    return box->csv("one_out.csv");
  }

  static Sandbox* box;
  static std::string said;
};
Sandbox* FarInputs::box = nullptr;
std::string FarInputs::said;

TEST_F(FarInputs, WithinWhatWasFittedAllIsWell) {
  for (const auto* verb : {"predict", "correct"})
    EXPECT_EQ(one(verb, "4", "21").columns.at("status")[1], "ok") << said;
}

TEST_F(FarInputs, SixHundredKilogramsForFourAndKelvinForDegreesAreNotOk) {
  for (const auto* verb : {"predict", "correct"})
    for (const auto& [kg, degC, word] : {std::tuple{"600", "21", "payload 600 kg (fitted 0 .. 4)"},
                                         std::tuple{"4", "294", "temp 294 degC"}}) {
      const Csv csv = one(verb, kg, degC);
      EXPECT_EQ(csv.columns.at("status")[1], "outside-domain") << verb << kg << degC;
      EXPECT_NE(said.find("W-PREDICT-OUTSIDE"), std::string::npos) << said;
      EXPECT_NE(said.find(word), std::string::npos) << said;
      if (std::string(verb) == "predict") continue;
      EXPECT_NEAR(csv.numbers("cx_mm")[1], csv.numbers("x_mm")[1], 1e-9);
    }
}

TEST_F(FarInputs, ALoadUnderWhichNothingIsSolvedIsSaidToBeOutsideToo) {
  for (const auto* kg : {"6e4", "2.9e5", "1e7", "1e12"}) {
    const Csv csv = one("correct", kg, "21");
    EXPECT_EQ(csv.columns.at("status")[1], "outside-domain") << kg;
    EXPECT_NE(said.find("W-PREDICT-OUTSIDE"), std::string::npos) << said;
    for (const auto* axis : {"x_mm", "y_mm", "z_mm"})
      EXPECT_NEAR(csv.numbers(std::string("c") + axis)[1], csv.numbers(axis)[1], 1e-9);
  }
}

TEST_F(FarInputs, NumbersThatAreLikelyInAnotherUnitAreSaidToBe) {
  for (const auto* verb : {"predict", "correct"})
    for (const auto& [kg, degC, name] :
         {std::tuple{"4000", "21", "payload_g"}, std::tuple{"4", "294", "temp_K"}}) {
      one(verb, kg, degC);
      EXPECT_NE(said.find("W-CSV-VALUE"), std::string::npos) << verb << said;
      EXPECT_NE(said.find(name), std::string::npos) << verb << said;
      one(verb, "4", "21");
      EXPECT_EQ(said.find("W-CSV-VALUE"), std::string::npos) << verb << said;
    }
}

TEST_F(FarInputs, TheModelShowsItsRanges) {
  const Ran ran = box->plumb({"inspect", "cell/robot.plumb"});
  EXPECT_EQ(ran.exit, 0);
  EXPECT_NE(ran.out.find("payload 0 .. 4 kg"), std::string::npos) << ran.out;
  EXPECT_NE(ran.out.find("temp "), std::string::npos) << ran.out;
}

/// The demo's targets with other numbers in them.
std::string targets_with(const Csv& csv, const std::map<std::string, std::string>& from,
                         const std::map<std::string, double>& factor) {
  std::ostringstream out;
  out.precision(12);
  for (std::size_t k = 0; k < csv.header.size(); ++k) out << (k == 0 ? "" : ",") << csv.header[k];
  for (std::size_t i = 0; i < csv.rows(); ++i) {
    out << '\n';
    for (std::size_t k = 0; k < csv.header.size(); ++k) {
      const std::string& name = csv.header[k];
      const auto other = from.find(name);
      const auto by = factor.find(name);
      const std::string& cell = csv.columns.at(other == from.end() ? name : other->second)[i];
      out << (k == 0 ? "" : ",");
      if (by == factor.end())
        out << cell;
      else
        out << std::stod(cell) * by->second;
    }
  }
  return out.str() + "\n";
}

struct MistakeCase {
  const char* name;
  std::map<std::string, std::string> from;
  std::map<std::string, double> factor;
  const char* words;
  const char* unit = "_mm";  // of the headings of the targets
};

class WrittenWrongly : public CorrectVerb, public testing::WithParamInterface<MistakeCase> {};

TEST_P(WrittenWrongly, NoTargetIsCorrectedAndTheMistakeIsNamed) {
  const auto& mistake = GetParam();
  std::string text = targets_with(box->csv("cell/targets.csv"), mistake.from, mistake.factor);
  for (const char* heading : {"x_mm", "y_mm", "z_mm"})
    text.replace(text.find(heading) + 1, 3, mistake.unit);
  box->write("wrong.csv", text);
  const Ran ran = box->plumb({"correct", "cell/robot.plumb", "--data", "wrong.csv", "-o",
                              "wrong_out.csv", "--force", "--json"});
  EXPECT_EQ(ran.exit, 4) << ran.err;
  const Json json = ran.json(), result = json.at("result");
  EXPECT_FALSE(json.at("ok"));
  EXPECT_EQ(json.at("error").at("code"), "E-CORRECT-NONE");
  EXPECT_EQ(result.at("rows"), 20);
  EXPECT_EQ(result.at("corrected"), 0);
  EXPECT_EQ(result.at("refused"), 20);
  int sum = 0;
  for (const auto& [status, count] : result.at("refused_by").items()) sum += count.get<int>();
  EXPECT_EQ(sum, 20);
  EXPECT_EQ(result.at("largest_mm"), 0.0);
  const std::string message = json.at("error").at("message");
  EXPECT_NE(message.find("Corrected 0 of 20 targets: "), std::string::npos) << message;
  EXPECT_NE(message.find(mistake.words), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(
    Targets, WrittenWrongly,
    testing::Values(
        MistakeCase{
            "metres", {}, {{"x_mm", 1e-3}, {"y_mm", 1e-3}, {"z_mm", 1e-3}}, "metres in x_mm?"},
        MistakeCase{
            "micrometres", {}, {{"x_mm", 1e3}, {"y_mm", 1e3}, {"z_mm", 1e3}}, "micrometres"},
        MistakeCase{"millimetres_in_metres", {}, {}, "millimetres in x_m?", "_m"},
        MistakeCase{"inches_in_metres",
                    {},
                    {{"x_mm", 1 / 25.4}, {"y_mm", 1 / 25.4}, {"z_mm", 1 / 25.4}},
                    "inches in x_m?",
                    "_m"},
        MistakeCase{"metres_in_micrometres",
                    {},
                    {{"x_mm", 1e-3}, {"y_mm", 1e-3}, {"z_mm", 1e-3}},
                    ": metres in x_um?",
                    "_um"},
        MistakeCase{"scalar_last",
                    {{"qw", "qx"}, {"qx", "qy"}, {"qy", "qz"}, {"qz", "qw"}},
                    {},
                    "is the order qw, qx, qy, qz?"},
        MistakeCase{"radians",
                    {},
                    {{"q1_deg", M_PI / 180},
                     {"q2_deg", M_PI / 180},
                     {"q3_deg", M_PI / 180},
                     {"q4_deg", M_PI / 180},
                     {"q5_deg", M_PI / 180},
                     {"q6_deg", M_PI / 180}},
                    "radians"}),
    [](const auto& mistake) { return mistake.param.name; });

TEST_F(CorrectVerb, TargetsInAnotherFrameAreToldFromTheirSeeds) {
  const Csv csv = box->csv("cell/targets.csv");
  std::ostringstream out;
  for (std::size_t k = 0; k < csv.header.size(); ++k) out << (k == 0 ? "" : ",") << csv.header[k];
  for (std::size_t i = 0; i < csv.rows(); ++i) {
    out << '\n';
    for (std::size_t k = 0; k < csv.header.size(); ++k) {
      const std::string& cell = csv.columns.at(csv.header[k])[i];
      out << (k == 0 ? "" : ",");
      if (csv.header[k] == "x_mm")
        out << std::stod(cell) + 700.0;
      else
        out << cell;
    }
  }
  box->write("frame.csv", out.str() + "\n");
  const Ran ran = box->plumb({"correct", "cell/robot.plumb", "--data", "frame.csv", "-o",
                              "frame_out.csv", "--force", "--json"});
  EXPECT_EQ(ran.exit, 4) << ran.err;
  const std::string message = ran.json().at("error").at("message");
  EXPECT_NE(message.find("another frame"), std::string::npos) << message;
  EXPECT_NE(message.find("about (7"), std::string::npos) << message;
}

TEST_F(CorrectVerb, SomeRefusedTargetsAreAWarningWithTheReasons) {
  const Csv csv = box->csv("cell/targets.csv");
  std::string text = targets_with(csv, {}, {});
  const auto last = text.rfind('\n', text.size() - 2) + 1;
  std::string row = text.substr(last);
  // The last target again, 900 mm away from its joint state.
  std::size_t begin = 0;
  for (std::size_t k = 0; csv.header[k] != "x_mm"; ++k) begin = row.find(',', begin) + 1;
  const double x = std::stod(row.substr(begin));
  row.replace(begin, row.find(',', begin) - begin, std::to_string(x > 0 ? x - 900 : x + 900));
  box->write("some.csv", text + row);
  const Ran ran = box->plumb(
      {"correct", "cell/robot.plumb", "--data", "some.csv", "-o", "some_out.csv", "--force"});
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_NE(ran.out.find("Corrected 20 of 21 targets: 1 "), std::string::npos) << ran.out;
  EXPECT_NE(ran.err.find("warning[W-CORRECT-REFUSED]: 1 of 21 targets were refused"),
            std::string::npos)
      << ran.err;
  // The help explains the status that stands in the column, not another one.
  const std::string status = box->csv("some_out.csv").columns.at("status").back();
  EXPECT_NE(ran.err.find("plumb explain " + status), std::string::npos) << status << ran.err;
}

TEST_F(CorrectVerb, AStartThatIsNoJointStateIsAUsageError) {
  box->write("bare.csv",
             box->csv("cell/targets.csv")
                 .without({"q1_deg", "q2_deg", "q3_deg", "q4_deg", "q5_deg", "q6_deg"}));
  for (const std::string start :
       {"nan", "nan,0,0,0,0,0", "1,2,abc", "inf,0,0,0,0,0", "1,2,3", ",", ""}) {
    const Ran ran = box->plumb(
        {"correct", "cell/robot.plumb", "--data", "bare.csv", "--start=" + start, "-o", "no.csv"});
    EXPECT_EQ(ran.exit, 2) << start << ran.err;
    // Of an empty "--start=" the option parser takes the next word of the line.
    EXPECT_TRUE(start.empty() || ran.err.find("--start h") != std::string::npos) << ran.err;
    EXPECT_FALSE(std::filesystem::exists(box->path() / "no.csv"));
  }
}

}  // namespace

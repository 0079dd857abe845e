// SPDX-License-Identifier: Apache-2.0
// plumb-twin as a person types it: help, JSON, exit codes, mistakes, and what is never overwritten.
#include <gtest/gtest.h>

#include "tests/cli/sandbox.hpp"

namespace {

using Words = std::vector<std::string>;

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A folder with a twin in it, if one is asked for. The sandbox runs plumb-twin here.
class TwinCommand : public testing::Test {
 protected:
  Ran twin(const Words& words) const { return box.plumb(words); }
  void make() { ASSERT_EQ(twin({"new", "cell"}).exit, 0); }
  Sandbox box;
};

TEST_F(TwinCommand, HelpBeginsWithTwoExamplesOfTheVerb) {
  for (const std::string verb : {"new", "measure", "run"}) {
    const Ran ran = twin({verb, "--help"});
    EXPECT_EQ(ran.exit, 0) << verb;
    EXPECT_EQ(ran.err, "") << verb;
    const std::string example = "  plumb-twin " + verb + " mytwin";
    EXPECT_EQ(ran.out.rfind("Examples:\n" + example, 0), 0U) << ran.out;
    EXPECT_TRUE(has(ran.out.substr(10 + example.size()), "\n" + example)) << ran.out;
    EXPECT_TRUE(has(ran.out, "--json")) << verb;
  }
}

TEST_F(TwinCommand, EveryVerbPrintsExactlyOneObjectWithJson) {
  for (const Words& words :
       std::vector<Words>{{"new", "cell"},
                          {"measure", "cell", "--poses", "5"},
                          {"run", "cell", "--correction", "off", "--stations", "3"},
                          {"run", "--list-faults"}}) {
    Words all = words;
    all.emplace_back("--json");
    const Ran ran = twin(all);
    ASSERT_EQ(ran.exit, 0) << words[0] << ran.err;
    const auto json = ran.json();
    EXPECT_EQ(json.at("schema"), "plumb-twin." + words[0] + "/1");
    EXPECT_EQ(json.at("command"), words[0]);
    EXPECT_EQ(json.at("ok"), true);
    EXPECT_TRUE(json.at("result").is_object());
    const auto& inputs = json.at("inputs");
    const bool reads = words[0] != "new" && words[1] == "cell";
    EXPECT_EQ(inputs.size(), reads ? 2U : 0U) << "cell.toml and twin.toml";
    for (const auto& input : inputs) EXPECT_EQ(input.at("sha256").get<std::string>().size(), 64U);
  }
}

TEST_F(TwinCommand, AnErrorIsAnObjectToo) {
  const Ran ran = twin({"measure", "nowhere", "--json"});
  EXPECT_EQ(ran.exit, 3);
  EXPECT_EQ(ran.json().at("ok"), false);
  EXPECT_EQ(ran.json().at("error").at("code"), "E-READ");
}

TEST_F(TwinCommand, EveryMistakeOfTheCommandLineIsExitTwoAndSaysWhatHelps) {
  make();
  const auto before = box.listing();
  for (const Words& words : std::vector<Words>{{},
                                               {"bogus"},
                                               {"new"},
                                               {"new", "other", "--robot", "six"},
                                               {"new", "other", "--hidden", "gear_rippel:J2"},
                                               {"new", "other", "--noise-um", "0"},
                                               {"measure"},
                                               {"measure", "cell", "--poses", "0"},
                                               {"run", "cell", "--stations", "1"},
                                               {"run", "cell", "--correction", "on"},
                                               {"run", "cell", "--correction", "maybe"},
                                               {"run", "cell", "--modbus-serve", "here"},
                                               {"run", "cell", "--modbus", "127.0.0.1:99999"},
                                               {"run", "cell", "--rtu", "line", "--role", "master"},
                                               {"run", "cell", "--fault", "stopp@1"},
                                               {"run", "cell", "--falut", "stop"}}) {
    const Ran ran = twin(words);
    const std::string what = words.empty() ? "no verb" : words.back();
    EXPECT_EQ(ran.exit, 2) << what << ran.err;
    EXPECT_EQ(ran.out, "") << what;
    EXPECT_TRUE(words.empty() || has(ran.err, "= help:")) << what << ran.err;
  }
  EXPECT_EQ(box.listing(), before);
}

TEST_F(TwinCommand, NearMissesAreNamed) {
  make();
  EXPECT_TRUE(has(twin({"run", "cell", "--fault", "stopp@1"}).err, "did you mean 'stop'"));
  EXPECT_TRUE(has(twin({"new", "x", "--hidden", "gear_rippel:J2"}).err, "'gear_ripple'"));
  EXPECT_TRUE(has(twin({"run", "cell", "--statoins", "3"}).err, "'--stations'"));
}

TEST_F(TwinCommand, NothingIsOverwrittenWithoutForce) {
  make();
  ASSERT_EQ(twin({"measure", "cell", "--poses", "5"}).exit, 0);
  const std::string cell = box.read("cell/cell.toml"), hidden = box.read("cell/twin.toml"),
                    data = box.read("cell/measurements.csv");
  for (const Words& words :
       std::vector<Words>{{"new", "cell", "--seed", "2"}, {"measure", "cell", "--poses", "6"}}) {
    const Ran ran = twin(words);
    EXPECT_EQ(ran.exit, 2) << words[0];
    EXPECT_TRUE(has(ran.err, "error[E-EXISTS]")) << ran.err;
  }
  EXPECT_EQ(box.read("cell/cell.toml"), cell);
  EXPECT_EQ(box.read("cell/twin.toml"), hidden);
  EXPECT_EQ(box.read("cell/measurements.csv"), data);
  EXPECT_EQ(twin({"new", "cell", "--seed", "2", "--force"}).exit, 0);
  EXPECT_EQ(twin({"measure", "cell", "--poses", "6", "--force"}).exit, 0);
  EXPECT_NE(box.read("cell/twin.toml"), hidden);
  EXPECT_NE(box.read("cell/measurements.csv"), data);
}

TEST_F(TwinCommand, ADryRunWritesNothingAndSaysWhatItWould) {
  const Ran made = twin({"new", "cell", "--dry-run"});
  EXPECT_EQ(made.exit, 0);
  EXPECT_TRUE(has(made.out, "would write")) << made.out;
  EXPECT_TRUE(box.listing().empty());
  make();
  const auto before = box.listing();
  EXPECT_EQ(twin({"measure", "cell", "--poses", "5", "--dry-run"}).exit, 0);
  EXPECT_EQ(box.listing(), before);
}

TEST_F(TwinCommand, WhatIsMissingOrWrongInAFileIsExitThree) {
  make();
  EXPECT_EQ(twin({"run", "nowhere"}).exit, 3);
  EXPECT_EQ(twin({"run", "cell", "--path", "nofile.csv"}).exit, 3);
  const Ran layout = twin({"run", "cell", "--modbus", "127.0.0.1:9", "--layout", "nofile",
                           "--correction", "on", "--stations", "2"});
  EXPECT_EQ(layout.exit, 3) << layout.err;
  box.write("cell/twin.toml", box.read("cell/twin.toml") + "\nsead = 1\n");
  const Ran ran = twin({"measure", "cell"});
  EXPECT_EQ(ran.exit, 3);
  EXPECT_TRUE(has(ran.err, "twin.toml:")) << ran.err;
}

/// A calibration that is measured again, changed, and of a sister: never over the first readings.
TEST_F(TwinCommand, PlannedPosesAreMeasuredUnderTheirNames) {
  make();
  ASSERT_EQ(twin({"measure", "cell", "--poses", "5"}).exit, 0);
  box.write("plan.csv",
            "pose,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,note\nP7,1,-60,3,4,5,6,\nP9,9,-30,3,4,"
            "5,6,\n");
  const Words words{"measure", "cell", "--poses", "plan.csv", "-o", "now.csv"};
  const Ran ran = twin(words);
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_TRUE(has(ran.out, "plumb -C cell recheck --data now.csv")) << ran.out;
  const std::string now = box.read("now.csv");
  EXPECT_TRUE(has(now, "\nP7,1,-60,3,4,5,6,")) << now;
  EXPECT_TRUE(has(now, "\nP9,9,-30,3,4,5,6,")) << now;
  for (const Words& more : std::vector<Words>{{"--change", "encoder:J2=120urad"}, {"--day", "2"}}) {
    Words all = words;
    all.back() = "other.csv";
    all.insert(all.end(), more.begin(), more.end());
    all.emplace_back("--force");
    ASSERT_EQ(twin(all).exit, 0);
    EXPECT_NE(box.read("other.csv"), now) << more[0];
  }
}

TEST_F(TwinCommand, LaterReadingsNeverReplaceThoseOfTheCalibration) {
  make();
  box.write("plan.csv", "pose,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\nP7,1,-60,3,4,5,6\n");
  for (const Words& more : std::vector<Words>{{"--poses", "plan.csv"},
                                              {"--change", "tool=0.2mm"},
                                              {"--sister", "2"},
                                              {"--poses", "plan.csv", "--repeats", "2", "-o", "x"},
                                              {"--poses", "plan.csv", "-o", "plan.csv"},
                                              {"--change", "tool=0.2", "-o", "x"}}) {
    Words all{"measure", "cell", "--force"};
    all.insert(all.end(), more.begin(), more.end());
    EXPECT_EQ(twin(all).exit, 2) << more[0] << more[1];
  }
  EXPECT_EQ(twin({"measure", "cell", "--poses", "noplan.csv", "-o", "x"}).exit, 3);
}

TEST_F(TwinCommand, ASisterGetsACellOfHerOwnOnce) {
  make();
  const Words words{"measure", "cell", "--sister", "2", "--poses", "5", "-o", "arm2/m.csv"};
  ASSERT_EQ(twin(words).exit, 0);
  const std::string cell = box.read("arm2/cell.toml");
  EXPECT_TRUE(has(cell, "TWIN-1-SISTER-2")) << cell;
  EXPECT_TRUE(has(cell, "m.csv")) << cell;
  box.write("arm2/cell.toml", cell + "# mine\n");
  Words again = words;
  again.emplace_back("--force");
  ASSERT_EQ(twin(again).exit, 0);
  EXPECT_EQ(box.read("arm2/cell.toml"), cell + "# mine\n");
}

TEST_F(TwinCommand, ABusThatIsNotThereIsExitFive) {
  make();
  const Ran ran = twin({"run", "cell", "--rtu", "no-such-device", "--stations", "2"});
  EXPECT_EQ(ran.exit, 5) << ran.err;
  EXPECT_TRUE(has(ran.err, "error[E-TWIN-BUS]")) << ran.err;
}

TEST_F(TwinCommand, SilenceOnTheBusIsExitSixAndTheReportSaysWhatTheBusDid) {
  make();
  const Ran ran = twin({"run", "cell", "--modbus", "127.0.0.1:9", "--correction", "on",
                        "--stations", "2", "--wait-s", "0.1", "--json"});
  EXPECT_EQ(ran.exit, 6) << ran.err;
  EXPECT_TRUE(has(ran.err, "error[E-TWIN-SILENT]")) << ran.err;
  const auto loop = ran.json().at("result").at("loop");
  EXPECT_EQ(loop.at("state"), "silent");
  EXPECT_TRUE(loop.at("status").is_null());
  EXPECT_TRUE(loop.at("first_active_s").is_null());
}

TEST_F(TwinCommand, TheGateIsExitOneWhenNothingWasCorrected) {
  make();
  EXPECT_EQ(twin({"run", "cell", "--stations", "3"}).exit, 0);
  const Ran ran = twin({"run", "cell", "--stations", "3", "--gate"});
  EXPECT_EQ(ran.exit, 1);
  EXPECT_TRUE(has(ran.err, "error[E-GATE]")) << ran.err;
}

TEST_F(TwinCommand, AnArmThatHidesWarmthGetsABusThatCarriesItsTemperatures) {
  ASSERT_EQ(twin({"new", "warm", "--hidden", "thermal_growth=300um"}).exit, 0);
  EXPECT_TRUE(has(box.read("warm/cell.toml"),
                  "\ntemperatures = [\"temp\", \"temp_room\", \"temp_elbow\"]"));
  EXPECT_TRUE(has(box.read("warm/twin.toml"), "\ntemperatures = [\"temp\""));
  make();
  EXPECT_FALSE(has(box.read("cell/cell.toml"), "temperatures"));
}

}  // namespace

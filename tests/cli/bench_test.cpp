// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <map>
#include <span>

#include "plumb/format/writer.hpp"
#include "sandbox.hpp"
#include "tests/draw/well_formed.hpp"
#include "tests/rt/cycle_model.hpp"

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;
using Words = std::vector<std::string>;

const std::string kGoldens = PLUMB_GOLDEN_MODELS;

class Bench : public testing::Test {
 protected:
  void SetUp() override {
    const auto bytes = plumb::format::write_model(plumb::tests::cycle_model());
    std::string text;
    for (const std::byte b : bytes) text += static_cast<char>(b);
    box.write("r.plumb", text);
  }

  Ran bench(Words words, const std::string& model = "r.plumb") const {
    words.insert(words.begin(), {"bench", model, "--calls", "200"});
    return box.plumb(words);
  }
  Json result(const Words& words = {}, const std::string& model = "r.plumb") const {
    Words all = words;
    all.emplace_back("--json");
    const Ran ran = bench(all, model);
    EXPECT_EQ(ran.exit, 0) << ran.err;
    return ran.json().at("result");
  }
  bool there(const char* file) const { return fs::exists(box.path() / file); }

  Sandbox box;
};

TEST_F(Bench, JsonHoldsWhatTheContractPromises) {
  const Ran ran = bench({"--json"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_EQ(ran.json().at("schema"), "plumb.bench/1");
  EXPECT_EQ(ran.json().at("inputs").at(0).at("file"), "r.plumb");
  const Json r = ran.json().at("result");
  EXPECT_GT(r.at("ns_median"), 0.0);
  EXPECT_GE(r.at("ns_p99"), r.at("ns_median"));
  EXPECT_GE(r.at("ns_max"), r.at("ns_p99"));
  EXPECT_EQ(r.at("calls"), 200);
  EXPECT_EQ(r.at("allocations"), 0);
  EXPECT_NEAR(r.at("share_of_cycle_pct").get<double>(),
              0.1 * r.at("ns_median").get<double>() / r.at("cycle_us").get<double>(), 1e-9);
}

TEST_F(Bench, AMachineThatMayNotJudgeSaysWhy) {
  const Json r = result();
  const Json conditions = r.at("conditions");
  ASSERT_TRUE(r.at("representative").is_boolean());
  EXPECT_EQ(r.at("representative") == true, conditions.at("why_not_representative").empty());
  for (const auto* key :
       {"kernel", "preempt_rt", "cpu", "governor", "isolated_cpus", "sibling_cpus",
        "virtual_machine", "load_average_1min", "build", "compiler"}) {
    ASSERT_TRUE(conditions.contains(key)) << key;
    EXPECT_EQ(conditions.at(key).is_null(), conditions.contains(std::string(key) + "_reason"))
        << key;
  }
  const std::string text = bench({}).out;
  const bool fit = r.at("representative");
  EXPECT_EQ(text.find("not fit to judge a controller by") == std::string::npos, fit) << text;
  EXPECT_EQ(text.find("no latency of a controller") == std::string::npos, fit) << text;
}

TEST_F(Bench, TheFirstLineGivesTheShareOfTheModelsOwnCycle) {
  const double cycle_us =
      box.plumb({"inspect", "r.plumb", "--json"}).json().at("result").at("guard").at("cycle_us");
  EXPECT_DOUBLE_EQ(result().at("cycle_us").get<double>(), cycle_us);
  const std::string text = bench({}).out, line = text.substr(0, text.find('\n'));
  EXPECT_EQ(line.rfind("whole step: ", 0), 0U) << line;
  EXPECT_NE(line.find(" % of the 4 ms cycle"), std::string::npos) << line;
  EXPECT_EQ(cycle_us, 4000.0);
}

TEST_F(Bench, EveryPartAndEveryEffectIsTimedOnceEachWay) {
  for (const std::string& model : {std::string("r.plumb"), kGoldens + "/planar.plumb",
                                   kGoldens + "/blended.plumb", kGoldens + "/formula.plumb"}) {
    const Json effects = box.plumb({"inspect", model, "--json"}).json().at("result").at("effects");
    std::map<std::string, int> ways;
    std::map<std::string, std::map<std::string, int>> seen;
    const Json r = result({}, model);
    for (const auto& kernel : r.at("kernels")) {
      ++ways[kernel.at("way")];
      ++seen[kernel.at("name")][kernel.at("way")];
      EXPECT_GT(kernel.at("calls"), 0);
      EXPECT_GE(kernel.at("ns_max"), kernel.at("ns_p99"));
      EXPECT_GE(kernel.at("ns_p99"), kernel.at("ns_median"));
    }
    EXPECT_EQ(ways.size(), 3U) << model;
    std::size_t counted = 0;
    for (const auto& [name, each] : seen) {
      EXPECT_EQ(each, (std::map<std::string, int>{{"cold", 1}, {"latency_chain", 1}, {"warm", 1}}))
          << model << " " << name;
      counted += name.rfind("effect:", 0) == 0 ? 1U : 0U;
    }
    EXPECT_EQ(counted, effects.size()) << model;
    for (const auto* part : {"cycle", "correct", "guard", "predict", "kinematics"})
      EXPECT_TRUE(seen.contains(part)) << model << " " << part;
    EXPECT_EQ(r.at("allocations"), 0) << model;
  }
}

TEST_F(Bench, TheSameSeedAsksForTheSamePoses) {
  const std::string arm = kGoldens + "/planar_2r.plumb";
  EXPECT_EQ(result({"--seed", "3"}, arm).at("refused_poses"),
            result({"--seed", "3"}, arm).at("refused_poses"));
}

TEST_F(Bench, TheGateIsExitOneAndWritesNothing) {
  EXPECT_EQ(bench({"--max-us", "1e9"}).exit, 0);
  const Ran ran = bench({"--max-us", "0.001", "-o", "latency.svg", "--json"});
  EXPECT_EQ(ran.exit, 1);
  EXPECT_EQ(ran.json().at("error").at("code"), "E-GATE-TIME");
  EXPECT_GT(ran.json().at("result").at("ns_median"), 1.0);
  EXPECT_FALSE(there("latency.svg"));
}

TEST_F(Bench, MistakesOfTheCommandLineAreExitTwo) {
  for (const auto& words : std::vector<Words>{{"bench"},
                                              {"bench", "r.plumb", "--calls", "0"},
                                              {"bench", "r.plumb", "--calls", "-5"},
                                              {"bench", "r.plumb", "--calls", "1000000000000"},
                                              {"bench", "r.plumb", "--calls", "1e30"},
                                              {"bench", "r.plumb", "--calls", "many"},
                                              {"bench", "r.plumb", "--seed", "x"},
                                              {"bench", "r.plumb", "--max-us", "0"},
                                              {"bench", "r.plumb", "--max-us", "-1"},
                                              {"bench", "r.plumb", "--force"},
                                              {"bench", "r.plumb", "--dry-run"},
                                              {"bench", "r.plumb", "r.plumb"}}) {
    const Ran ran = box.plumb(words);
    EXPECT_EQ(ran.exit, 2) << words.back() << ran.err;
    EXPECT_EQ(ran.out, "") << words.back();
    EXPECT_NE(ran.err.find("error[E-USAGE]"), std::string::npos) << ran.err;
  }
}

TEST_F(Bench, AGateThatIsNoNumberIsNeverPassed) { EXPECT_NE(bench({"--max-us", "nan"}).exit, 0); }

TEST_F(Bench, AModelThatCannotBeReadIsExitThree) {
  box.write("letter.plumb", "This is a letter, not a model of a robot arm, and long enough.");
  box.write("empty.plumb", "");
  box.write("short.plumb", box.read("r.plumb").substr(0, 300));
  fs::create_directory(box.path() / "folder");
  for (const auto* file :
       {"missing.plumb", "letter.plumb", "empty.plumb", "short.plumb", "folder"}) {
    const Ran ran = bench({"--json", "-o", "latency.svg"}, file);
    EXPECT_EQ(ran.exit, 3) << file;
    EXPECT_EQ(ran.json().at("error").at("code").get<std::string>().rfind("E-MODEL-", 0), 0U);
    EXPECT_FALSE(there("latency.svg"));
  }
}

TEST_F(Bench, TheFigureIsWellFormedSelfContainedAndMarksTheWorst) {
  const Json r = result({"-o", "latency.svg"});
  EXPECT_EQ(r.at("files"), Json({"latency.svg"}));
  const std::string svg = box.read("latency.svg");
  EXPECT_EQ(plumb::tests::xml_fault(svg), "");
  EXPECT_EQ(svg.rfind("<svg ", 0), 0U);
  for (const auto* part :
       {"The whole step takes ", "worst, in the caches", "worst, swept", "time a call, log scale",
        "number of calls, log scale", "of the 4 ms cycle"})
    EXPECT_NE(svg.find(part), std::string::npos) << part;
  for (const auto* outside : {"href", "url(", "<script", "<image", "@import", "nan", "inf"})
    EXPECT_EQ(svg.find(outside), std::string::npos) << outside;
  EXPECT_EQ(svg.find("Not representative") == std::string::npos, r.at("representative") == true);
}

TEST_F(Bench, TheFigureReplacesNothingWithoutForce) {
  box.write("latency.svg", "mine");
  const Ran ran = bench({"-o", "latency.svg"});
  EXPECT_EQ(ran.exit, 2);
  EXPECT_NE(ran.err.find("error[E-EXISTS]"), std::string::npos) << ran.err;
  EXPECT_EQ(box.read("latency.svg"), "mine");
  EXPECT_EQ(bench({"-o", "latency.svg", "--dry-run", "--force"}).exit, 0);
  EXPECT_EQ(box.read("latency.svg"), "mine");
  EXPECT_EQ(bench({"-o", "latency.svg", "--force"}).exit, 0);
  EXPECT_NE(box.read("latency.svg"), "mine");
}

TEST_F(Bench, DryRunWritesNothingAndSaysWhatItWould) {
  const auto before = box.listing();
  const Ran ran = bench({"-o", "new/latency.svg", "--dry-run"});
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_NE(ran.out.find("would write new/latency.svg"), std::string::npos) << ran.out;
  EXPECT_EQ(box.listing(), before);
}

TEST_F(Bench, AFolderThatCannotBeMadeIsExitFive) {
  EXPECT_EQ(bench({"-o", "r.plumb/latency.svg"}).exit, 5);
}

TEST_F(Bench, WhatTakesLongerThanASecondSaysSoAndCanBeStopped) {
  const Ran ran = box.plumb_interrupted(2500, {"bench", "r.plumb", "--calls", "10000000"});
  EXPECT_EQ(ran.exit, 130);
  EXPECT_EQ(ran.out, "");
  EXPECT_EQ(ran.err.rfind("timing the cycle of r.plumb ...", 0), 0U) << ran.err;
}

TEST_F(Bench, HelpBeginsWithTwoExamples) {
  const std::string help = box.plumb({"bench", "--help"}).out;
  EXPECT_EQ(help.rfind("Examples:\n  plumb bench robot.plumb\n  plumb bench robot.plumb --", 0), 0U)
      << help;
}

}  // namespace

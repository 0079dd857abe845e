// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sandbox.hpp"

namespace {

using Json = nlohmann::ordered_json;

class ModelVerbs : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    box = new Sandbox;
    ASSERT_EQ(box->plumb({"demo", "clean", "cell"}).exit, 0);
    const Ran ran = box->plumb({"-C", "cell", "compile", "--json"});
    ASSERT_EQ(ran.exit, 0) << ran.err;
    compiled = new Json(ran.json());
  }
  static void TearDownTestSuite() {
    delete box;
    delete compiled;
  }
  static Sandbox* box;
  static Json* compiled;
};
Sandbox* ModelVerbs::box = nullptr;
Json* ModelVerbs::compiled = nullptr;

TEST_F(ModelVerbs, CompileFitsFirstAndAudits) {
  EXPECT_EQ(compiled->at("warnings").at(0).at("code"), "N-RUN-NEW");
  const Json audit = compiled->at("result").at("audit");
  EXPECT_GT(audit.at("worst_correction_mm"), 0.0);
  EXPECT_GT(audit.at("sigma_tool_mean_mm"), 0.0);
  EXPECT_EQ(audit.at("bytes"), std::filesystem::file_size(box->path() / "cell/robot.plumb"));
}

TEST_F(ModelVerbs, CompileSaysWhichModelsTheErrorIsOf) {
  const Ran folds = box->plumb({"-C", "cell", "compile", "--dry-run", "--force"});
  EXPECT_NE(folds.out.find("The model was fitted on all"), std::string::npos) << folds.out;
  ASSERT_EQ(box->plumb({"demo", "clean", "fifth"}).exit, 0);
  std::string cell = box->read("fifth/cell.toml");
  const std::string rule = "held_out = \"auto\"";
  cell.replace(cell.find(rule), rule.size(), "held_out = \"20%\"");
  box->write("fifth/cell.toml", cell);
  const Ran fifth = box->plumb({"-C", "fifth", "compile", "--dry-run"});
  EXPECT_EQ(fifth.exit, 0) << fifth.err;
  EXPECT_EQ(fifth.out.find("The model was fitted on all"), std::string::npos) << fifth.out;
}

TEST_F(ModelVerbs, TheRunIsANumberAsInEveryOtherVerb) {
  EXPECT_EQ(compiled->at("result").at("run"), 1);
  EXPECT_EQ(compiled->at("result").at("refit_all"), false);
  const Json again =
      box->plumb({"-C", "cell", "compile", "--refit-all", "-o", "r.plumb", "--json"}).json();
  EXPECT_EQ(again.at("result").at("run"), 1);
  EXPECT_EQ(again.at("result").at("refit_all"), true);
  const Json deployed =
      box->plumb({"-C", "cell", "deploy", "-o", "deployed", "--dry-run", "--json"}).json();
  EXPECT_EQ(deployed.at("result").at("run"), 1);
  ASSERT_EQ(box->plumb({"demo", "clean", "fresh"}).exit, 0);
  for (const auto& words : std::vector<std::vector<std::string>>{
           {"-C", "fresh", "compile", "--dry-run", "--json"},
           {"-C", "fresh", "deploy", "-o", "x", "--dry-run", "--json"}}) {
    const Json result = box->plumb(words).json().at("result");
    EXPECT_TRUE(result.at("run").is_null()) << result.at("run");
    EXPECT_EQ(result.at("run_reason"), "--dry-run keeps nothing");
  }
}

TEST_F(ModelVerbs, AnEffectThatNoModelCanHoldIsRefusedWhenItIsAdded) {
  ASSERT_EQ(box->plumb({"demo", "clean", "big"}).exit, 0);
  const std::string before = box->read("big/cell.toml");
  const auto message = [](const Ran& ran) {
    return ran.json().at("error").at("message").get<std::string>();
  };
  const Ran added = box->plumb({"-C", "big", "add", "joint_table", "--joints", "J2,J3", "--json"});
  EXPECT_EQ(added.exit, 4) << added.err;
  EXPECT_EQ(message(added),
            "the model is not sound: effect 'joint_table' has too many parameters: 240, at most "
            "160");
  EXPECT_EQ(box->read("big/cell.toml"), before);
  std::string text = before;
  const std::string geometry = "geometry = true";
  text.insert(text.find(geometry) + geometry.size(),
              "\n[effects.joint_table]\njoints = [\"J2\", \"J3\"]");
  box->write("big/cell.toml", text);
  const Ran compiled_it = box->plumb({"-C", "big", "compile", "--json"});
  EXPECT_EQ(compiled_it.exit, 4) << compiled_it.err;
  EXPECT_EQ(message(compiled_it), message(added)) << "the same words";
}

TEST_F(ModelVerbs, InspectShowsWhatFitFound) {
  const Json fit = box->plumb({"-C", "cell", "fit", "--dry-run", "--json"}).json().at("result");
  const Ran ran = box->plumb({"inspect", "cell/robot.plumb", "--json"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const Json r = ran.json().at("result");
  EXPECT_EQ(r.at("sound"), true);
  EXPECT_EQ(r.at("serial"), "DEMO-CLEAN");
  EXPECT_NEAR(r.at("provenance").at("held_out").at("mean_mm").get<double>(),
              fit.at("held_out").at("mean_mm").get<double>(), 1e-9);
  EXPECT_EQ(r.at("provenance").at("run"), "0001");
  int compared = 0;
  for (const auto& p : fit.at("parameters")) {
    if (p.at("name") != "J2.a") continue;
    ++compared;
    EXPECT_NEAR(r.at("calibrated").at("joints")[1].at("a_mm").get<double>(),
                p.at("value").get<double>(), 1e-9);
    EXPECT_EQ(r.at("nominal").at("joints")[1].at("a_mm"), p.at("nominal"));
  }
  EXPECT_EQ(compared, 1);
}

/// One function words the cost: with AVX2 and without, and whether the times say anything.
TEST_F(ModelVerbs, EveryVerbSaysTheSameOfTheCostOfAStep) {
  const std::string counted = "instructions in the build for x86-64-v3 (AVX2), ";
  std::string sentence;
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"-C", "cell", "compile", "--dry-run", "--force"},
           {"-C", "cell", "deploy", "-o", "d", "--dry-run", "--allow-slow"},
           {"inspect", "cell/robot.plumb"},
           {"bench", "cell/robot.plumb", "--calls", "100"}}) {
    std::string said = box->plumb(words).out;
    std::replace(said.begin(), said.end(), '\n', ' ');
    const auto at = said.find(counted);
    ASSERT_NE(at, std::string::npos) << words[0] << said;
    const auto begin = said.rfind("A step of", at);
    const std::string now = said.substr(begin, said.find("x86-64. ", at) - begin);
    EXPECT_TRUE(sentence.empty() || now == sentence) << now << "\n" << sentence;
    sentence = now;
    EXPECT_NE(said.find("epresentative: "), std::string::npos) << said;
  }
  const Json cost = compiled->at("result").at("cost");
  const Json inspected =
      box->plumb({"inspect", "cell/robot.plumb", "--json"}).json().at("result").at("cost");
  EXPECT_EQ(inspected.at("instructions"), cost.at("instructions"));
  EXPECT_EQ(inspected.at("instructions_baseline"), cost.at("instructions_baseline"));
  EXPECT_GT(cost.at("instructions_baseline"), cost.at("instructions"));
  EXPECT_EQ(cost.at("representative") == true, cost.at("why_not_representative").empty());
}

TEST_F(ModelVerbs, RefitAllCarriesNoHeldOutFigureAndSaysSo) {
  const Ran ran = box->plumb({"-C", "cell", "compile", "--refit-all", "-o", "all.plumb", "--json"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_NE(ran.err.find("W-AUDIT-HELD"), std::string::npos);
  EXPECT_EQ(box->plumb({"-C", "cell", "runs", "--json"}).json().at("result").at("runs").size(), 1U);
  const Json r = box->plumb({"inspect", "all.plumb", "--json"}).json().at("result");
  EXPECT_TRUE(r.at("provenance").at("held_out").at("mean_mm").is_null());
  const Ran gated = box->plumb({"-C", "cell", "compile", "--refit-all", "--gate", "-o", "g.plumb"});
  EXPECT_EQ(gated.exit, 1);
  EXPECT_FALSE(std::filesystem::exists(box->path() / "g.plumb"));
}

TEST_F(ModelVerbs, DamagedFilesAreExitThreeWithTheirOwnCode) {
  const std::string good = box->read("cell/robot.plumb");
  std::string flipped = good;
  flipped[good.size() / 2] = static_cast<char>(flipped[good.size() / 2] ^ 1);
  box->write("flipped.plumb", flipped);
  box->write("short.plumb", good.substr(0, good.size() / 2));
  box->write("other.plumb", "This is a letter, not a model of a robot arm, and long enough.");
  for (const auto* file :
       {"flipped.plumb", "short.plumb", "other.plumb", "missing.plumb", "cell"}) {
    const Ran ran = box->plumb({"inspect", file, "--json"});
    EXPECT_EQ(ran.exit, 3) << file;
    const Json error = ran.json().at("error");
    EXPECT_EQ(error.at("code").get<std::string>().rfind("E-MODEL-", 0), 0U) << error.dump();
    EXPECT_EQ(error.at("place").at("file"), file);
    EXPECT_EQ(box->plumb({"explain", error.at("code")}).exit, 0);
    EXPECT_EQ(box->plumb({"correct", file, "--data", "cell/targets.csv", "-o", "no.csv"}).exit, 3);
  }
}

}  // namespace

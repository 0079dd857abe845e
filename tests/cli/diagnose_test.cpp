// SPDX-License-Identifier: Apache-2.0
// diagnose, add and drop as a person and as a program see them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "sandbox.hpp"

namespace {

using Json = nlohmann::ordered_json;

class DiagnoseVerb : public testing::Test {
 protected:
  DiagnoseVerb() { EXPECT_EQ(box.plumb({"demo", "compliance", "cell"}).exit, 0); }

  Ran plumb(std::vector<std::string> words) const {
    words.insert(words.begin(), {"-C", "cell"});
    return box.plumb(words);
  }
  /// The verb refuses, says so, and the cell file stays as it is.
  void refused(const std::vector<std::string>& words, int exit, const std::string& says) const {
    const std::string before = cell();
    const Ran ran = plumb(words);
    EXPECT_EQ(ran.exit, exit) << ran.err;
    EXPECT_NE(ran.err.find(says), std::string::npos) << ran.err;
    EXPECT_EQ(cell(), before);
  }
  std::string cell() const { return box.read("cell/cell.toml"); }
  bool has(const std::string& text) const { return cell().find(text) != std::string::npos; }

  Sandbox box;
};

/// No NaN, no infinity; a null has its reason beside it.
void expect_sound(const Json& json, const std::string& where) {
  if (json.is_number_float()) {
    EXPECT_TRUE(std::isfinite(json.get<double>())) << where;
  }
  if (json.is_structured())
    for (const auto& [key, value] : json.items()) expect_sound(value, where + "/" + key);
}

TEST_F(DiagnoseVerb, GivesTheObjectOfTheContract) {
  const Ran ran = plumb({"diagnose", "--json"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const Json result = ran.json().at("result");
  expect_sound(result, "result");
  EXPECT_EQ(result.at("verdict"), "missing");
  EXPECT_TRUE(result.at("added").empty());
  for (const char* key : {"noise_floor_mm", "held_out_before_mm", "noise_floor_rms_mm",
                          "held_out_before_rms_mm", "verdict_text", "not_testable", "unknown"})
    EXPECT_TRUE(result.contains(key)) << key;
  const Json& candidates = result.at("candidates");
  ASSERT_FALSE(candidates.empty());
  double before = INFINITY;
  for (const auto& c : candidates) {
    for (const char* key :
         {"effect", "joints", "ln_bayes", "held_out_alone_mm", "held_out_after_mm", "gain_pct",
          "gain_se_pct", "cycles_per_turn", "domain", "supported", "plausible", "parameters",
          "confounded_with", "held_out_alone_rms_mm", "held_out_after_rms_mm"})
      EXPECT_TRUE(c.contains(key)) << key;
    EXPECT_LE(c.at("ln_bayes").get<double>(), before) << "not ranked";
    before = c.at("ln_bayes");
  }
  for (const auto& t : result.at("not_testable")) {
    EXPECT_FALSE(t.at("effect").get<std::string>().empty());
    EXPECT_FALSE(t.at("why").get<std::string>().empty());
  }
}

TEST_F(DiagnoseVerb, SaysWhatIsLeftAndThatMoreCandidatesExist) {
  const Json result = plumb({"diagnose", "--json"}).json().at("result");
  EXPECT_GT(result.at("left_over").at("times_floor").get<double>(), 2.0);
  EXPECT_EQ(result.at("left_over").at("lack_of_fit"), true);
  EXPECT_TRUE(result.at("unlikely").empty());
  const auto listed = result.at("candidates").size();
  ASSERT_GT(listed, 8U);
  const std::string more = "and " + std::to_string(listed - 8) + " more: plumb diagnose --all";
  EXPECT_NE(plumb({"diagnose"}).out.find(more), std::string::npos);
}

TEST_F(DiagnoseVerb, WhatItProposesCanBeTyped) {
  const Ran ran = plumb({"diagnose"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const std::string begin = "plumb -C cell ";
  const auto at = ran.out.find(begin + "add ");
  ASSERT_NE(at, std::string::npos) << ran.out;
  std::vector<std::string> words;
  const auto from = at + begin.size();
  const auto end = std::min(ran.out.find('\n', at), ran.out.find("   #", at));
  std::istringstream in(ran.out.substr(from, end - from));
  for (std::string word; in >> word;) words.push_back(word);
  words.push_back("--dry-run");
  const Ran typed = plumb(words);
  EXPECT_EQ(typed.exit, 0) << typed.err;
  EXPECT_NE(ran.out.find("Certain."), std::string::npos) << ran.out;
  EXPECT_EQ(ran.out.find("plan --separate"), std::string::npos) << "nothing is left to tell apart";
}

TEST_F(DiagnoseVerb, ApplyAddsRefitsAndKeepsARun) {
  const std::string before = cell();
  const Ran dry = plumb({"diagnose", "--apply", "--dry-run", "--json"});
  ASSERT_EQ(dry.exit, 0) << dry.err;
  EXPECT_EQ(cell(), before);
  EXPECT_FALSE(std::filesystem::exists(box.path() / "cell/runs"));
  const Ran ran = plumb({"diagnose", "--apply", "--json"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const Json result = ran.json().at("result");
  EXPECT_EQ(result.at("added"), dry.json().at("result").at("added"));
  ASSERT_FALSE(result.at("added").empty());
  EXPECT_EQ(result.at("verdict_after"), "complete");
  EXPECT_LT(result.at("held_out_after_mm").get<double>(),
            0.3 * result.at("held_out_before_mm").get<double>());
  for (const auto& step : result.at("added"))
    EXPECT_TRUE(has("effects." + step.at("effect").get<std::string>())) << cell();
  // Everything of the file that is not an effect is still there.
  EXPECT_TRUE(cell().starts_with(before.substr(0, before.find("[effects]")))) << cell();
  const Ran again = plumb({"diagnose", "--json"});
  EXPECT_EQ(again.json().at("result").at("verdict"), "complete") << again.out;
  // The joint refit, not the step on the way, is what the last line promises.
  EXPECT_NEAR(again.json().at("result").at("held_out_before_mm").get<double>(),
              result.at("held_out_after_mm").get<double>(), 1e-6);
  EXPECT_EQ(plumb({"compile"}).exit, 0);
}

TEST_F(DiagnoseVerb, EveryScreenTakesOverTheScatterOfTheJointsBesideTheMeasuredFloor) {
  ASSERT_EQ(plumb({"simulate", "--force", "--poses", "120", "--repeats", "3",
                   "--joint-scatter-urad", "30"})
                .exit,
            0);
  const auto result = [&](const char* verb) { return plumb({verb, "--json"}).json().at("result"); };
  const Json first = result("fit");
  const std::string hedged = first.at("verdict");
  EXPECT_NE(hedged.find("the joints do not come back to the same place"), std::string::npos)
      << hedged;
  const Json found = result("diagnose");
  ASSERT_TRUE(found.contains("repeatability")) << found.dump(1);
  const double floor = found.at("noise_floor_mm"), inferred = found.at("inferred_floor_mm");
  EXPECT_NEAR(floor, first.at("noise_floor_mm").get<double>(), 1e-9);
  EXPECT_GT(inferred, 2.0 * floor);
  for (const char* verb : {"compare", "fit"}) {
    const Json later = result(verb);
    EXPECT_NEAR(later.at("noise_floor_mm").get<double>(), floor, 1e-9) << verb;
    EXPECT_NEAR(later.at("inferred_floor_mm").get<double>(), inferred, 1e-9) << verb;
    const std::string verdict = later.at("verdict");
    EXPECT_EQ(verdict.find("missing"), std::string::npos) << verb << ": " << verdict;
  }
  const std::string lack = result("compare").at("lack_of_fit").at("text");
  EXPECT_EQ(lack.find("a better model"), std::string::npos) << lack;
  // Every screen says the same sentence of one run; an effect more does not forget the scatter.
  EXPECT_EQ(result("report").at("verdict"), result("compare").at("verdict"));
  const Ran added = plumb({"add", "encoder_eccentricity", "--joints", "J3", "--json"});
  ASSERT_EQ(added.exit, 0) << added.err;
  const Json more = added.json().at("result");
  const std::string verdict = more.at("verdict");
  EXPECT_EQ(verdict.find("missing"), std::string::npos) << verdict;
  EXPECT_EQ(result("compare").at("verdict"), more.at("verdict"));
}

TEST_F(DiagnoseVerb, AddMakesTheErrorFallAndDropTakesItBack) {
  const std::string before = cell();
  const Ran dry = plumb({"add", "gravity_free", "--joints", "J2,J3", "--dry-run", "--json"});
  ASSERT_EQ(dry.exit, 0) << dry.err;
  EXPECT_EQ(cell(), before);
  const Ran added = plumb({"add", "gravity_free", "--joints", "J2,J3", "--json"});
  ASSERT_EQ(added.exit, 0) << added.err;
  const Json result = added.json().at("result");
  EXPECT_EQ(result.at("after"), dry.json().at("result").at("after"));
  EXPECT_LT(result.at("after").at("mean_mm").get<double>(),
            0.3 * result.at("before").at("mean_mm").get<double>());
  EXPECT_EQ(result.at("run"), 2);
  EXPECT_TRUE(has("[effects.gravity_free]\njoints = [\"J2\", \"J3\"]")) << cell();
  refused({"add", "gravity_free", "--joints", "J3"}, 3, "E-ADD-TWICE");
  const Ran less = plumb({"drop", "gravity_free", "--joints", "J3"});
  EXPECT_EQ(less.exit, 0) << less.err;
  EXPECT_NE(less.out.find("plumb -C cell add gravity_free --joints J3"), std::string::npos)
      << less.out;
  EXPECT_TRUE(has("joints = [\"J2\"]")) << cell();
  const Ran gone = plumb({"drop", "gravity_free", "--json"});
  ASSERT_EQ(gone.exit, 0) << gone.err;
  EXPECT_NEAR(gone.json().at("result").at("after").at("mean_mm").get<double>(),
              result.at("before").at("mean_mm").get<double>(), 1e-9);
  EXPECT_FALSE(has("[effects.gravity_free]"));
}

TEST_F(DiagnoseVerb, AFormulaOfTheUsersOwnIsAddedFittedAndDropped) {
  const Ran added = plumb({"add", "formula", "--formula", "dq2 = k * tau2", "--parameter",
                           "k [rad/(N m)] ~ 1e-7", "--name", "weight", "--json"});
  ASSERT_EQ(added.exit, 0) << added.err;
  const Json result = added.json().at("result");
  EXPECT_LT(result.at("after").at("mean_mm").get<double>(),
            result.at("before").at("mean_mm").get<double>());
  EXPECT_TRUE(has("expression = \"k * tau2\"")) << cell();
  refused({"add", "formula", "--formula", "dq3 = k * q3", "--parameter", "k [1] ~ 1e-4", "--name",
           "weight"},
          2, "--name weight");
  refused({"drop", "formula", "--name", "wight"}, 3, "E-DROP-NONE");
  const Ran gone = plumb({"drop", "formula", "--name", "weight"});
  EXPECT_EQ(gone.exit, 0) << gone.err;
  EXPECT_NE(gone.out.find("--formula 'dq2 = k * tau2' --parameter 'k [rad/(N m)] ~ 1e-7'"),
            std::string::npos)
      << gone.out;
  EXPECT_FALSE(has("formula"));
}

TEST_F(DiagnoseVerb, RefusesWhatMakesNoSenseAndChangesNothing) {
  refused({"add", "joint_complianc"}, 2, "did you mean 'joint_compliance'?");
  refused({"add", "joint_compliance", "--joints", "J22"}, 2, "did you mean 'J2'?");
  refused({"add", "gear_ripple", "--joints", "J2"}, 2, "--set cycles_per_turn=20");
  refused({"add", "step"}, 2, "--set after_row=84");
  refused({"drop", "step"}, 3, "E-DROP-NONE");
  refused({"add", "reversal", "--set", "transition"}, 2, "KEY=VALUE");
  refused({"add", "reversal", "--set", "no_such=1"}, 2, "no_such");
  refused({"add", "gear_ripple", "--set", "cycle_per_turn=1"}, 2, "mean 'cycles_per_turn'?");
  for (const char* value : {"abc", "", "[1,2]", "1,,2", "0", "-3", "nan", "inf", "1,two"})
    for (const char* verb : {"add", "drop"})
      refused({verb, "gear_ripple", "--set", std::string("cycles_per_turn=") + value}, 2,
              "E-EFFECT-OPTION");
  refused({"add", "gear_ripple", "--set", "cycles_per_turn=7,7"}, 2, "given twice");
  refused({"add", "joint_compliance_soft", "--set", "torque_Nm=0"}, 2, "greater than 0");
  refused({"add", "drift", "--set", "settling_s=-1"}, 2, "greater than 0");
  refused({"add", "gravity_compensator", "--set", "anchor_ratio=1e9"}, 2, "at most 10");
  refused({"add", "step", "--set", "after_row=84", "--set", "of=tol"}, 2, "\"base\"");
  refused({"add", "step", "--set", "after_row=99999"}, 2, "the last of the measurements is row");
  refused({"add", "tracker", "--joints", "J2"}, 2, "takes no joints");
  refused({"add", "cross_compliance"}, 2, "needs two joints");
  refused({"add", "geometry"}, 3, "E-ADD-TWICE");
  refused({"add", "formula"}, 2, "needs a law");
  refused({"add", "reversal", "--formula", "dq2 = 1"}, 2, "belong to 'formula'");
  refused({"add", "formula", "--formula", "k * tau2"}, 2, "TARGET = EXPRESSION");
  refused({"add", "formula", "--formula", "dq2 = k * tau2", "--parameter", "k [mm] ~ 1"}, 2,
          "E-FORMULA-UNIT");
  refused({"add", "formula", "--formula", "dq2 = tau9"}, 2, "E-FORMULA-VARIABLE");
  refused({"add", "formula", "--formula", "dq2 = q2 / 0"}, 2, "E-FORMULA-NUMBER");
  refused({"drop", "geometry"}, 3, "E-DROP-NONE");
  refused({"drop", "joint_compliance"}, 3, "E-DROP-NONE");
  refused({"drop", "joint_compliance", "--joints", "J2"}, 3, "it contains geometry alone");
}

TEST_F(DiagnoseVerb, AnErrorOfTheCommandLinePointsThereAndNotIntoTheCellFile) {
  for (const auto& [words, option] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"gear_ripple", "--set", "cycles_per_turn=abc"}, "--set cycles_per_turn=abc"},
           {{"formula", "--formula", "dq2 = tau9"}, "--formula 'dq2 = tau9'"},
           {{"formula", "--formula", "dq2 = k", "--parameter", "k [1 ~ 1"},
            "--parameter 'k [1 ~ 1'"},
           {{"step", "--set", "after_row=99999"}, "--set after_row=99999"}}) {
    std::vector<std::string> all{"add"};
    all.insert(all.end(), words.begin(), words.end());
    refused(all, 2, "--> " + option + "\n");
  }
}

TEST_F(DiagnoseVerb, AnErrorInAFormulaOfTheCommandLineHasItsColumnThere) {
  for (const auto& [law, column] : std::vector<std::pair<std::string, int>>{
           {"dq2 = k * tau9", 11}, {"  dq2=k*tau9", 9}, {"dq9 = k * tau2", 1}}) {
    const Ran wrong = plumb(
        {"add", "formula", "--formula", law, "--parameter", "k [1] ~ 1", "--dry-run", "--json"});
    EXPECT_NE(wrong.out.find(fmt::format("\"column\": {}", column)), std::string::npos)
        << law << wrong.out;
  }
}

TEST_F(DiagnoseVerb, SeveralCyclesAreSeveralEffectsInOneGoAndOutAgain) {
  const std::string before = cell();
  const std::string waves = "cycles_per_turn=7.91,17.49";
  const Ran added = plumb({"add", "gear_ripple", "--joints", "J2", "--set", waves});
  ASSERT_EQ(added.exit, 0) << added.err;
  EXPECT_TRUE(
      has("[[effects.gear_ripple]]\njoints = [\"J2\"]\ncycles_per_turn = 7.91\n"
          "[[effects.gear_ripple]]\njoints = [\"J2\"]\ncycles_per_turn = 17.49\n"))
      << cell();
  EXPECT_NE(added.out.find("Added gear ripple, 7.91 and 17.49 cycles a turn (gear_ripple:J2)"),
            std::string::npos)
      << added.out;
  EXPECT_NE(added.out.find("plumb -C cell drop gear_ripple --joints J2 --set " + waves),
            std::string::npos)
      << added.out;
  refused({"add", "gear_ripple", "--joints", "J2", "--set", "cycles_per_turn=3,17.49"}, 3,
          "already has gear ripple, 17.49");
  refused({"drop", "gear_ripple", "--joints", "J2", "--set", "cycles_per_turn=7.91,3"}, 3,
          "no gear ripple, 3");
  const Ran gone = plumb({"drop", "gear_ripple", "--joints", "J2", "--set", waves});
  ASSERT_EQ(gone.exit, 0) << gone.err;
  EXPECT_NE(gone.out.find("plumb -C cell add gear_ripple --joints J2 --set " + waves),
            std::string::npos)
      << gone.out;
  EXPECT_EQ(cell(), before);
}

/// What is proposed delivers what the sentence promises: all the waves, not the first.
TEST_F(DiagnoseVerb, ProposesAllWavesOfARipple) {
  ASSERT_EQ(plumb({"simulate", "--poses", "200", "--effect", "gear_ripple:J2=150urad@cycles=8",
                   "--effect", "gear_ripple:J2=150urad@cycles=17.5", "--force"})
                .exit,
            0);
  const Ran json = plumb({"diagnose", "--json"});
  const Json best = json.json().at("result").at("candidates").at(0);
  ASSERT_EQ(best.at("effect"), "gear_ripple") << json.out;
  ASSERT_GE(best.at("cycles_per_turn").size(), 2U) << json.out;
  const Ran ran = plumb({"diagnose"});
  const std::string begin = "plumb -C cell ";
  const auto at = ran.out.find(begin + "add ");
  ASSERT_NE(at, std::string::npos) << ran.out;
  std::vector<std::string> words;
  const auto from = at + begin.size();
  std::istringstream in(ran.out.substr(from, ran.out.find('\n', at) - from));
  for (std::string word; in >> word;) words.push_back(word);
  words.push_back("--json");
  const Ran typed = plumb(words);
  ASSERT_EQ(typed.exit, 0) << typed.err;
  EXPECT_NEAR(typed.json().at("result").at("after").at("mean_mm").get<double>(),
              best.at("held_out_alone_mm").get<double>(), 2e-3);
}

TEST_F(DiagnoseVerb, OfACellWhoseEffectIsUnknownSaysSo) {
  box.write("cell/cell.toml", cell() + "\n[effects.joint_complience]\n");
  refused({"diagnose"}, 3, "did you mean 'joint_compliance'?");
}

}  // namespace

// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "sandbox.hpp"

namespace {

using Json = nlohmann::ordered_json;

void expect_keys(const Json& object, const std::vector<std::string>& keys) {
  for (const auto& key : keys) EXPECT_TRUE(object.contains(key)) << key;
}

/// Null always comes with its reason, and there is no NaN.
void expect_reasons(const Json& json, const std::string& at) {
  if (json.is_number_float()) {
    EXPECT_TRUE(std::isfinite(json.get<double>())) << at;
  }
  if (json.is_array())
    for (std::size_t i = 0; i < json.size(); ++i)
      expect_reasons(json[i], at + "[" + std::to_string(i) + "]");
  if (!json.is_object()) return;
  for (const auto& [key, value] : json.items()) {
    if (value.is_null()) {
      EXPECT_TRUE(json.contains(key + "_reason")) << at << "." << key;
    }
    expect_reasons(value, at + "." + key);
  }
}

class FitVerb : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    box = new Sandbox;
    ASSERT_EQ(box->plumb({"demo", "clean", "cell"}).exit, 0);
  }
  static void TearDownTestSuite() { delete box; }
  static Sandbox* box;
};
Sandbox* FitVerb::box = nullptr;

TEST_F(FitVerb, TheEnvelopeIsOneObjectWithEveryKey) {
  const Ran ran = box->plumb({"-C", "cell", "fit", "--dry-run", "--json"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const Json json = ran.json();
  expect_keys(json,
              {"schema", "ok", "command", "version", "inputs", "warnings", "result", "error"});
  EXPECT_EQ(json.at("schema"), "plumb.fit/1");
  EXPECT_EQ(json.at("ok"), true);
  EXPECT_EQ(json.at("command"), "fit");
  EXPECT_TRUE(json.at("error").is_null());
  ASSERT_EQ(json.at("inputs").size(), 2U);
  for (const auto& input : json.at("inputs"))
    EXPECT_EQ(input.at("sha256").get<std::string>().size(), 64U);
}

TEST_F(FitVerb, TheResultHasTheKeysThatChecksRelyOn) {
  const Json result = box->plumb({"-C", "cell", "fit", "--dry-run", "--json"}).json().at("result");
  expect_keys(result,
              {"poses_fit", "poses_held_out", "parameters", "identifiable_rank", "calibrability",
               "held_out", "fit", "noise_floor_mm", "noise_floor_rms_mm", "effects", "frame",
               "target_mm", "run", "nominal", "tree", "verdict", "held_parameters", "convergence"});
  for (const auto* set : {"held_out", "fit", "nominal"})
    expect_keys(result.at(set), {"mean_mm", "rms_mm", "p95_mm", "max_mm"});
  ASSERT_FALSE(result.at("parameters").empty());
  for (const auto& p : result.at("parameters"))
    expect_keys(p, {"name", "value", "unit", "std", "nominal", "change"});
  expect_keys(result.at("frame"), {"xyz_mm", "quat_wxyz", "fitted"});
  expect_keys(result.at("convergence"), {"iterations"});
  EXPECT_EQ(result.at("target_mm").size(), 3U);
  expect_reasons(result, "result");
}

TEST_F(FitVerb, ParametersAreInMillimetresAndDegrees) {
  const Json result = box->plumb({"-C", "cell", "fit", "--dry-run", "--json"}).json().at("result");
  int lengths = 0;
  for (const auto& p : result.at("parameters")) {
    const std::string name = p.at("name"), unit = p.at("unit");
    EXPECT_TRUE(unit == "mm" || unit == "deg") << name;
    EXPECT_NEAR(p.at("value").get<double>() - p.at("nominal").get<double>(),
                p.at("change").get<double>(), 1e-9);
    if (name != "J2.a") continue;
    ++lengths;
    EXPECT_EQ(unit, "mm");
    EXPECT_EQ(p.at("nominal"), 455.0);
  }
  EXPECT_EQ(lengths, 1);
}

TEST_F(FitVerb, FindsTheTrueParametersOfTheDemoWithinItsOwnSigma) {
  const Json result = box->plumb({"-C", "cell", "fit", "--dry-run", "--json"}).json().at("result");
  const Json truth = Json::parse(box->read("cell/truth.json"));
  int compared = 0;
  for (const auto& p : result.at("parameters"))
    for (const auto& t : truth.at("parameters")) {
      if (t.at("name") != p.at("name") || p.at("name").get<std::string>().ends_with("a") == false)
        continue;
      ++compared;
      const double sigma = p.at("std").get<double>();
      EXPECT_NEAR(p.at("value").get<double>(), t.at("value").get<double>(), 5.0 * sigma + 1e-3)
          << p.at("name");
    }
  EXPECT_GE(compared, 2);
}

TEST_F(FitVerb, DryRunKeepsNothing) {
  ASSERT_EQ(box->plumb({"-C", "cell", "fit", "--dry-run"}).exit, 0);
  EXPECT_FALSE(std::filesystem::exists(box->path() / "cell" / "runs"));
}

TEST_F(FitVerb, TheGateFailsWithExitOneAndStillShowsTheResult) {
  const Ran ran = box->plumb({"-C", "cell", "fit", "--max-rms", "0.000001", "--json"});
  EXPECT_EQ(ran.exit, 1);
  EXPECT_EQ(ran.json().at("ok"), false);
  EXPECT_EQ(ran.json().at("error").at("code"), "E-GATE-RMS");
  EXPECT_GT(ran.json().at("result").at("held_out").at("rms_mm"), 0.0);
  EXPECT_FALSE(std::filesystem::exists(box->path() / "cell" / "runs"));
  EXPECT_EQ(box->plumb({"-C", "cell", "fit", "--max-rms", "10", "--dry-run"}).exit, 0);
}

TEST_F(FitVerb, NoHeadlineCountsSingleBadReadings) {
  ASSERT_EQ(box->plumb({"demo", "clean", "bad"}).exit, 0);
  ASSERT_EQ(box->plumb({"-C", "bad", "simulate", "--poses", "100", "--repeats", "2", "--outliers",
                        "3%", "--seed", "5", "-o", "bad/measurements.csv", "--force"})
                .exit,
            0);
  const Ran fitted = box->plumb({"-C", "bad", "fit", "--max-rms", "0.1", "--json"});
  ASSERT_EQ(fitted.exit, 0) << fitted.err;
  const Json result = fitted.json().at("result");
  EXPECT_GT(result.at("held_out").at("rms_mm"), 0.1);
  EXPECT_LT(result.at("verdict_error").at("rms_mm"), 0.05);
  const Ran missed = box->plumb({"-C", "bad", "fit", "--max-rms", "0.001", "--dry-run"});
  EXPECT_NE(missed.err.find("that stand out) exceeds"), std::string::npos) << missed.err;
  const Ran compiled = box->plumb({"-C", "bad", "compile", "--dry-run", "--json"});
  EXPECT_EQ(compiled.err.find("W-COMPILE-TOLERANCE"), std::string::npos) << compiled.err;
  EXPECT_EQ(compiled.json().at("result").at("verdict_error"), result.at("verdict_error"));
  const Json run = box->plumb({"-C", "bad", "runs", "--json"}).json().at("result").at("runs").at(0);
  EXPECT_EQ(run.at("verdict_error"), result.at("verdict_error"));
  const Ran runs = box->plumb({"-C", "bad", "runs"});
  EXPECT_NE(runs.out.find("that stand"), std::string::npos) << runs.out;
}

TEST_F(FitVerb, AnotherSeedOrRuleChangesTheSplitOnly) {
  const auto held = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"-C", "cell", "fit", "--dry-run", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    const Ran ran = box->plumb(words);
    EXPECT_EQ(ran.exit, 0) << ran.err;
    return ran.json().at("result");
  };
  const Json one = held({"--seed", "1"}), two = held({"--seed", "2"}), again = held({});
  EXPECT_NE(one.at("held_out").at("mean_mm"), two.at("held_out").at("mean_mm"));
  EXPECT_EQ(one.at("held_out").at("mean_mm"), again.at("held_out").at("mean_mm"));
  EXPECT_EQ(one.at("folds"), 5);
  EXPECT_EQ(one.at("poses_held_out"), one.at("poses_fit"));
  EXPECT_GT(one.at("held_out").at("mean_se_mm").get<double>(), 0.0);
  const Json folds = held({"--held-out", "kfold:4"});
  EXPECT_EQ(folds.at("folds"), 4);
  EXPECT_EQ(folds.at("poses_held_out"), folds.at("poses_fit"));
  for (const char* no_rule : {"some", "", " "})
    EXPECT_EQ(box->plumb({"-C", "cell", "fit", "--held-out", no_rule}).exit, 2) << no_rule;
}

TEST_F(FitVerb, TheFirstLineForPeopleIsTheVerdict) {
  const Ran ran = box->plumb({"-C", "cell", "fit", "--dry-run"});
  const Json result = box->plumb({"-C", "cell", "fit", "--dry-run", "--json"}).json().at("result");
  EXPECT_EQ(ran.out.substr(0, ran.out.find('\n')), result.at("verdict").get<std::string>());
}

/// The tracker's columns once more, as what the controller says.
std::string with_positions_of_the_controller(const std::string& text) {
  std::istringstream in(text);
  std::string out, line;
  std::vector<std::size_t> places;
  while (std::getline(in, line)) {
    if (line.front() == '#') {
      out += line + "\n";
      continue;
    }
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    const bool header = places.empty();
    if (header)
      for (const char* axis : {"x_mm", "y_mm", "z_mm"})
        places.push_back(std::find(cells.begin(), cells.end(), axis) - cells.begin());
    out += line;
    for (const std::size_t place : places) out += (header ? ",n" : ",") + cells.at(place);
    out += "\n";
  }
  return out;
}

TEST(FitOfAController, WhatFollowsStandsOnItsPositionsAndIsNotCompiled) {
  const Sandbox box;
  ASSERT_EQ(box.plumb({"demo", "compliance", "cell"}).exit, 0);
  EXPECT_EQ(box.plumb({"-C", "cell", "fit", "--base", "controller"}).exit, 3);
  box.write("cell/measurements.csv",
            with_positions_of_the_controller(box.read("cell/measurements.csv")));
  const Ran fit = box.plumb({"-C", "cell", "fit", "--base", "controller", "--json"});
  ASSERT_EQ(fit.exit, 0) << fit.err;
  const Json result = fit.json().at("result");
  EXPECT_EQ(result.at("base"), "controller");
  EXPECT_LT(result.at("held_out").at("mean_mm").get<double>(), 1e-3);  // it knows what was read
  const Json compared = box.plumb({"-C", "cell", "compare", "--json"}).json().at("result");
  EXPECT_EQ(compared.at("mean_mm"), result.at("held_out").at("mean_mm"));
  const Json diagnosis = box.plumb({"-C", "cell", "diagnose", "--json"}).json().at("result");
  EXPECT_LT(diagnosis.at("held_out_before_mm").get<double>(), 1e-3);
  ASSERT_EQ(box.plumb({"-C", "cell", "predict", "--as-measured", "-o", "own.csv"}).exit, 0);
  ASSERT_EQ(box.plumb({"-C", "cell", "predict", "--as-measured", "--data", "cell/measurements.csv",
                       "-o", "again.csv"})
                .exit,
            0);
  const Csv again = box.csv("again.csv");
  for (const char* axis : {"x", "y", "z"}) {
    const auto read = again.numbers(std::string(axis) + "_mm");
    const auto predicted = again.numbers("p" + std::string(axis) + "_mm");
    for (std::size_t i = 0; i < read.size(); ++i) EXPECT_NEAR(predicted[i], read[i], 0.01);
  }
  const Ran compile = box.plumb({"-C", "cell", "compile"});
  EXPECT_EQ(compile.exit, 3);
  EXPECT_NE(compile.err.find("E-RUN-BASE"), std::string::npos) << compile.err;
  ASSERT_EQ(box.plumb({"-C", "cell", "fit"}).exit, 0);
  EXPECT_EQ(box.plumb({"-C", "cell", "compile"}).exit, 0);
}

// Rows whose point was not measured: check and fit leave out the same ones, and say so.
TEST(LostPoints, AreLeftOutByEveryVerbAlike) {
  const Sandbox box;
  ASSERT_EQ(box.plumb({"demo", "compliance", "cell"}).exit, 0);
  std::vector<std::string> lines;
  std::istringstream in(box.read("cell/measurements.csv"));
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  const auto header = static_cast<std::size_t>(
      std::find_if(lines.begin(), lines.end(), [](const auto& l) { return l.front() != '#'; }) -
      lines.begin());
  std::vector<std::string> names;
  std::istringstream head(lines[header]);
  for (std::string name; std::getline(head, name, ',');) names.push_back(name);
  const auto column = [&](const char* name) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  const auto with = [&](std::size_t poses, const std::string& x, const std::string& y,
                        const std::string& z) {
    std::string out;
    for (std::size_t i = 0; i <= header + poses; ++i) {
      std::vector<std::string> cells;
      std::istringstream row(lines[i]);
      for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
      if (i == header + 5 || i == header + 12) {
        cells[column("x_mm")] = x;
        cells[column("y_mm")] = y;
        cells[column("z_mm")] = z;
      }
      for (std::size_t k = 0; k < cells.size(); ++k) out += (k > 0 ? "," : "") + cells[k];
      out += "\n";
    }
    return out;
  };
  const std::string named =
      std::to_string(header + 6) + ", " + std::to_string(header + 13);  // lines count from 1
  for (const std::size_t poses : {24U, 90U}) {
    for (const auto& [x, y, z] : {std::array{"-9999", "-9999", "-9999"}, std::array{"0", "0", "0"},
                                  std::array{"0.000", "-0.0", "0"}, std::array{"1e6", "0", "0"},
                                  std::array{"99999", "99999", "99999"}}) {
      box.write("cell/measurements.csv", with(poses, x, y, z));
      const Ran checked = box.plumb({"-C", "cell", "check"});
      const Ran fitted = box.plumb({"-C", "cell", "fit", "--json"});
      EXPECT_EQ(checked.exit, 0) << poses << x << checked.out << checked.err;
      EXPECT_EQ(fitted.exit, 0) << poses << x << fitted.out;
      for (const std::string& said : {checked.err, fitted.out}) {
        EXPECT_NE(said.find("W-CSV-LOST"), std::string::npos) << said;
        EXPECT_NE(said.find(named), std::string::npos) << said;
      }
      if (fitted.exit != 0) continue;
      EXPECT_LT(fitted.json()["result"]["held_out"]["max_mm"], 3.0) << poses << x;
    }
  }
}

}  // namespace

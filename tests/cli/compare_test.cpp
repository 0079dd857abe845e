// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sandbox.hpp"

namespace {

using Json = nlohmann::ordered_json;

class CompareVerb : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    box = new Sandbox;
    ASSERT_EQ(box->plumb({"demo", "gear", "cell"}).exit, 0);
  }
  static void TearDownTestSuite() { delete box; }
  static Json result(const std::vector<std::string>& words) {
    std::vector<std::string> all{"-C", "cell", "--json"};
    all.insert(all.end(), words.begin(), words.end());
    const Ran ran = box->plumb(all);
    EXPECT_EQ(ran.exit, 0) << ran.err;
    return ran.json().at("result");
  }
  static Sandbox* box;
};
Sandbox* CompareVerb::box = nullptr;

TEST_F(CompareVerb, FitsFirstOnceIfThereIsNoRun) {
  const Json first = result({"compare"});
  const Json second = result({"compare"});
  EXPECT_EQ(first.at("run"), 1);
  EXPECT_EQ(second.at("run"), 1);
  EXPECT_EQ(result({"runs"}).at("runs").size(), 1U);
}

TEST_F(CompareVerb, GivesTheHeldOutErrorThatFitReported) {
  const Json fit = result({"fit", "--dry-run"});
  const Json compare = result({"compare"});
  EXPECT_EQ(compare.at("set"), "held_out");
  EXPECT_EQ(compare.at("n"), fit.at("poses_held_out"));
  for (const auto* key : {"mean_mm", "rms_mm", "p95_mm", "max_mm"})
    EXPECT_NEAR(compare.at(key).get<double>(), fit.at("held_out").at(key).get<double>(), 1e-9);
}

TEST_F(CompareVerb, TheWorstPosesComeFirstAndEndAtTheMaximum) {
  const Json r = result({"compare"});
  ASSERT_EQ(r.at("worst").size(), 10U);
  EXPECT_DOUBLE_EQ(r.at("worst")[0].at("error_mm"), r.at("max_mm"));
  double before = r.at("max_mm");
  for (const auto& pose : r.at("worst")) {
    const double error = pose.at("error_mm"), dx = pose.at("dx_mm"), dy = pose.at("dy_mm"),
                 dz = pose.at("dz_mm");
    EXPECT_LE(error, before);
    EXPECT_NEAR(error, std::sqrt(dx * dx + dy * dy + dz * dz), 1e-12);
    EXPECT_EQ(pose.at("set"), "held");
    before = error;
  }
}

TEST_F(CompareVerb, EveryProfileCountsEveryPoseOnceAndKeepsTheMean) {
  const Json r = result({"compare"});
  const auto check = [&](const Json& bins, const std::string& key) {
    std::map<std::string, std::pair<int, double>> sums;
    for (const auto& bin : bins) {
      auto& [n, sum] = sums[key.empty() ? "all" : bin.at(key).get<std::string>()];
      n += bin.at("n").get<int>();
      if (bin.at("n") > 0) sum += bin.at("n").get<int>() * bin.at("mean_mm").get<double>();
    }
    for (const auto& [name, total] : sums) {
      EXPECT_EQ(total.first, r.at("n")) << name;
      EXPECT_NEAR(total.second / total.first, r.at("mean_mm").get<double>(), 1e-9) << name;
    }
    return sums.size();
  };
  EXPECT_EQ(check(r.at("by").at("joint"), "joint"), 6U);
  EXPECT_EQ(check(r.at("by").at("region"), "quantity"), 3U);
  EXPECT_EQ(check(r.at("by").at("order"), ""), 1U);
}

TEST_F(CompareVerb, ShowsRunsSideBySideAndWhatChanged) {
  result({"fit", "--held-out", "20%"});
  result({"fit", "--held-out", "20%", "--seed", "4"});
  const Json runs = result({"runs"}).at("runs");
  ASSERT_GE(runs.size(), 2U);
  const std::string a = std::to_string(runs[0].at("run").get<int>());
  const std::string b = "runs/000" + std::to_string(runs.back().at("run").get<int>());
  const Json both = result({"compare", a, b});
  EXPECT_EQ(both.at("runs").size(), 2U);
  const Json diff = result({"diff", a, b});
  EXPECT_EQ(diff.at("same_measurements"), true);
  EXPECT_EQ(diff.at("same_held_out"), false);  // another seed
  EXPECT_NEAR(diff.at("held_out").at("change_mean_mm").get<double>(),
              diff.at("held_out").at("b").at("mean_mm").get<double>() -
                  diff.at("held_out").at("a").at("mean_mm").get<double>(),
              1e-12);
  EXPECT_FALSE(diff.at("parameters").empty());
  EXPECT_TRUE(result({"diff", a, a}).at("parameters").empty());
}

TEST_F(CompareVerb, ARunThatIsNotThereOrDamagedIsExitThree) {
  result({"compare"});
  EXPECT_EQ(box->plumb({"-C", "cell", "compare", "99"}).exit, 3);
  EXPECT_EQ(box->plumb({"-C", "cell", "compare", "last"}).exit, 2);
  std::filesystem::create_directories(box->path() / "cell/runs/0077");
  box->write("cell/runs/0077/run.json", "{}");
  EXPECT_EQ(box->plumb({"-C", "cell", "diff", "1", "77"}).exit, 3);
  const Ran runs = box->plumb({"-C", "cell", "runs", "--json"});
  EXPECT_EQ(runs.exit, 0);
  EXPECT_EQ(runs.json().at("warnings").at(0).at("code"), "W-RUN-DAMAGED");
  std::filesystem::remove_all(box->path() / "cell/runs/0077");
}

TEST_F(CompareVerb, TheBumpedReflectorIsFoundBetweenTheRightPosesAndTheCleanArmIsLeftAlone) {
  ASSERT_EQ(box->plumb({"demo", "bumped", "bumped"}).exit, 0);
  ASSERT_EQ(box->plumb({"demo", "clean", "clean"}).exit, 0);
  const auto of = [](const std::string& cell) {
    return box->plumb({"-C", cell, "--json", "compare"}).json().at("result");
  };
  const Json bumped = of("bumped"), clean = of("clean");
  ASSERT_EQ(bumped.at("change_points").size(), 1U);
  EXPECT_EQ(bumped.at("change_points")[0].at("of"), "tool");
  // The truth stands apart, in a file that only this test reads.
  const Json truth = Json::parse(box->read("bumped/truth.json"));
  const Json hidden = truth.at("effects")[0].at("numbers");
  EXPECT_EQ(bumped.at("change_points")[0].at("after_pose"), hidden.at("pose_before"));
  EXPECT_EQ(bumped.at("change_points")[0].at("before_pose"), hidden.at("pose_after"));
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(bumped.at("change_points")[0].at("shift_mm")[k].get<double>(),
                hidden.at("shift_mm")[k].get<double>(), 0.015);
  EXPECT_TRUE(clean.at("change_points").empty());
  EXPECT_TRUE(clean.at("drifts").empty());
  EXPECT_EQ(clean.at("lack_of_fit").at("significant"), false);
  EXPECT_EQ(bumped.at("lack_of_fit").at("significant"), true);
  for (const auto* key : {"joint", "region", "load", "context", "order"})
    EXPECT_TRUE(bumped.at("by").contains(key)) << key;
  for (const auto& line : clean.at("matters")) EXPECT_EQ(line.at("matters"), false) << line.dump();
}

}  // namespace

// SPDX-License-Identifier: Apache-2.0
// What people ask first, is it good, where does it fail, why, and what next, is one object in every
// verb.
#include <gtest/gtest.h>

#include <set>

#include "sandbox.hpp"

namespace {

using Json = nlohmann::ordered_json;

class Finding : public testing::Test {
 protected:
  Finding() { EXPECT_EQ(box.plumb({"demo", "compliance", "cell"}).exit, 0); }

  Json of(std::vector<std::string> words) const {
    words.insert(words.begin(), {"-C", "cell"});
    words.emplace_back("--json");
    const Ran ran = box.plumb(words);
    EXPECT_EQ(ran.exit, 0) << ran.err;
    const Json result = ran.json().at("result");
    if (result.contains("verdict_class")) agrees(result);
    return result.at("finding");
  }

  /// The class never contradicts the older one beside it, nor the sentence.
  static void agrees(const Json& result) {
    const std::string one = result.at("finding").at("class"), older = result.at("verdict_class");
    const std::set<std::string> fitting =
        older == "good"     ? std::set<std::string>{"good"}
        : older == "partly" ? std::set<std::string>{"good_but", "limited"}
        : older == "bad"    ? std::set<std::string>{"missing", "not_good"}
                            : std::set<std::string>{"undecidable"};
    EXPECT_TRUE(fitting.contains(one)) << one << " beside " << older;
    EXPECT_EQ(result.at("finding").at("sentence"), result.at("verdict"));
  }

  Sandbox box;
};

TEST_F(Finding, IsTheSameInEveryVerbAndKnowsWhatTheOthersFound) {
  const Json fitted = of({"fit"});
  EXPECT_EQ(fitted.at("class"), "not_good");
  EXPECT_EQ(fitted.at("why").at("state"), "not_looked");
  EXPECT_EQ(fitted.at("next"), "plumb diagnose");
  EXPECT_EQ(of({"compare"}), fitted);

  const Json diagnosed = of({"diagnose"});
  EXPECT_EQ(diagnosed.at("class"), "missing");
  EXPECT_NE(diagnosed.at("why").at("state"), "not_looked");
  EXPECT_NE(diagnosed.at("why").at("state"), "nothing");
  EXPECT_EQ(diagnosed.at("sentence"), fitted.at("sentence"));
  EXPECT_EQ(diagnosed.at("where"), fitted.at("where"));
  EXPECT_EQ(of({"compare"}), diagnosed);
  EXPECT_EQ(of({"report"}), diagnosed);

  const Json applied = of({"diagnose", "--apply"});
  EXPECT_EQ(applied.at("why").at("state"), "nothing");
  EXPECT_NE(applied.at("sentence"), fitted.at("sentence"));
  EXPECT_EQ(of({"compare"}), applied);
}

TEST_F(Finding, OfAnAdditionIsThatOfTheNewModel) {
  of({"fit"});
  const Json added = of({"add", "joint_compliance", "--joints", "J2,J3"});
  EXPECT_EQ(added.at("why").at("state"), "not_looked");
  EXPECT_EQ(of({"compare"}), added);
}

TEST_F(Finding, NextIsTheCommandThatTheTerminalNames) {
  const Ran ran = box.plumb({"-C", "cell", "fit"});
  EXPECT_NE(ran.out.find("Next: plumb -C cell diagnose"), std::string::npos) << ran.out;
  EXPECT_EQ(of({"fit"}).at("next"), "plumb diagnose");
}

TEST_F(Finding, WithoutARunADryRunSaysThatItFitsNothing) {
  std::filesystem::remove_all(box.path() / "cell/runs");
  const Json result = box.plumb({"-C", "cell", "diagnose", "--dry-run", "--json"}).json()["result"];
  EXPECT_TRUE(result.at("finding").is_null());
  EXPECT_TRUE(result.contains("finding_reason"));
}

TEST_F(Finding, WhatIsMeasuredOfTheNoiseIsApartFromWhatIsInferred) {
  box.plumb({"-C", "cell", "fit"});
  const Json result = box.plumb({"-C", "cell", "compare", "--json"}).json().at("result");
  const Json& floor = result.at("noise_floor");
  EXPECT_EQ(floor.at("measured_mm"), result.at("noise_floor_mm"));
  EXPECT_EQ(floor.at("source"), result.at("noise_floor_source"));
  EXPECT_TRUE(floor.contains("inferred_mm"));
}

}  // namespace

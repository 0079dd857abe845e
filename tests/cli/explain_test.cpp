// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "sandbox.hpp"

namespace {

TEST(Explain, KnowsCodesEffectsTermsAndStatusTexts) {
  const Sandbox box;
  for (const auto& [word, kind] :
       std::vector<std::pair<std::string, std::string>>{{"E-FIT-CONVERGE", "code"},
                                                        {"E-CSV-UNIT", "code"},
                                                        {"joint_compliance", "effect"},
                                                        {"held-out", "term"},
                                                        {"noise floor", "term"},
                                                        {"calibrability", "term"},
                                                        {"near-singular", "status"},
                                                        {"tcp", "term"},
                                                        {"local_tree", "effect"}}) {
    const Ran ran = box.plumb({"explain", word, "--json"});
    ASSERT_EQ(ran.exit, 0) << word << ran.err;
    EXPECT_EQ(ran.json().at("result").at("kind"), kind) << word;
    EXPECT_GT(ran.json().at("result").at("text").get<std::string>().size(), 20U);
  }
}

TEST(Explain, TakesAWordInAnySpelling) {
  const Sandbox box;
  for (const auto& words : std::vector<std::vector<std::string>>{
           {"explain", "Noise", "Floor"}, {"explain", "noise-floor"}, {"explain", "NOISE_FLOOR"}})
    EXPECT_EQ(box.plumb(words).exit, 0);
}

TEST(Explain, ListsEverythingWithoutAWord) {
  const Sandbox box;
  const auto result = box.plumb({"explain", "--json"}).json().at("result");
  for (const auto* kind : {"effect", "term", "status", "code"})
    EXPECT_GT(result.at(kind).size(), 8U) << kind;
}

TEST(Explain, SaysDidYouMean) {
  const Sandbox box;
  const Ran ran = box.plumb({"explain", "calibrabilty"});
  EXPECT_EQ(ran.exit, 2);
  EXPECT_NE(ran.err.find("\"calibrability\""), std::string::npos) << ran.err;
}

}  // namespace

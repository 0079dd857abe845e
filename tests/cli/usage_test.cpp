// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "sandbox.hpp"

namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Usage, AMistypedVerbIsExitTwoWithDidYouMean) {
  const Sandbox box;
  const Ran ran = box.plumb({"copmare"});
  EXPECT_EQ(ran.exit, 2);
  EXPECT_EQ(ran.out, "");
  EXPECT_TRUE(has(ran.err, "error[E-USAGE-VERB]")) << ran.err;
  EXPECT_TRUE(has(ran.err, "plumb compare")) << ran.err;
}

TEST(Usage, AMistypedOptionIsExitTwoWithDidYouMean) {
  const Sandbox box;
  const Ran ran = box.plumb({"fit", "--max-rsm", "1"});
  EXPECT_EQ(ran.exit, 2);
  EXPECT_TRUE(has(ran.err, "did you mean '--max-rms'")) << ran.err;
}

TEST(Usage, NoVerbAtAllShowsTheHelpOnStderr) {
  const Sandbox box;
  const Ran ran = box.plumb({});
  EXPECT_EQ(ran.exit, 2);
  EXPECT_EQ(ran.out, "");
  EXPECT_TRUE(has(ran.err, "Examples:")) << ran.err;
}

TEST(Usage, EveryMistakeOfTheCommandLineIsExitTwo) {
  const Sandbox box;
  const std::vector<std::vector<std::string>> mistakes{
      {"fit", "compare"},
      {"fit", "extra"},
      {"fit", "--seed", "many"},
      {"-C"},
      {"--nonsense"},
      {"diff", "1"},
      {"correct"},
      {"inspect"},
      {"predict"},
      {"predict", "a.plumb", "--as-measured"},
      {"predict", "a.plumb", "--data", "f.csv", "--dry-run"},
      {"predict", "a.plumb", "--data", "f.csv", "--run", "1"},
      {"new", "d"},
      {"new", "d", "--urdf", "arm.urdf", "--dh", "dh.csv"},
      {"new", "d", "--dh", "f.csv"},
      {"new", "d", "--dh", "f.csv", "--convention", "craig"},
      {"demo", "complience"},
      {"explain", "held-uot"},
  };
  for (const auto& words : mistakes) {
    const Ran ran = box.plumb(words);
    EXPECT_EQ(ran.exit, 2) << words.front() << ": " << ran.err;
    EXPECT_EQ(ran.out, "") << words.front();
    EXPECT_TRUE(has(ran.err, "error[E-")) << ran.err;
    EXPECT_TRUE(has(ran.err, "= help: ")) << ran.err;
  }
  EXPECT_TRUE(box.listing().empty());
}

TEST(Usage, ANumberOutOfRangeIsExitTwoWithAShortRange) {
  const Sandbox box;
  for (const auto& [words, says] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"fit", "--max-rms", "-1"}, "-1 is not a number greater than 0"},
           {{"fit", "--max-rms", "nan"}, "nan is not a number greater than 0"},
           {{"fit", "--max-rms", "0"}, "0 is not a number greater than 0"},
           {{"bench", "m.plumb", "--max-us", "0"}, "0 is not a number greater than 0"},
           {{"bench", "m.plumb", "--max-us", "inf"}, "inf is not a number greater than 0"},
           {{"fit", "--seed", "-2"}, "-2 is not a whole number from 0 to 2^53"},
           {{"simulate", "--seed", "-2"}, "-2 is not a whole number from 0 to 2^53"},
           {{"plan", "--seed", "1.5"}, "1.5 is not a whole number from 0 to 2^53"},
           {{"study", "planar", "--seed", "-1"}, "-1 is not a whole number from 0 to 2^53"}}) {
    const Ran ran = box.plumb(words);
    EXPECT_EQ(ran.exit, 2) << words[0] << words[1];
    EXPECT_TRUE(has(ran.err, says)) << ran.err;
  }
}

TEST(Usage, WithJsonAMistakeIsOneObjectOnStdout) {
  const Sandbox box;
  for (const auto& words :
       std::vector<std::vector<std::string>>{{"copmare", "--json"},
                                             {"predict", "a.plumb", "--data", "f.csv", "--json"},
                                             {"fit", "--json", "--seed", "x"},
                                             {"--json"}}) {
    const Ran ran = box.plumb(words);
    EXPECT_EQ(ran.exit, 2);
    const auto json = ran.json();
    EXPECT_EQ(json.at("ok"), false);
    EXPECT_EQ(json.at("error").at("exit"), 2);
    EXPECT_TRUE(json.at("result").is_null());
  }
}

TEST(Usage, AFolderWithoutACellIsExitThree) {
  const Sandbox box;
  const Ran ran = box.plumb({"fit", "--json"});
  EXPECT_EQ(ran.exit, 3);
  EXPECT_EQ(ran.json().at("error").at("code"), "E-CELL-NONE");
  EXPECT_EQ(box.plumb({"-C", "nowhere", "runs"}).exit, 3);
}

TEST(Usage, ADirectoryMistypedNeverFindsTheCellAbove) {
  const Sandbox box;
  ASSERT_EQ(box.plumb({"demo", "beam", "."}).exit, 0);
  EXPECT_EQ(box.plumb({"runs"}).exit, 0);
  EXPECT_EQ(box.plumb({"-C", "sub", "runs"}).exit, 3);
}

}  // namespace

// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <sstream>

#include "sandbox.hpp"

namespace {

const std::vector<std::string> kVerbs{
    "demo",    "new",     "simulate", "check", "fit", "compare", "runs",       "diff",   "compile",
    "inspect", "predict", "correct",  "bench", "dbc", "deploy",  "modbus-map", "explain"};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

TEST(Help, BeginsWithTwoExamplesThatNameTheVerb) {
  const Sandbox box;
  for (const auto& verb : kVerbs) {
    const Ran ran = box.plumb({verb, "--help"});
    EXPECT_EQ(ran.exit, 0) << verb;
    EXPECT_EQ(ran.err, "") << verb;
    const auto lines = lines_of(ran.out);
    ASSERT_GE(lines.size(), 3U) << verb;
    EXPECT_EQ(lines[0], "Examples:") << verb;
    for (int i : {1, 2}) {
      EXPECT_EQ(lines[i].rfind("  plumb ", 0), 0U) << lines[i];
      EXPECT_NE(lines[i].find(" " + verb), std::string::npos) << lines[i];
    }
  }
}

TEST(Help, NamesEveryVerbAndTheGlobalOptions) {
  const Sandbox box;
  const Ran ran = box.plumb({"--help"});
  EXPECT_EQ(ran.exit, 0);
  EXPECT_EQ(ran.out.rfind("Examples:\n  plumb ", 0), 0U);
  for (const auto& verb : kVerbs) EXPECT_NE(ran.out.find("\n  " + verb + " "), std::string::npos);
  for (const auto* option : {"-C", "--json", "--version"})
    EXPECT_NE(ran.out.find(option), std::string::npos) << option;
}

TEST(Help, EveryVerbTakesTheGlobalOptions) {
  const Sandbox box;
  for (const auto& verb : kVerbs) {
    const std::string help = box.plumb({verb, "--help"}).out;
    for (const auto* option : {"-C DIR", "--json"})
      EXPECT_NE(help.find(option), std::string::npos) << verb << " " << option;
  }
}

TEST(Help, VersionIsOneLine) {
  const Sandbox box;
  const Ran ran = box.plumb({"--version"});
  EXPECT_EQ(ran.exit, 0);
  EXPECT_EQ(ran.out.rfind("plumb ", 0), 0U);
  EXPECT_EQ(std::count(ran.out.begin(), ran.out.end(), '\n'), 1);
}

TEST(Help, TakesLessThanThirtyMillisecondsInTheMedian) {
  if (PLUMB_TIMED == 0) GTEST_SKIP() << "timing is judged in release";
  const Sandbox box;
  std::vector<double> ms;
  for (int i = 0; i < 20; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_EQ(box.plumb({"--help"}).exit, 0);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    ms.push_back(took.count());
  }
  std::nth_element(ms.begin(), ms.begin() + 10, ms.end());
  std::printf("plumb --help: median of %zu runs %.1f ms\n", ms.size(), ms[10]);
  EXPECT_LT(ms[10], 30.0);
}

}  // namespace

// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "sandbox.hpp"
#include "tests/yardstick.hpp"

namespace {

const std::vector<std::string> kVerbs{
    "demo",    "new",     "simulate", "check",   "fit",     "compare", "runs",   "diff",
    "compile", "inspect", "predict",  "correct", "bench",   "dbc",     "deploy", "modbus-map",
    "explain", "plot",    "report",   "serve",   "recheck", "fleet",   "filter"};

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

std::size_t characters(const std::string& line) {
  return static_cast<std::size_t>(
      std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

/// Lines wider than 80 columns, but for messages' help lines and commands, which can be pasted.
std::string too_wide(const std::string& printed) {
  std::string out;
  for (const auto& line : lines_of(printed)) {
    const bool pasted = line.find("= help: ") != std::string::npos ||
                        line.find("Next: plumb") != std::string::npos ||
                        line.find("or: plumb") != std::string::npos ||
                        line.find("--> ") != std::string::npos;
    if (!pasted && characters(line) > 80) out += line + "\n";
  }
  return out;
}

TEST(Help, IsNoWiderThanTheTerminal) {
  const Sandbox box;
  const Ran all = box.plumb_on_terminal(80, {"--help"});
  EXPECT_EQ(all.exit, 0);
  EXPECT_EQ(too_wide(all.out), "");
  for (const auto* verb :
       {"demo",     "new",    "simulate", "import",     "check",   "fit",     "compare",
        "diagnose", "add",    "drop",     "plan",       "runs",    "diff",    "compile",
        "export",   "deploy", "dbc",      "modbus-map", "inspect", "predict", "correct",
        "bench",    "study",  "explain",  "plot",       "report",  "serve",   "filter"}) {
    const Ran ran = box.plumb_on_terminal(80, {verb, "--help"});
    EXPECT_EQ(ran.exit, 0) << verb;
    EXPECT_EQ(too_wide(ran.out), "") << verb;
    EXPECT_NE(ran.out.find("--json"), std::string::npos) << verb;
  }
}

TEST(Tables, AreNoWiderThanTheTerminal) {
  const Sandbox box;
  ASSERT_EQ(box.plumb({"demo", "compliance", "cell"}).exit, 0);
  ASSERT_EQ(box.plumb({"-C", "cell", "fit"}).exit, 0);
  ASSERT_EQ(box.plumb({"-C", "cell", "add", "joint_compliance", "--joints", "J2,J3"}).exit, 0);
  const std::vector<std::vector<std::string>> verbs{{"-C", "cell", "runs"},
                                                    {"-C", "cell", "compare"},
                                                    {"-C", "cell", "fit", "--dry-run"},
                                                    {"-C", "cell", "diff", "1", "2"},
                                                    {"-C", "cell", "diagnose", "--all"},
                                                    {"-C", "cell", "compile", "-o", "robot.plumb"},
                                                    {"inspect", "robot.plumb"}};
  for (const auto& words : verbs) {
    const std::string& verb = words.front() == "-C" ? words[2] : words.front();
    const Ran ran = box.plumb_on_terminal(80, words);
    EXPECT_EQ(ran.exit, 0) << verb << ": " << ran.out;
    EXPECT_GT(ran.out.size(), 200U) << verb;
    EXPECT_EQ(too_wide(ran.out), "") << verb;
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
    const double begin = plumb::tests::processor_s(true);
    ASSERT_EQ(box.plumb({"--help"}).exit, 0);
    ms.push_back(1e3 * (plumb::tests::processor_s(true) - begin));
  }
  std::nth_element(ms.begin(), ms.begin() + 10, ms.end());
  std::printf("plumb --help: median of %zu runs %.1f ms\n", ms.size(), ms[10]);
  EXPECT_LT(ms[10], 30.0 * plumb::tests::times_slower());
}

}  // namespace

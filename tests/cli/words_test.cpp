// SPDX-License-Identifier: Apache-2.0
// What a new user reads: a verdict, numbers, the command that helps most, and every word explained.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <regex>
#include <set>
#include <sstream>

#include "sandbox.hpp"
#include "show/heads.hpp"

namespace {

using Words = std::vector<std::string>;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

/// The cells of a row of a table: two blanks between them.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> out;
  static const std::regex kGap("  +");
  for (std::sregex_token_iterator it(line.begin(), line.end(), kGap, -1), end; it != end; ++it)
    if (!it->str().empty()) out.push_back(*it);
  return out;
}

bool has_letter(const std::string& text) {
  return std::any_of(text.begin(), text.end(), [](char c) { return std::isalpha(c) != 0; });
}

/// Rows that begin a table: cells that all hold words, first of a block or behind a sentence.
std::set<std::string> heads_of(const std::string& screen) {
  std::set<std::string> out;
  bool in_table = false;
  for (const auto& line : lines_of(screen)) {
    auto cells = cells_of(line);
    const bool row = line.starts_with("  ") && cells.size() >= 3;
    if (row && !in_table && std::all_of(cells.begin(), cells.end(), [](const auto& c) {
          return has_letter(c) || c == "95 %";
        })) {
      // What a profile is taken over names itself: "J2 torque [Nm]".
      if (cells[1] == "held-out" || cells[1] == "fit") cells.erase(cells.begin());
      out.insert(cells.begin(), cells.end());
    }
    in_table = row;
  }
  return out;
}

class Screens : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    box = new Sandbox;
    ASSERT_EQ(box->plumb({"demo", "compliance", "cell"}).exit, 0);
    for (const Words& words : std::vector<Words>{{"fit"},
                                                 {"check"},
                                                 {"compare"},
                                                 {"diagnose"},
                                                 {"diagnose", "--all"},
                                                 {"add", "gravity_free", "--joints", "J2,J3"},
                                                 {"plan", "--n", "5", "--pool", "50"},
                                                 {"compile"},
                                                 {"runs"}}) {
      Words all{"-C", "cell"};
      all.insert(all.end(), words.begin(), words.end());
      const Ran ran = run(all);
      EXPECT_EQ(ran.exit, 0) << words.front() << ran.err;
      if (words.front() == "compile") {
        EXPECT_EQ(ran.err.find("warning"), std::string::npos) << "the demo's own\n" << ran.err;
      }
      std::string name;
      for (const auto& word : words) name += (name.empty() ? "" : " ") + word;
      (*screens)[name] = ran.out;
    }
    (*screens)["inspect"] = run({"inspect", "cell/robot.plumb"}).out;
  }
  static void TearDownTestSuite() {
    delete box;
    delete screens;
  }

  /// As where there is no terminal: a hundred columns.
  static Ran run(const Words& words) {
    ::setenv("COLUMNS", "100", 1);
    Ran out = box->plumb(words);
    ::unsetenv("COLUMNS");
    return out;
  }

  static Sandbox* box;
  static std::map<std::string, std::string>* screens;
};
Sandbox* Screens::box = nullptr;
std::map<std::string, std::string>* Screens::screens = new std::map<std::string, std::string>;

TEST_F(Screens, FitInAHundredColumns) {
  for (const auto& [name, screen] : *screens)
    for (const auto& line : lines_of(screen)) {
      const auto width =
          std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; });
      const bool command = line.find(": plumb ") != std::string::npos;
      EXPECT_TRUE(width <= 100 || command) << name << " " << width << ": " << line;
    }
}

TEST_F(Screens, EndWithTheCommandThatHelpsMost) {
  for (const auto& [name, screen] : *screens) {
    const auto at = screen.find("\nNext: plumb ");
    ASSERT_NE(at, std::string::npos) << name << screen;
    for (const auto& line : lines_of(screen.substr(at + 1)))
      EXPECT_TRUE(line.starts_with("Next: plumb ") || line.starts_with("  or: plumb ") ||
                  line.starts_with("      # "))
          << line;
  }
}

TEST_F(Screens, ProposeWhatSuitsTheState) {
  const auto next = [&](const std::string& name) {
    const std::string& screen = screens->at(name);
    const auto at = screen.find("\nNext: ") + 7;
    return screen.substr(at, screen.find('\n', at) - at);
  };
  EXPECT_TRUE(next("fit").starts_with("plumb -C cell diagnose")) << next("fit");
  EXPECT_EQ(next("diagnose"), "plumb -C cell add gravity_free --joints J2,J3");
  EXPECT_TRUE(next("add gravity_free --joints J2,J3").starts_with("plumb -C cell compile"));
  EXPECT_TRUE(next("runs").starts_with("plumb -C cell diff ")) << next("runs");
  EXPECT_EQ(next("check"), "plumb -C cell fit");
}

TEST_F(Screens, HaveNoColumnThatExplainDoesNotKnow) {
  std::set<std::string> heads;
  for (const auto& [name, screen] : *screens)
    for (const auto& head : heads_of(screen)) heads.insert(head);
  for (const char* head : plumb::offline::show::head::kAll) heads.insert(head);
  EXPECT_GT(heads.size(), 30U);
  static const std::regex kOfTheCell("within .*|run [0-9]+");
  for (const auto& head : heads) {
    if (std::regex_match(head, kOfTheCell)) continue;
    EXPECT_EQ(box->plumb({"explain", head}).exit, 0) << head;
  }
}

TEST_F(Screens, HaveNoTermThatExplainDoesNotKnow) {
  for (const char* term : {"ln Bayes",    "absorbed",      "share",         "F",
                           "floor",       "held-out",      "RMS",           "95 %",
                           "sigma",       "calibrability", "observability", "fold",
                           "lack of fit", "systematic",    "condition",     "tolerance",
                           "outlier",     "noise floor",   "95 % interval", "confounded",
                           "evidence"})
    EXPECT_EQ(box->plumb({"explain", term}).exit, 0) << term;
}

TEST_F(Screens, CallAnEffectByOneName) {
  const std::string name = "joint compliance under unknown weights (gravity_free:J2+J3)";
  for (const char* screen : {"diagnose", "add gravity_free --joints J2,J3"})
    EXPECT_NE(screens->at(screen).find(name), std::string::npos) << screen;
  EXPECT_EQ(screens->at("diagnose").find("rad s^2/m"), std::string::npos);
}

TEST_F(Screens, GiveTheHeldOutMeanAnInterval) {
  for (const char* screen : {"fit", "compare", "add gravity_free --joints J2,J3"})
    EXPECT_NE(screens->at(screen).find("95 % interval"), std::string::npos) << screen;
  for (const char* verb : {"fit", "compare"}) {
    const auto result = box->plumb({"-C", "cell", verb, "--json"}).json().at("result");
    const auto& held = std::string(verb) == "fit" ? result.at("held_out") : result;
    EXPECT_LT(held.at("mean_low_mm").get<double>(), held.at("mean_mm").get<double>());
    EXPECT_GT(held.at("mean_high_mm").get<double>(), held.at("mean_mm").get<double>());
  }
}

TEST_F(Screens, HoldNoEscapeSequenceWhereThereIsNoTerminal) {
  for (const auto& [name, screen] : *screens)
    EXPECT_EQ(screen.find('\x1b'), std::string::npos) << name;
}

TEST(Words, RunsCountsAnEffectThatStandsInTheModelSeveralTimes) {
  const Sandbox box;
  ASSERT_EQ(box.plumb({"demo", "gear", "cell"}).exit, 0);
  ASSERT_EQ(box.plumb({"-C", "cell", "add", "gear_ripple", "--joints", "J2", "--set",
                       "cycles_per_turn=8,20,31"})
                .exit,
            0);
  const Ran ran = box.plumb({"-C", "cell", "runs"});
  EXPECT_NE(ran.out.find("geometry, gear_ripple x3\n"), std::string::npos) << ran.out;
}

TEST(Words, DropNamesWhatCanBeDroppedAsACommand) {
  const Sandbox box;
  ASSERT_EQ(box.plumb({"demo", "compliance", "cell"}).exit, 0);
  ASSERT_EQ(box.plumb({"-C", "cell", "add", "gravity_free", "--joints", "J2,J3"}).exit, 0);
  const Ran ran = box.plumb({"-C", "cell", "drop", "joint_compliance"});
  EXPECT_EQ(ran.exit, 3);
  EXPECT_NE(ran.err.find("= help: plumb -C cell drop gravity_free --joints J2,J3\n"),
            std::string::npos)
      << ran.err;
}

TEST(Words, ANewCellShowsHowPayloadLinksAndNoiseAreGiven) {
  const Sandbox box;
  box.write("dh.csv", "joint,alpha_deg,a_mm,d_mm,theta_deg\nJ1,-90,0,400,0\nJ2,0,500,0,0\n");
  ASSERT_EQ(box.plumb({"new", "cell", "--dh", "dh.csv", "--convention", "standard"}).exit, 0);
  std::string cell = box.read("cell/cell.toml");
  for (const char* example :
       {"# payload = { mass_kg", "# [[robot.links]]", "# com_mm", "# sigma_um"})
    EXPECT_NE(cell.find(example), std::string::npos) << example << cell;
  // Every example is right: without the marks the cell can still be read.
  cell = std::regex_replace(
      cell, std::regex("# (payload =|\\[\\[|joint =|mass_kg|com_mm|sigma_um)"), "$1");
  box.write("cell/cell.toml", cell);
  const Ran ran = box.plumb({"-C", "cell", "runs"});  // reads the cell and nothing else
  EXPECT_EQ(ran.exit, 0) << ran.err << cell;
}

}  // namespace

// SPDX-License-Identifier: Apache-2.0
#include "show/block.hpp"

#include <gtest/gtest.h>

#include "report/html.hpp"

namespace plumb::offline::show {
namespace {

Table errors() {
  Table table{.name = "errors", .caption = "Errors [mm]", .head = {"of", "mean"}};
  table.add({"now", "0.115"});
  table.add({"with it", "0.033"});
  return table;
}

Blocks result() {
  return {Sentence{"Missing: J2 yields.", "bad"},
          Sentence{"Nothing was added.", ""},
          errors(),
          Note{"held-out: 5 folds", Note::Stands::kUnder},
          Figure{"evidence"},
          Note{"Hard to tell from: J3 yields."},
          Table{.name = "empty", .caption = "Nothing to see", .head = {"a"}},
          action_of("diagnose --apply   # all that is supported")};
}

TEST(Blocks, OnATerminalTablesAndNotesStandApartButNotesUnderATableDoNot) {
  EXPECT_EQ(text_of(result()),
            "Missing: J2 yields.\n"
            "Nothing was added.\n"
            "\n"
            "  of        mean\n"
            "  now      0.115\n"
            "  with it  0.033\n"
            "  held-out: 5 folds\n"
            "\n"
            "Hard to tell from: J3 yields.\n");
}

TEST(Blocks, EveryMediumSaysAllThatTheOthersSay) {
  const std::string text = text_of(result()), json = to_json(result()).dump();
  report::Html html;
  std::vector<std::string> figures;
  html.blocks(result(), [&](const std::string& name) { figures.push_back(name); });
  for (const char* words : {"Missing: J2 yields.", "Nothing was added.", "0.115", "with it",
                            "held-out: 5 folds", "Hard to tell from: J3 yields."}) {
    EXPECT_NE(text.find(words), std::string::npos) << words;
    EXPECT_NE(json.find(words), std::string::npos) << words;
    EXPECT_NE(html.text().find(words), std::string::npos) << words;
  }
  EXPECT_EQ(figures, std::vector<std::string>{"evidence"});
  EXPECT_NE(html.text().find("plumb diagnose --apply   # all that is supported"),
            std::string::npos);
  EXPECT_EQ(text.find("Nothing to see"), std::string::npos);
  EXPECT_EQ(html.text().find("Nothing to see"), std::string::npos);
}

TEST(Blocks, WhatGoesOnStandsRightBelowWhatIsBefore) {
  Table more = errors();
  more.goes_on = true;
  EXPECT_EQ(
      text_of(Blocks{Sentence{"By what:"}, more, more, Note{"All held out.", Note::Stands::kBelow},
                     Sentence{"Moved:"}, Note{"the tool", Note::Stands::kUnder}}),
      "By what:\n" + text_of(more) + text_of(more) +
          "All held out.\n"
          "\n"
          "Moved:\n"
          "  the tool\n");
}

TEST(Blocks, OfAVerbAreItsTextAndItsResult) {
  Outcome outcome;
  outcome.result["verdict"] = "missing";
  put(result(), outcome);
  EXPECT_EQ(outcome.text, text_of(result()));
  EXPECT_EQ(outcome.result["blocks"], to_json(result()));
  EXPECT_EQ(outcome.result["verdict"], "missing");
}

TEST(Blocks, APageDrawsBarsAndNeverReadsThemAloud) {
  Table bars{.caption = "Errors", .head = {"joint", ""}, .left_from = 1};
  bars.add({"J#", "####"});
  report::Html html;
  html.table(bars);
  EXPECT_NE(html.text().find("<span class=\"bar\" aria-hidden=\"true\">####</span>"),
            std::string::npos);
  EXPECT_NE(html.text().find(">J#<"), std::string::npos) << "words are no bar";
}

TEST(Blocks, AnActionIsACommandAndItsReason) {
  const Action with = action_of("plan --n 30   # which poses to measure next");
  EXPECT_EQ(with.command, "plan --n 30");
  EXPECT_EQ(with.why, "which poses to measure next");
  const Action plain = action_of("plan --separate a,b@x=#3");
  EXPECT_EQ(plain.command, "plan --separate a,b@x=#3") << "a sign inside a word begins no reason";
  EXPECT_EQ(plain.why, "");
}

TEST(Blocks, ATableOfLongWordsIsALineForEachRow) {
  Table table{.caption = "Not testable",
              .captioned = true,
              .head = {"effect", "why", "measure"},
              .as_lines = true};
  table.add({"drift", "no times", "poses again later"});
  table.add({"load", "no payload", ""});
  EXPECT_EQ(text_of(table),
            "Not testable\n"
            "  drift: no times; measure poses again later\n"
            "  load: no payload\n");
}

}  // namespace
}  // namespace plumb::offline::show

// SPDX-License-Identifier: Apache-2.0
#include "program/problem.hpp"

#include <gtest/gtest.h>

#include "program/printable.hpp"
#include "program/utf8.hpp"
namespace plumb::offline {
namespace {

Problem unit_problem() {
  return {Severity::kError, "E-CSV-UNIT", "column 'x' has no unit",
          Place{.file = "tracker.csv",
                .line = 1,
                .column = 20,
                .length = 1,
                .source = "pose,q1_deg,q2_deg,x,y_mm",
                .label = "add a unit suffix"},
          "rename it to 'x_mm', or: plumb import tracker.csv --map x=x_mm"};
}

TEST(Render, IsTheExampleOfTheInterfaceToTheLetter) {
  EXPECT_EQ(render(unit_problem()),
            "error[E-CSV-UNIT]: column 'x' has no unit\n"
            "  --> tracker.csv:1:20\n"
            "   |\n"
            " 1 | pose,q1_deg,q2_deg,x,y_mm\n"
            "   |                    ^ add a unit suffix\n"
            "   = help: rename it to 'x_mm', or: plumb import tracker.csv --map x=x_mm");
}

TEST(Render, WidensTheGutterWithTheLineNumber) {
  Problem p = unit_problem();
  p.place->line = 1234;
  EXPECT_EQ(render(p),
            "error[E-CSV-UNIT]: column 'x' has no unit\n"
            "     --> tracker.csv:1234:20\n"
            "      |\n"
            " 1234 | pose,q1_deg,q2_deg,x,y_mm\n"
            "      |                    ^ add a unit suffix\n"
            "      = help: rename it to 'x_mm', or: plumb import tracker.csv --map x=x_mm");
}

TEST(Render, NeedsNeitherPlaceNorHelp) {
  EXPECT_EQ(render({Severity::kWarning, "W-X", "something", std::nullopt, ""}),
            "warning[W-X]: something");
  EXPECT_EQ(render({Severity::kNote, "N-X", "something", Place{.file = "a.csv"}, "do this"}),
            "note[N-X]: something\n  --> a.csv\n  = help: do this");
}

TEST(Render, CountsCharactersAndKeepsTheTerminalSafe) {
  Problem p = unit_problem();
  p.place->source = "\tµ\x1b[31m,x";  // a tab, a two-byte letter, an escape character
  p.place->column = 9;
  EXPECT_EQ(render(p),
            "error[E-CSV-UNIT]: column 'x' has no unit\n"
            "  --> tracker.csv:1:9\n"
            "   |\n"
            " 1 |  µ\xEF\xBF\xBD[31m,x\n"
            "   |         ^ add a unit suffix\n"
            "   = help: rename it to 'x_mm', or: plumb import tracker.csv --map x=x_mm");
}

TEST(Render, ShowsTheNeighbourhoodOfTheCaretInALongLine) {
  Problem p = unit_problem();
  p.help.clear();
  p.place->source = std::string(500, 'a') + "x" + std::string(500, 'b');
  p.place->column = 501;
  EXPECT_EQ(render(p),
            "error[E-CSV-UNIT]: column 'x' has no unit\n"
            "  --> tracker.csv:1:501\n"
            "   |\n"
            " 1 | …" +
                std::string(36, 'a') + "x" + std::string(35, 'b') +
                "…\n"
                "   | " +
                std::string(37, ' ') + "^ add a unit suffix");
}

TEST(Render, NeverReadsOutsideTheLineWhateverTheColumn) {
  for (const int column : {-5, 0, 1, 25, 26, 27, 1000000})
    for (const int length : {-1, 0, 1, 1000000}) {
      Problem p = unit_problem();
      p.place->column = column;
      p.place->length = length;
      EXPECT_LT(render(p).size(), 1000u);
    }
}

/// What a hostile file may hold, each piece with how it is shown.
const std::vector<std::pair<std::string, std::string>> kHostile{{"\x1b[31m", "\\x1b[31m"},
                                                                {"\a", "\\x07"},
                                                                {"\r", "\\x0d"},
                                                                {"\x7f", "\\x7f"},
                                                                {"\xc2\x9b", "\\u009b"},
                                                                {"\x9b", "\\x9b"},
                                                                {"\xe2\x80\xae", "\\u202e"},
                                                                {"\xe2\x81\xa6", "\\u2066"},
                                                                {"\xe2\x80\xa8", "\\u2028"},
                                                                {"\xef\xbb\xbf", "\\ufeff"},
                                                                {"\xd8\x9c", "\\u061c"},
                                                                {"\xff", "\\xff"},
                                                                {"\xe2\x80", "\\xe2\\x80"}};

TEST(Printable, ShowsWhateverATerminalWouldObeyAndNothingElse) {
  for (const auto& [raw, shown] : kHostile) {
    EXPECT_EQ(printable_text("a" + raw + "/"), "a" + shown + "/");
    EXPECT_EQ(printable_line("a" + raw + "/"), "a" + shown + "/");
  }
  const std::string ours = "Größe 3 µm ± 2°, 測定, 😀\n\ttable";
  EXPECT_EQ(printable_text(ours), ours);
  EXPECT_EQ(printable_line("a\n\tb"), "a\\n\\tb");
  EXPECT_EQ(printable_text(std::string("a\0b", 3)), "a\\x00b");
}

TEST(Printable, EveryByteStringBecomesUtf8WithoutControls) {
  unsigned state = 1;
  for (int k = 0; k < 20000; ++k) {
    std::string bytes;
    for (int i = 0; i < 8; ++i) {
      state = state * 1664525u + 1013904223u;
      bytes += static_cast<char>(state >> 24);
    }
    const std::string shown = printable_line(bytes);
    EXPECT_EQ(find_invalid_utf8(shown), std::string_view::npos);
    for (const char c : shown) EXPECT_FALSE(static_cast<unsigned char>(c) < 0x20 || c == 0x7f);
    EXPECT_EQ(printable_line(shown), shown);
    EXPECT_EQ(find_invalid_utf8(valid_utf8(bytes)), std::string_view::npos);
  }
}

TEST(Render, LetsNoPartOfAProblemReachTheTerminalRaw) {
  for (const auto& [raw, shown] : kHostile) {
    Problem p = unit_problem();
    p.message += raw;
    p.help += raw;
    p.place->file += raw;
    p.place->label += raw;
    p.place->source += raw;
    const std::string text = render(p);
    EXPECT_EQ(text.find(raw), std::string::npos) << shown;
    EXPECT_EQ(text.find('\x1b'), std::string::npos);
    EXPECT_NE(text.find(shown), std::string::npos) << shown;
    EXPECT_EQ(find_invalid_utf8(text), std::string::npos) << shown;
  }
}

TEST(Failure, SaysItsFirstProblemAndHowManyMore) {
  EXPECT_STREQ(Failure(Exit::kInput, unit_problem()).what(), "column 'x' has no unit");
  EXPECT_STREQ(Failure(Exit::kInput, {unit_problem(), unit_problem(), unit_problem()}).what(),
               "column 'x' has no unit (and 2 more)");
  EXPECT_EQ(Failure(Exit::kUsage, unit_problem()).exit_code(), Exit::kUsage);
}

TEST(DidYouMean, ForgivesATypoATransposedPairAndTheCase) {
  const std::vector<std::string> known{"tolerance_mm", "name", "serial", "alpha"};
  EXPECT_EQ(did_you_mean("tolerence_mm", known), "tolerance_mm");
  EXPECT_EQ(did_you_mean("alhpa", known), "alpha");
  EXPECT_EQ(did_you_mean("Serial", known), "serial");
  EXPECT_EQ(did_you_mean("gearbox", known), std::nullopt);
  EXPECT_EQ(did_you_mean("", known), std::nullopt);
  EXPECT_EQ(did_you_mean("x", {}), std::nullopt);
}

}  // namespace
}  // namespace plumb::offline

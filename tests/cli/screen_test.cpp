// SPDX-License-Identifier: Apache-2.0
// What a terminal is given: lines no longer than it is wide, and colour only where it has some.
#include "program/screen.hpp"

#include <gtest/gtest.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>
#include <sstream>

namespace plumb {
namespace {

constexpr const char* kVerdict =
    "Not good enough: held-out error 0.164 mm mean, 0.384 mm at 95 % of 48 readings, over the "
    "tolerance of 0.100 mm; 10.2 times the noise floor 0.016 mm: something physical is missing.";

std::size_t widest(const std::string& text) {
  std::size_t out = 0;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out = std::max(out, line.size());
  return out;
}

std::string without_breaks(std::string text) {
  for (char& c : text)
    if (c == '\n') c = ' ';
  return text;
}

/// A terminal of so many columns; the environment is put back at the end.
class Terminal {
 public:
  explicit Terminal(unsigned short columns) {
    winsize size{};
    size.ws_col = columns;
    size.ws_row = 25;
    EXPECT_EQ(::openpty(&leader_, &follower_, nullptr, nullptr, &size), 0);
    ::unsetenv("COLUMNS");
    ::unsetenv("NO_COLOR");
    ::setenv("TERM", "xterm", 1);
  }
  ~Terminal() {
    ::close(leader_);
    ::close(follower_);
    ::unsetenv("COLUMNS");
    ::unsetenv("NO_COLOR");
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  int descriptor() const { return follower_; }

 private:
  int leader_ = -1, follower_ = -1;
};

TEST(Screen, BreaksSentencesAtItsWidthAndLosesNoWord) {
  for (const std::size_t columns : {40U, 80U, 100U}) {
    const std::string out = laid_out(kVerdict, {.columns = columns});
    EXPECT_LE(widest(out), columns);
    EXPECT_EQ(without_breaks(out), kVerdict);
  }
  EXPECT_EQ(laid_out(kVerdict, {.columns = 400}), kVerdict);
}

TEST(Screen, LeavesARowAloneAndCommandsAsTheyAre) {
  const std::string table = "  held-out, calibrated     48  0.164  0.186  0.384  0.398\n";
  const std::string command = "Next: plumb -C cell add gravity_free --joints J2,J3\n";
  EXPECT_EQ(laid_out(table + command, {.columns = 20}), table + command);
}

TEST(Screen, PartsATableThatIsTooWideAndRepeatsItsFirstColumn) {
  const std::string table =
      "  joint        alpha [deg]   a [mm]  q max\n"
      "  J1 nominal        0.0000   0.0000  180.0 deg\n"
      "     \u00e4ndert        -0.0012  -0.1000\n";
  EXPECT_EQ(laid_out("A table\n\n" + table + "\nits end", {.columns = 36}),
            "A table\n\n"
            "  joint       alpha [deg]   a [mm]\n"
            "  J1 nominal       0.0000   0.0000\n"
            "     \u00e4ndert       -0.0012  -0.1000\n"
            "\n"
            "  joint       q max\n"
            "  J1 nominal  180.0 deg\n"
            "     \u00e4ndert\n"
            "\nits end");
  EXPECT_EQ(laid_out(table, {.columns = 80}), table);
}

TEST(Screen, PartsATableBeforeItsWordsIfThereIsNoRoomBesideTheNumbers) {
  const std::string out = laid_out(
      "  run     created               effects\n"
      "  0001    2026-11-23T14:17:40Z  geometry, joint compliance of J2, reversal of J3\n",
      {.columns = 40});
  EXPECT_LE(widest(out), 40U);
  EXPECT_NE(out.find("\n\n  run   effects\n  0001  geometry, joint compliance of\n"),
            std::string::npos)
      << out;
}

TEST(Screen, BreaksTheHelpAndContinuesExamplesSoThatTheyCanBePasted) {
  const std::string help =
      "Examples:\n"
      "  plumb add formula --formula \"dq2 = k * tau2\" --parameter \"k [rad] ~ 1e-6\"\n"
      "  plumb run DIR              # is all of it usable?\n\n"
      "Options:\n"
      "  --joints J2,J3          Only these: plumb explain lists all of them\n";
  EXPECT_EQ(laid_out_help(help, {.columns = 50}),
            "Examples:\n"
            "  plumb add formula --formula \"dq2 = k * tau2\" \\\n"
            "      --parameter \"k [rad] ~ 1e-6\"\n"
            "  plumb run DIR\n"
            "      # is all of it usable?\n\n"
            "Options:\n"
            "  --joints J2,J3          Only these: plumb\n"
            "                          explain lists all of\n"
            "                          them\n");
  EXPECT_EQ(laid_out_help(help, {.columns = 100}), help);
}

TEST(Screen, BreaksTheWordsOfTheLastCellBelowTheirColumn) {
  EXPECT_EQ(laid_out("  0.054  yes  joint compliance of the second and the third joint\n",
                     {.columns = 40}),
            "  0.054  yes  joint compliance of the\n"
            "              second and the third joint\n");
}

TEST(Screen, PutsTheCommentOfAWideCommandOnALineOfItsOwn) {
  EXPECT_EQ(laid_out("  or: plumb -C cell plan --separate a,b   # to be sure which it is\n",
                     {.columns = 50}),
            "  or: plumb -C cell plan --separate a,b\n"
            "      # to be sure which it is\n");
}

TEST(Screen, BreaksTheSentenceOfAMessageOnATerminalOnly) {
  const std::string message =
      "warning[W-X]: two readings contradict the others\n  = help: plumb -C cell check --json";
  EXPECT_EQ(painted(message, {.columns = 30}), message);
  EXPECT_EQ(painted(message, {.columns = 30, .is_terminal = true}),
            "warning[W-X]: two readings\n  contradict the others\n"
            "  = help: plumb -C cell check --json");
}

TEST(Screen, IndentsWhatFollowsInAList) {
  EXPECT_EQ(laid_out("  reversal: no columns that say where it came from", {.columns = 24}),
            "  reversal: no columns\n    that say where it\n    came from");
}

TEST(Screen, CountsCharactersAndNotBytes) {
  EXPECT_EQ(laid_out("µµµµ µµµµ µµµµ µµµµ", {.columns = 19}), "µµµµ µµµµ µµµµ µµµµ");
}

TEST(Screen, IsAsWideAsTheTerminalUnlessColumnsSaysOtherwise) {
  const Terminal terminal(66);
  EXPECT_EQ(screen_of(terminal.descriptor()).columns, 66U);
  ::setenv("COLUMNS", "81", 1);
  EXPECT_EQ(screen_of(terminal.descriptor()).columns, 81U);
  ::setenv("COLUMNS", "none", 1);
  EXPECT_EQ(screen_of(terminal.descriptor()).columns, 66U);
}

TEST(Screen, IsAHundredColumnsWideWhereThereIsNoTerminal) {
  ::unsetenv("COLUMNS");
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  EXPECT_EQ(screen_of(ends[1]).columns, 100U);
  EXPECT_EQ(screen_of(ends[1]).ink, Screen::Ink::kPlain);
  ::close(ends[0]);
  ::close(ends[1]);
}

TEST(Screen, HasColourOnATerminalOnlyAndNeverWithNoColorOrADumbOne) {
  const Terminal terminal(80);
  EXPECT_EQ(screen_of(terminal.descriptor()).ink, Screen::Ink::kColour);
  ::setenv("NO_COLOR", "1", 1);
  EXPECT_EQ(screen_of(terminal.descriptor()).ink, Screen::Ink::kPlain);
  ::setenv("NO_COLOR", "", 1);  // empty: as if it were not set
  EXPECT_EQ(screen_of(terminal.descriptor()).ink, Screen::Ink::kColour);
  ::setenv("TERM", "dumb", 1);
  EXPECT_EQ(screen_of(terminal.descriptor()).ink, Screen::Ink::kPlain);
}

TEST(Screen, ColoursActionsAndMessagesAndNothingElse) {
  const Screen colour{.columns = 100, .ink = Screen::Ink::kColour};
  EXPECT_EQ(laid_out("Next: plumb fit", colour), "\x1b[1;36mNext:\x1b[0m plumb fit");
  EXPECT_EQ(laid_out("Planned 5 poses", colour), "Planned 5 poses");
  EXPECT_EQ(painted("warning[W-X]: y", colour), "\x1b[1;33mwarning\x1b[0m[W-X]: y");
  EXPECT_EQ(painted("error[E-X]: y", {}), "error[E-X]: y");
}

TEST(Screen, AVerdictHasTheColourOfItsClassAndNotOfItsWords) {
  const Screen colour{.columns = 100, .ink = Screen::Ink::kColour};
  const std::string missing = "Good: 0.03 mm, but something physical is still missing.";
  const auto seen = [&](const std::string& line, const char* found) {
    const Verdict verdicts[] = {{missing, found}};
    return laid_out("Fitted.\n" + line, colour, verdicts);
  };
  EXPECT_EQ(seen(missing, "partly"), "Fitted.\n\x1b[1;33mGood\x1b[0m" + missing.substr(4));
  EXPECT_EQ(seen(missing, "good"), "Fitted.\n\x1b[1;32mGood\x1b[0m" + missing.substr(4));
  EXPECT_EQ(seen(missing, "bad"), "Fitted.\n\x1b[1;31mGood\x1b[0m" + missing.substr(4));
  EXPECT_EQ(seen(missing, "unknown"), "Fitted.\n" + missing);
  EXPECT_EQ(laid_out("Good: words alone", colour), "Good: words alone");
  const Screen narrow{.columns = 20, .ink = Screen::Ink::kColour, .is_terminal = true};
  const Verdict longer[] = {
      {"Something has changed, but what cannot be told: two joints", "partly"}};
  EXPECT_EQ(laid_out(longer[0].sentence, narrow, longer),
            "\x1b[1;33mSomething has\nchanged, but what\ncannot be told\x1b[0m: two\njoints");
}

}  // namespace
}  // namespace plumb

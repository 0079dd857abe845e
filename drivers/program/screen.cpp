// SPDX-License-Identifier: Apache-2.0
#include "program/screen.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <iterator>
#include <span>
#include <string_view>
#include <vector>

#include "program/wide_table.hpp"

namespace plumb {
namespace {

constexpr std::size_t kFewestColumns = 20;  // of a terminal; a smaller one counts as this wide
constexpr std::size_t kRoom = 24;           // columns for the last cell of a row, at least

constexpr std::string_view kGood = "\x1b[1;32m", kWarning = "\x1b[1;33m", kError = "\x1b[1;31m",
                           kNote = "\x1b[1;36m", kPlainAgain = "\x1b[0m";

struct WordColour {
  std::string_view words;
  std::string_view colour;
};

constexpr WordColour kActions[] = {{"Next:", kNote}};
constexpr WordColour kMessages[] = {{"error", kError}, {"warning", kWarning}, {"note", kNote}};
constexpr WordColour kClasses[] = {{"good", kGood}, {"partly", kWarning}, {"bad", kError}};

/// The line may have been broken within the words.
std::string coloured(const std::string& line, std::span<const WordColour> table) {
  std::string whole = line;
  std::replace(whole.begin(), whole.end(), '\n', ' ');
  for (const auto& [words, colour] : table)
    if (whole.starts_with(words))
      return std::string(colour) + line.substr(0, words.size()) + std::string(kPlainAgain) +
             line.substr(words.size());
  return line;
}

std::size_t characters(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

bool is_command(std::string_view line) {
  const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
  return line.find(": plumb ") != std::string_view::npos ||
         line.substr(begin).starts_with("plumb ");
}

/// The line from `begin` on, broken between words; what follows its first line begins at `further`.
std::string broken(const std::string& line, std::size_t begin, std::size_t further,
                   std::size_t columns) {
  std::string out, now = line.substr(0, begin);
  bool empty = true;
  for (std::size_t at = begin; at < line.size();) {
    const std::size_t end = std::min(line.find(' ', at), line.size());
    const std::string word = line.substr(at, end - at);
    if (!empty && characters(now) + 1 + characters(word) > columns) {
      out += now + "\n";
      now = std::string(further, ' ');
      empty = true;
    }
    now += (empty ? "" : " ") + word;
    empty = false;
    at = end + 1;
  }
  return out + now;
}

/// What follows the first line of a list's entry stands two columns further in.
std::string broken_sentence(const std::string& line, std::size_t columns) {
  const std::size_t indent = line.find_first_not_of(' ');
  return broken(line, indent, indent == 0 ? 0 : indent + 2, columns);
}

/// Only where the last cell has room for a few words beside the others.
std::string broken_row(const std::string& line, std::size_t columns) {
  const std::size_t cell = line.rfind("  ") + 2;
  const std::size_t begin = characters(line.substr(0, cell));
  return begin + kRoom > columns ? line : broken(line, cell, begin, columns);
}

std::string broken_command(const std::string& line) {
  const std::size_t comment = line.find("   # ");
  if (comment == std::string::npos) return line;
  const std::size_t end = line.find_last_not_of(' ', comment) + 1;
  return line.substr(0, end) + "\n" + std::string(6, ' ') + line.substr(comment + 3);
}

/// A command of several lines that can be pasted as it is: broken before options, which are not
/// within quotes.
std::string continued(const std::string& command, std::size_t columns) {
  std::string out, now;
  bool quoted = false;
  for (std::size_t at = 0; at < command.size();) {
    std::size_t end = at;
    do {
      quoted = quoted != (command[end] == '"');
      ++end;
    } while (end < command.size() && (quoted || command.compare(end, 2, " -") != 0));
    const std::string piece = command.substr(at, end - at);
    if (!now.empty() && characters(now) + characters(piece) + 2 > columns) {
      out += now + " \\\n";
      now = std::string(5, ' ');
    }
    now += piece;
    at = end;
  }
  return out + now;
}

/// An example of the help: its comment below it, and itself in several lines if need be.
std::string broken_example(const std::string& line, std::size_t columns) {
  const std::string apart = broken_command(line);
  const std::size_t end = std::min(apart.find('\n'), apart.size());
  std::string out = apart.substr(0, end);
  if (characters(out) > columns) out = continued(out, columns);
  if (end == apart.size()) return out;
  const std::string comment = apart.substr(end + 1);
  return out + "\n" + (characters(comment) > columns ? broken_sentence(comment, columns) : comment);
}

std::string fitted(const std::string& line, std::size_t columns) {
  const std::size_t begin = line.find_first_not_of(' ');
  if (characters(line) <= columns || begin == std::string::npos) return line;
  if (is_command(line)) return broken_command(line);
  return line.find("  ", begin) == std::string::npos ? broken_sentence(line, columns)
                                                     : broken_row(line, columns);
}

bool is_row(const std::string& line) {
  const std::size_t begin = line.find_first_not_of(' ');
  return begin != std::string::npos && begin >= 2 && line.find("  ", begin) != std::string::npos &&
         !is_command(line);
}

/// Whether a row stays wider than the screen although its last cell may be broken.
bool stays_wide(const std::string& line, std::size_t columns) {
  return characters(line) > columns && fitted(line, columns) == line;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    out.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return out;
}

/// Tables that are too wide are parted; all other lines stay as they are.
std::vector<std::string> with_parted_tables(const std::vector<std::string>& lines,
                                            std::size_t columns) {
  std::vector<std::string> out;
  for (auto begin = lines.begin(); begin != lines.end();) {
    const auto end = std::find_if_not(begin, lines.end(), is_row);
    std::vector<std::string> rows(begin, end);
    if (rows.size() > 1 &&
        std::any_of(begin, end, [&](const auto& row) { return stays_wide(row, columns); }))
      rows = parted(rows, columns, kRoom);
    out.insert(out.end(), rows.begin(), rows.end());
    begin = end;
    if (begin != lines.end()) out.push_back(*begin++);
  }
  return out;
}

/// Where a unified diff begins; the length of the text if it holds none.
std::size_t begin_of_diff(const std::string& text) {
  for (std::size_t at = text.find("\n--- "); at != std::string::npos;
       at = text.find("\n--- ", at + 1))
    if (text.compare(std::min(text.find('\n', at + 1), text.size()), 5, "\n+++ ") == 0)
      return at + 1;
  return text.size();
}

std::size_t columns_of(int descriptor) {
  std::size_t columns = 0;
  if (const char* told = std::getenv("COLUMNS"); told != nullptr) {
    const std::string_view text(told);
    std::from_chars(text.data(), text.data() + text.size(), columns);
  }
  winsize size{};
  if (columns == 0 && ::ioctl(descriptor, TIOCGWINSZ, &size) == 0) columns = size.ws_col;
  return columns == 0 ? Screen{}.columns : std::max(columns, kFewestColumns);
}

Screen::Ink ink_of(int descriptor) {
  const char* const no = std::getenv("NO_COLOR");
  const char* const term = std::getenv("TERM");
  const bool plain = (no != nullptr && *no != '\0') || term == nullptr ||
                     std::string_view(term) == "dumb" || ::isatty(descriptor) == 0;
  return plain ? Screen::Ink::kPlain : Screen::Ink::kColour;
}

}  // namespace

Screen screen_of(int descriptor) {
  return {columns_of(descriptor), ink_of(descriptor), ::isatty(descriptor) != 0};
}

std::string laid_out(const std::string& whole_text, const Screen& screen,
                     std::span<const Verdict> verdicts) {
  const std::size_t diff = begin_of_diff(whole_text);
  const std::string text = whole_text.substr(0, diff);
  std::vector<WordColour> beginnings(std::begin(kActions), std::end(kActions));
  for (const Verdict& verdict : verdicts)
    for (const auto& [name, colour] : kClasses)
      if (!verdict.sentence.empty() && name == verdict.found)
        beginnings.push_back(
            {std::string_view(verdict.sentence).substr(0, verdict.sentence.find(':')), colour});
  std::string out;
  for (const std::string& whole : with_parted_tables(lines_of(text), screen.columns)) {
    const std::string line = fitted(whole, screen.columns);
    out += (screen.ink == Screen::Ink::kColour ? coloured(line, beginnings) : line) + "\n";
  }
  if (!out.empty() && !text.ends_with('\n')) out.pop_back();
  return out + whole_text.substr(diff);
}

std::string laid_out_help(const std::string& help, const Screen& screen) {
  std::string out;
  for (const std::string& line : lines_of(help)) {
    const std::size_t begin = line.find_first_not_of(' ');
    const bool fits = begin == std::string::npos || characters(line) <= screen.columns;
    out += (fits ? line
            : begin == 2 && line.substr(begin).starts_with("plumb")
                ? broken_example(line, screen.columns)
            : line.find("  ", begin) == std::string::npos ? broken_sentence(line, screen.columns)
                                                          : broken_row(line, screen.columns)) +
           "\n";
  }
  return out;
}

std::string painted(const std::string& message, const Screen& screen) {
  std::string out = message;
  if (screen.is_terminal) {
    const std::size_t end = std::min(message.find('\n'), message.size());
    const std::string first = message.substr(0, end);
    if (characters(first) > screen.columns)
      out = broken(first, 0, 2, screen.columns) + message.substr(end);
  }
  return screen.ink == Screen::Ink::kColour ? coloured(out, kMessages) : out;
}

}  // namespace plumb

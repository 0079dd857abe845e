// SPDX-License-Identifier: Apache-2.0
// The transcripts of docs/tour.md, replayed: every "$ ..." line of its blocks is run, and what
// follows it must come out. "..." stands for left-out lines; numbers may differ in their last
// digits, because compilers round differently.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "sandbox.hpp"

namespace {

namespace fs = std::filesystem;
using Lines = std::vector<std::string>;

struct Shown {
  int line = 0;  // of the page
  std::string command;
  Lines output;
};
using Block = std::vector<Shown>;

/// Blocks between ``` that begin with a command.
std::vector<Block> blocks_of(const fs::path& page) {
  std::vector<Block> out;
  std::ifstream in(page);
  bool inside = false, shows = false;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.starts_with("```")) {
      inside = !inside;
      shows = false;
      continue;
    }
    if (!inside) continue;
    const bool command = line.starts_with("$ ");
    if (command && !shows) out.emplace_back();
    shows = shows || command;
    if (!shows) continue;
    if (command)
      out.back().push_back({number, line.substr(2), {}});
    else if (!out.back().back().command.empty() && out.back().back().command.back() == '\\')
      (out.back().back().command.back() = '\n', out.back().back().command += line);
    else
      out.back().back().output.push_back(line);
  }
  return out;
}

/// What is said of work that takes more than a second: on a slow machine more often.
bool is_progress(const std::string& line) {
  return line.ends_with(" ...") && line.find_first_not_of(" ") == 0 && std::islower(line[0]) != 0;
}

/// stdout and stderr together, as on a screen.
Lines run(const fs::path& folder, std::string command) {
  for (std::size_t at = 0; (at = command.find("\n", at)) != std::string::npos;) command[at] = ' ';
  const std::string line = "cd '" + folder.string() + "' && PATH='" +
                           fs::path(PLUMB_PROGRAM).parent_path().string() + "':$PATH && { " +
                           command + " ; } 2>&1";
  Lines out;
  std::FILE* pipe = ::popen(line.c_str(), "r");
  std::string all;
  char buffer[4096];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, pipe)) all.append(buffer, n);
  EXPECT_EQ(::pclose(pipe), 0) << command << "\n" << all;
  std::istringstream in(all);
  for (std::string text; std::getline(in, text);)
    if (!is_progress(text)) out.push_back(text);
  return out;
}

/// Words, with signs and brackets apart from numbers.
Lines words_of(const std::string& line) {
  Lines out(1);
  for (const char c : line) {
    if (c == ' ' || c == ',' || c == '(' || c == ')' || c == '#')
      out.emplace_back();
    else
      out.back() += c;
  }
  std::erase(out, "");
  return out;
}

bool same_word(const std::string& shown, const std::string& real) {
  if (shown == real) return true;
  char* end = nullptr;
  const double a = std::strtod(shown.c_str(), &end);
  if (end == shown.c_str()) return false;
  const std::string unit(end);
  char* real_end = nullptr;
  const double b = std::strtod(real.c_str(), &real_end);
  if (real_end == real.c_str() || unit != real_end) return false;
  return std::abs(a - b) <= 0.03 * std::abs(a) + 0.002;
}

bool same_line(const std::string& shown, const std::string& real) {
  const Lines a = words_of(shown), b = words_of(real);
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same_word);
}

/// Whether `real` reads as shown, "..." standing for any lines. `far`: how much of it did.
bool reads_as(const Lines& shown, std::size_t i, const Lines& real, std::size_t k,
              std::size_t& far) {
  if (i < shown.size() && shown[i] != "..." && shown[i] != "  ...") far = std::max(far, i);
  if (i == shown.size()) return k == real.size();
  if (shown[i] == "..." || shown[i] == "  ...") {
    for (std::size_t next = k; next <= real.size(); ++next)
      if (reads_as(shown, i + 1, real, next, far)) return true;
    return false;
  }
  return k < real.size() && same_line(shown[i], real[k]) &&
         reads_as(shown, i + 1, real, k + 1, far);
}

Lines without_blank(Lines lines) {
  std::erase_if(
      lines, [](const std::string& l) { return l.find_first_not_of(" \t") == std::string::npos; });
  return lines;
}

TEST(Tour, ShowsWhatHappens) {
  const Sandbox box;
  int commands = 0;
  for (const auto& block : blocks_of(PLUMB_TOUR)) {
    const fs::path raw = PLUMB_RAW_DATA;
    if (block.front().command.find("series_A_grid.csv") != std::string::npos) {
      if (!fs::exists(raw / "series_A_grid.csv")) continue;  // not beside this checkout
      fs::copy_file(raw / "series_A_grid.csv", box.path() / "series_A_grid.csv");
    }
    for (const auto& shown : block) {
      const Lines expected = without_blank(shown.output);
      const Lines real = without_blank(run(box.path(), shown.command));
      std::size_t far = 0;
      if (!reads_as(expected, 0, real, 0, far)) {
        std::ostringstream all;
        for (const auto& line : real) all << line << "\n";
        ADD_FAILURE() << "docs/tour.md:" << shown.line << ": $ " << shown.command
                      << "\nnot found: " << (far < expected.size() ? expected[far] : "(more lines)")
                      << "\nin:\n"
                      << all.str();
      }
      ++commands;
    }
  }
  EXPECT_GE(commands, 8);
}

TEST(Tour, ComparesLinesThatDiffer) {
  EXPECT_TRUE(same_line("mean 0.164 mm", "mean  0.163 mm"));
  EXPECT_FALSE(same_line("mean 0.164 mm", "mean 0.264 mm"));
  EXPECT_FALSE(same_line("mean 0.164 mm", "mean 0.164 um"));
  std::size_t far = 0;
  EXPECT_TRUE(reads_as({"a", "...", "c"}, 0, {"a", "b", "b", "c"}, 0, far));
  far = 0;
  EXPECT_FALSE(reads_as({"a", "...", "c"}, 0, {"a", "b", "d"}, 0, far));
  EXPECT_EQ(far, 2U);  // "c" is what was not found
}

}  // namespace

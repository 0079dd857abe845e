// SPDX-License-Identifier: Apache-2.0
// A result is rendered once: what a verb prints on a terminal are the blocks of its JSON, all of
// them, in their order, and the report says them too.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "sandbox.hpp"

namespace {

using Json = nlohmann::ordered_json;
using Words = std::vector<std::string>;

/// Without the blanks and the breaks of lines, which every medium sets in its own way.
std::string bare(std::string text) {
  std::erase_if(text, [](unsigned char c) { return std::isspace(c) != 0; });
  return text;
}

/// What is read of a terminal's text, piece by piece.
class Reading {
 public:
  explicit Reading(const std::string& text) : left_(bare(text)) {}

  bool next(const std::string& words) {
    const std::string piece = bare(words);
    if (!left_.starts_with(piece)) return false;
    left_.erase(0, piece.size());
    return true;
  }
  void say(const std::string& words) {
    EXPECT_TRUE(next(words)) << "wanted: " << words << "\nread: " << left_.substr(0, 200);
  }
  const std::string& left() const { return left_; }

 private:
  std::string left_;
};

/// A table has its heads above the columns, or within its lines.
void read_table(const Json& table, Reading& text) {
  const auto head = table.at("head").get<Words>();
  if (table.at("rows").empty()) return;
  text.next(table.at("caption"));
  std::string heads;
  for (const auto& word : head) heads += word;
  const bool as_lines = !text.next(heads);
  for (const auto& row : table.at("rows"))
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (as_lines && k > 0 && row[k] != "") text.next(k == 1 ? ":" : ";" + head.at(k));
      text.say(row[k]);
    }
}

class BlocksOf : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    box = new Sandbox;
    ASSERT_EQ(box->plumb({"demo", "compliance", "cell"}).exit, 0);
    ASSERT_EQ(box->plumb({"-C", "cell", "fit"}).exit, 0);
  }
  static void TearDownTestSuite() { delete box; }

  static Words in_cell(Words words, const Words& more = {}) {
    words.insert(words.begin(), {"-C", "cell"});
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  static Json blocks(const Words& words) {
    const Ran ran = box->plumb(in_cell(words, {"--json"}));
    EXPECT_EQ(ran.exit, 0) << ran.err;
    return ran.json().at("result").at("blocks");
  }

  /// The text says the blocks and nothing else before the lines that tell what was written.
  static void agree(const Words& words) {
    SCOPED_TRACE(words.front());
    const Json all = blocks(words);
    Reading text(box->plumb(in_cell(words)).out);
    int sentences = 0, tables = 0;
    for (const auto& block : all) {
      const std::string kind = block.at("kind");
      sentences += kind == "sentence";
      tables += kind == "table";
      if (kind == "sentence" || kind == "note") text.say(block.at("words"));
      if (kind == "table") read_table(block, text);
      if (kind != "action") continue;
      const std::string typed = block.at("command").get<std::string>();
      EXPECT_NE(text.left().find(bare("plumb -C cell " + typed.substr(6))), std::string::npos)
          << typed << "\n"
          << text.left();
    }
    EXPECT_GT(sentences, 0);
    EXPECT_GT(tables, 0);
    const std::regex behind(
        "^(|keptasrun.*|norunwaskept:.*|dryrun:.*|plan.*|wouldwrite.*|Next:.*)$");
    EXPECT_TRUE(std::regex_match(text.left(), behind)) << text.left();
  }

  static Sandbox* box;
};
Sandbox* BlocksOf::box = nullptr;

TEST_F(BlocksOf, EveryResultAreWhatTheTerminalShows) {
  agree({"fit", "--dry-run"});
  agree({"compare"});
  agree({"check"});
  agree({"diagnose"});
  agree({"plan", "--n", "5", "--pool", "100", "--dry-run"});
  agree({"plan", "--recheck", "--dry-run"});
  agree({"plan", "--separate", "reversal:J2,settling_lag:J2", "--n", "5", "--pool", "100",
         "--dry-run"});
}

TEST_F(BlocksOf, ARecheckAreWhatTheTerminalShows) {
  const std::string all = box->read("cell/measurements.csv");
  std::string header, kept, today;
  std::istringstream in(all);
  int row = 0;
  for (std::string line; std::getline(in, line);) {
    const bool of_today = !header.empty() && row++ % 20 == 3;
    if (line.front() != '#' && header.empty()) today = (header = line) + "\n";
    (of_today ? today : kept) += line + "\n";
  }
  box->write("cell/measurements.csv", kept);
  box->write("today.csv", today);
  agree({"recheck", "--data", "today.csv", "--dry-run"});
  agree({"recheck", "--data", "today.csv", "--dry-run", "--new-frame"});
  box->write("cell/measurements.csv", all);
}

TEST_F(BlocksOf, OfSeveralRunsTheTerminalListsThemFirst) {
  ASSERT_EQ(box->plumb(in_cell({"fit", "--held-out", "20%"})).exit, 0);
  agree({"compare", "1", "2"});
  EXPECT_EQ(blocks({"compare", "1", "2"}).at(1).at("name"), "runs");
}

/// The words of a page, without its elements.
std::string words_of(std::string html) {
  html = std::regex_replace(html, std::regex("<[^>]*>"), "");
  for (const auto& [name, sign] : std::initializer_list<std::pair<const char*, const char*>>{
           {"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&#39;", "'"}, {"&amp;", "&"}})
    html = std::regex_replace(html, std::regex(name), sign);
  return bare(html);
}

TEST_F(BlocksOf, AComparisonStandInTheReport) {
  ASSERT_EQ(box->plumb(in_cell({"report", "-o", "report.html"})).exit, 0);
  const std::string page = words_of(box->read("report.html"));
  for (const auto& block : blocks({"compare"})) {
    EXPECT_NE(page.find(bare(block.value("words", ""))), std::string::npos) << block;
    for (const auto& row : block.value("rows", Json::array())) {
      EXPECT_NE(page.find(bare(block.at("caption"))), std::string::npos) << block;
      for (const auto& cell : row)
        EXPECT_NE(page.find(bare(cell)), std::string::npos) << block.at("name") << " " << cell;
    }
  }
}

TEST_F(BlocksOf, AComparisonSayWhereItFailsAsTheFindingDoes) {
  const Json result = box->plumb(in_cell({"compare", "--json"})).json().at("result");
  const Json& where = result.at("finding").at("where");
  EXPECT_EQ(result.at("where"), where);
  EXPECT_EQ(std::count_if(result.at("blocks").begin(), result.at("blocks").end(),
                          [&](const Json& block) { return block.value("words", "") == where; }),
            1);
}

}  // namespace

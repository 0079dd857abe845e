// SPDX-License-Identifier: Apache-2.0
#include "cell/codes.hpp"

#include <regex>
#include <set>

#include "program/file.hpp"
#include "support.hpp"

namespace plumb::offline {
namespace {

namespace fs = std::filesystem;

std::set<std::string> codes_in(const fs::path& folder) {
  static const std::regex code("\"([EWN]-[A-Z0-9-]+)\"");
  static const std::regex of_table(R"-(source_->code\("([A-Z]+)"\))-");
  std::set<std::string> out;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".cpp" || entry.path().filename() == "codes.cpp") continue;
    const std::string text = read_file(entry.path());
    for (std::sregex_iterator i(text.begin(), text.end(), code), end; i != end; ++i)
      out.insert((*i)[1]);
    for (std::sregex_iterator i(text.begin(), text.end(), of_table), end; i != end; ++i)
      out.insert("E-CELL-" + (*i)[1].str());
  }
  return out;
}

TEST(Codes, AreAllExplainedAndAllEmitted) {
  auto emitted = codes_in(fs::path(PLUMB_SOURCE_DIR) / "offline" / "cell");
  emitted.merge(codes_in(fs::path(PLUMB_SOURCE_DIR) / "drivers" / "program"));
  for (const char* elsewhere :
       {"E-USAGE", "E-USAGE-VERB", "E-INTERRUPTED", "E-FILES", "E-MEMORY", "E-KEY", "E-KEY-RIGHTS"})
    emitted.erase(elsewhere);  // of the verbs, explained in the catalogue
  std::set<std::string> explained;
  for (const auto& help : cell_codes()) explained.emplace(help.code);
  EXPECT_EQ(emitted, explained);
  EXPECT_GT(emitted.size(), 40u);
}

TEST(Codes, AreSortedAndSayEnough) {
  std::string_view before;
  for (const auto& help : cell_codes()) {
    EXPECT_LT(before, help.code);
    EXPECT_GT(help.text.size(), 40u) << help.code;
    EXPECT_TRUE(help.text.ends_with('.')) << help.code;
    EXPECT_EQ(find_code(help.code), &help);
    before = help.code;
  }
  EXPECT_EQ(find_code("E-NONE"), nullptr);
}

/// Every code of a message appears in some test of this folder, its explanation apart.
TEST(Codes, AreEachTested) {
  const fs::path folder = fs::path(PLUMB_SOURCE_DIR) / "tests" / "cell";
  std::string tests;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".cpp") tests += read_file(entry.path());
  for (const auto& help : cell_codes()) {
    if (help.code == "E-BUG") continue;  // cannot happen
    EXPECT_NE(tests.find('"' + std::string(help.code)), std::string::npos) << help.code;
  }
}

}  // namespace
}  // namespace plumb::offline

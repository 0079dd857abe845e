// SPDX-License-Identifier: Apache-2.0
#include "program/toml_inline.hpp"

#include "cell/cell.hpp"
#include "program/utf8.hpp"
#include "support.hpp"

namespace plumb::offline {
namespace {

TEST(InlineTable, OfToml10ComesBackUnchanged) {
  const std::string text =
      "a = \"{\\\"\" # {\nb = '{' \nc = { d = [1,\n# { comment\n2], e = \"\"\"{\n\"x\" \"\"\" }\n"
      "[t.\"{\"]\nf = '''\n{ '' '''\ng = [{h = 1},\n{h = 2},]\n";
  EXPECT_EQ(join_inline_tables(text), text);
}

TEST(InlineTable, MayRunOverLinesHoldCommentsAndEndWithAComma) {
  EXPECT_EQ(join_inline_tables("a = { b = 1, # \xC3\xB6\n c = [\n2], }\n"),
            "a = { b = 1,      c = [\n2]  }\n");
}

TEST(InlineTable, KeepsTheNumberOfCharactersWhateverTheText) {
  const std::string text =
      "a = { \"b\" = 'x', # \xE2\x82\xAC {\r\n c = { d = \"\"\"\n\"\"\" ,} , }\n{ ' \" \n }";
  for (std::size_t i = 0; i <= text.size(); ++i) {
    const auto part = text.substr(0, i);
    EXPECT_EQ(count_characters(join_inline_tables(part)), count_characters(part));
  }
}

TEST(InlineTable, OfSeveralLinesKeepsThePlacesOfProblems) {
  const Folder folder;
  const auto file =
      folder.put("cell.toml",
                 "schema = \"cell/1\"\n[robot]\ndh_convention = \"modified\"\njoints = [\n"
                 "  { name = \"J1\",   # \xC3\xA4 comment\n    alpah = 1,\n    q = [-1, 1] },\n]\n"
                 "foo = 1\n");
  EXPECT_EQ(summary(problems_of([&] { read_cell(file); })),
            (Summary{"E-CELL-KEY 6:5", "E-CELL-KEY 9:1"}));
}

}  // namespace
}  // namespace plumb::offline

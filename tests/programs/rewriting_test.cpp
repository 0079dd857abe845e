// SPDX-License-Identifier: Apache-2.0
#include "programs/rewriting.hpp"

#include "programs/written.hpp"
#include "tests/programs/corpus.hpp"

namespace plumb::offline::programs {
namespace {

/// Every target of a program moved by (0.126, -0.126, 0.126) mm, or as many of its units.
std::vector<Edit> moved(const Program& program, const Decimals& decimals) {
  std::vector<Edit> out;
  for (const Target& target : program.targets) {
    if (!target.why.empty() || of_joints(target.written.notation)) continue;
    auto values = values_of(target.written);
    for (std::size_t i = 0; i < 3; ++i) values[i] += i == 1 ? -0.126 : 0.126;
    const auto made = new_digits(program, target, values, decimals);
    out.insert(out.end(), made.edits.begin(), made.edits.end());
  }
  return out;
}

/// The bytes without what numbers are made of.
std::string skeleton(const std::string& bytes) {
  std::string out;
  for (const char c : bytes)
    if ((c < '0' || c > '9') && c != '.' && c != '-') out += c;
  return out;
}

TEST(Rewriting, OnlyTheDigitsOfTargetsChangeWhateverTheLineEndsAndTheCodePage) {
  for (const auto& [file, data] : std::vector<std::pair<std::string, std::string>>{
           {"traps.mod", ""}, {"TRAPS.LS", ""}, {"traps.src", "traps.dat"}, {"traps.script", ""}}) {
    std::string bytes = corpus(file);
    std::string returns;
    for (const char c : bytes) returns += c == '\n' ? std::string("\r\n") : std::string(1, c);
    returns += "  \t\xE9\x80\xFF no end of line";
    for (const std::string& text : {bytes, returns}) {
      const Program p = read_bytes(file, text, data.empty() ? "" : corpus(data));
      const Decimals decimals = decimals_of(p, 3);
      const auto edits = moved(p, decimals);
      EXPECT_GE(edits.size(), 6U) << file;
      const auto now = edited(p, edits);
      for (std::size_t s = 0; s < now.size(); ++s) {
        EXPECT_EQ(skeleton(now[s]), skeleton(p.sources[s].bytes)) << file;
        EXPECT_NE(now[s], p.sources[s].bytes) << file;
      }
      std::vector<Source> again;
      for (std::size_t s = 0; s < now.size(); ++s) again.push_back({p.sources[s].file, now[s]});
      const Program q = read_programs(*language_of(file), {again}).at(0);
      ASSERT_EQ(q.targets.size(), p.targets.size());
      for (std::size_t t = 0; t < q.targets.size(); ++t) {
        const auto before = values_of(p.targets[t].written),
                   after = values_of(q.targets[t].written);
        const bool free = p.targets[t].why.empty() && !of_joints(p.targets[t].written.notation);
        ASSERT_EQ(before.size(), after.size());
        for (std::size_t i = 0; i < after.size(); ++i)
          EXPECT_NEAR(after[i] - before[i], free && i < 3 ? (i == 1 ? -0.126 : 0.126) : 0.0, 1e-3)
              << file << " " << p.targets[t].name;
        EXPECT_EQ(p.targets[t].why.empty(), q.targets[t].why.empty());
      }
    }
  }
}

TEST(Rewriting, WhatIsChangedByLessThanTheDigitsShowStaysByteForByte) {
  const Program p = read_corpus("traps.mod");
  const Target& target = named(p, "good2");
  auto values = values_of(target.written);
  for (double& value : values) value += 0.0004;
  const auto made = new_digits(p, target, values, decimals_of(p, 0));
  EXPECT_TRUE(made.edits.empty());
  EXPECT_EQ(made.written, values_of(target.written));
}

TEST(Rewriting, TheCopyInTheCommentOfAFoldChangesWithItsMoveAndNoOtherComment) {
  const Program p = read_corpus("traps.src", "traps.dat");
  const std::string now = edited(p, moved(p, decimals_of(p, 3)))[0];
  std::size_t count = 0;
  for (std::size_t at = now.find("X 1420.626,Y 9.874,Z 900.126,A 0,B 170,C 5,S 2,T 8");
       at != std::string::npos; at = now.find("X 1420.626,Y 9.874", at + 1))
    ++count;
  EXPECT_EQ(count, 2U) << now;
  EXPECT_NE(now.find("; a comment keeps {X 1420.5,Y 10,Z 900"), std::string::npos);
}

TEST(Rewriting, TheMarkIsACommentOfTheLanguageAndIsFoundAgain) {
  for (const auto& [file, before] : std::map<std::string, std::string>{
           {"traps.mod",
            "MODULE Traps\n! plumb filter: targets corrected\n! model Zelle ?\n! sha256 0123"},
           {"TRAPS.LS",
            "/MN\n   1:  !plumb filter: targets corrected ;\n   1:  !model Zelle ? ;\n   1:  "
            "!sha256 0123"},
           {"traps.src",
            "DEF traps( )\n; plumb filter: targets corrected\n; model Zelle ?\n; sha256 0123"},
           {"traps.script", "# plumb filter: targets corrected\n# model Zelle ?\n# sha256 0123"}}) {
    const std::string bytes = corpus(file), hash = "0123" + std::string(60, 'a');
    EXPECT_EQ(line_of_mark(bytes), 0);
    const std::string now = marked(*language_of(file), bytes, {"Zelle \xC3\xA9", hash});
    EXPECT_NE(now.find(before), std::string::npos) << now.substr(0, 300);
    EXPECT_GT(line_of_mark(now), 0);
    const Program p = read_bytes(file, bytes), q = read_bytes(file, now);
    EXPECT_EQ(p.targets.size(), q.targets.size()) << file;
    EXPECT_EQ(free_targets(p), free_targets(q)) << file;
  }
  EXPECT_NE(marked(*language_of("x.mod"), "MODULE m\r\nENDMODULE\r\n", {"m", "0"})
                .find("MODULE m\r\n! plumb filter: targets corrected\r\n"),
            std::string::npos);
}

TEST(Rewriting, AByteOrderMarkStaysTheFirstOfAll) {
  for (const std::string file : {"traps.mod", "TRAPS.LS", "traps.src", "traps.script"}) {
    const std::string bytes = "\xEF\xBB\xBF" + corpus(file);
    EXPECT_EQ(free_targets(read_bytes(file, bytes)), free_targets(read_corpus(file)));
    const std::string plain = marked(*language_of(file), corpus(file), {"m", "0"});
    EXPECT_EQ(marked(*language_of(file), bytes, {"m", "0"}), "\xEF\xBB\xBF" + plain) << file;
  }
}

TEST(Rewriting, ADiffShowsTheChangedLinesWithThreeAroundThem) {
  const std::string before = "MODULE m\na\nb\nc\nd\ne 1\nf\ng\nh\ni";
  const std::string after =
      "MODULE m\n! plumb filter: targets corrected\na\nb\nc\nd\ne 2\nf\ng\nh\ni";
  EXPECT_EQ(unified_diff("m.mod", before, after),
            "--- m.mod\n+++ m.mod\n@@ -1,9 +1,10 @@\n MODULE m\n+! plumb filter: targets "
            "corrected\n a\n b\n c\n d\n-e 1\n+e 2\n f\n g\n h\n");
  EXPECT_EQ(unified_diff("m.mod", before, before), "");
}

}  // namespace
}  // namespace plumb::offline::programs

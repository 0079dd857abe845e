// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdio>
#include <random>

#include "programs/lexer.hpp"
#include "programs/rewriting.hpp"
#include "programs/settle.hpp"
#include "programs/written.hpp"
#include "tests/programs/corpus.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::offline::programs {
namespace {

/// Which targets a filter could correct: their tool and frame are known too.
std::set<std::string> known(const Program& program) {
  std::set<std::string> out;
  for (const Target& target : program.targets) {
    const auto tool = program.tools.find(target.tool);
    const auto frame = program.frames.find(target.frame);
    if (target.why.empty() && !target.external_axes && pose_of(target.written) &&
        tool != program.tools.end() && tool->second.X && frame != program.frames.end() &&
        frame->second.X)
      out.insert(target.name);
  }
  return out;
}

std::size_t others(const Program& program) {
  return program.targets.size() - known(program).size();
}

using Names_ = std::set<std::string>;

TEST(Readers, NoTrapIsTakenForATargetThatCanBeCorrected) {
  const Program rapid = read_corpus("traps.mod");
  EXPECT_EQ(known(rapid), (Names_{"good1", "good2", "good3", "target of the move"}));
  EXPECT_EQ(known(read_corpus("displaced.prg")), Names_{});
  const Program krl = read_corpus("traps.src", "traps.dat");
  EXPECT_EQ(known(krl), (Names_{"XP1", "XP2", "XP3", "XP4", "target of the move"}));
  const Program ur = read_corpus("traps.script");
  EXPECT_EQ(known(ur), (Names_{"good_p", "target of the move"}));
  Program fanuc = read_corpus("TRAPS.LS");
  EXPECT_EQ(known(fanuc), Names_{}) << "the file itself states no frames";
  fanuc.tools.emplace("1", Frame{Transformd(), ""});
  fanuc.frames.emplace("1", Frame{Transformd(), ""});
  EXPECT_EQ(known(fanuc), (Names_{"P[1]", "P[2]", "P[3]", "P[4]"}));
  const std::size_t traps = others(rapid) + others(krl) + others(ur) + others(fanuc);
  std::printf("%zu traps\n", traps);
  EXPECT_GE(traps, 50U);
}

TEST(Readers, EveryTrapIsListedWithItsLineAReasonAndWhatToDo) {
  for (const auto& program : {read_corpus("traps.mod"), read_corpus("TRAPS.LS"),
                              read_corpus("traps.src", "traps.dat"), read_corpus("traps.script")})
    for (const Target& target : program.targets) {
      EXPECT_GT(target.line, 0) << target.name;
      EXPECT_EQ(target.why.empty(), target.help.empty()) << target.name;
      EXPECT_FALSE(target.why.empty() && target.written.numbers.empty()) << target.name;
    }
}

TEST(Readers, SayWhyATrapIsNotTouched) {
  const Program p = read_corpus("traps.mod");
  for (const auto& [name, words] : std::map<std::string, std::string>{
           {"trapAssigned", "line 38 uses it"},
           {"trapComponent", "line 40 uses it"},
           {"trapTwoTools", "two tools"},
           {"trapTwoFrames", "two frames"},
           {"trapRead", "line 47 uses it"},
           {"trapComputed", "plain numbers"},
           {"trapUnused", "no move"},
           {"trapSearched", "line 51 uses it"},
           {"trapTwice", "declared more than once"},
           {"trapArray", "plain numbers"},
           {"trapParameter", "plain numbers"},
           {"Offs(trapOffset,0,0,50)", "offset of another"},
           {"RelTool(trapOffset,0,0,50 \\Rz:=10)", "offset of another"},
           {"trapArray{1}", "computed"},
           {"pElsewhere", "does not state"}})
    EXPECT_NE(named(p, name).why.find(words), std::string::npos)
        << name << ": " << named(p, name).why;
  EXPECT_EQ(p.tools.at("tmoved").why, "line 52 uses it for something else than a move");
  EXPECT_NE(named(p, "trapCorr").why.find("\\Corr"), std::string::npos);
  EXPECT_TRUE(named(p, "trapExternal").external_axes);
  EXPECT_EQ(named(p, "trapFrameChosen").frame, "(computed)");
  EXPECT_NE(named(p, "trapNamed").why.find("line 67 uses it"), std::string::npos);
  EXPECT_EQ(named(read_corpus("displaced.prg"), "trapA").why,
            "PDispOn in displaced.prg:4 moves all targets while the program runs");
}

TEST(Readers, RapidTargetsHaveTheirNumbersConfigurationToolAndFrame) {
  const Program p = read_corpus("traps.mod");
  const Target& t = named(p, "good3");
  EXPECT_EQ(t.line, 10);
  EXPECT_EQ(values_of(t.written), (std::vector<double>{1.1, 2, 880, 0, 0, 1, 0}));
  EXPECT_EQ(t.tool, "tgun");
  EXPECT_EQ(t.frame, "wtable");
  EXPECT_NEAR((p.frames.at("wtable").X->p - Vector3(1.3, 0.1, 0.02)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((p.tools.at("tgun").X->p - Vector3(0.01, 0.0, 0.15)).norm(), 0.0, 1e-15);
  ASSERT_EQ(t.configuration.ranges.size(), 4U);
  EXPECT_EQ(t.configuration.ranges[1].joint, 3);
  EXPECT_EQ(t.configuration.ranges[1].high_deg, 90.0);
  EXPECT_TRUE(*t.configuration.front && *t.configuration.elbow_front);
  int linear = 0, via = 0, ends = 0;
  for (const Move& move : p.moves) {
    linear += move.motion == Motion::kLinear ? 1 : 0;
    via += move.motion == Motion::kVia ? 1 : 0;
    ends += move.motion == Motion::kCircleEnd ? 1 : 0;
  }
  EXPECT_GT(linear, 20);
  EXPECT_EQ(via, 1);
  EXPECT_EQ(ends, 1);
}

TEST(Readers, FanucPositionsHaveTheirFramesAndCircularMovesTwoPoints) {
  const Program p = read_corpus("TRAPS.LS");
  const Target& t = named(p, "P[1]");
  EXPECT_EQ(values_of(t.written), (std::vector<double>{1400, 0.125, 900, 175, 5, -0.5}));
  EXPECT_EQ(t.tool + "/" + t.frame, "1/1");
  EXPECT_TRUE(t.configuration.ranges.empty());  // what F and the turns say is not read
  EXPECT_TRUE(*t.configuration.front && *t.configuration.elbow_front);
  EXPECT_TRUE(named(p, "P[16]").external_axes);
  EXPECT_EQ(named(p, "P[11]").tool, "default");
  EXPECT_TRUE(of_joints(named(p, "P[13]").written.notation));
  EXPECT_NE(named(p, "P[5]").why.find("offset"), std::string::npos);
  EXPECT_NE(named(p, "P[8]").why.find("line 21"), std::string::npos) << named(p, "P[8]").why;
  EXPECT_NE(named(p, "P[10]").why.find("not taught"), std::string::npos);
  EXPECT_FALSE(p.tools.at("2").X);
  ASSERT_GE(p.moves.size(), 4U);
  EXPECT_EQ(p.moves[0].motion, Motion::kJoint);
  EXPECT_EQ(p.moves[2].motion, Motion::kVia);
  EXPECT_EQ(p.moves[3].motion, Motion::kCircleEnd);
  EXPECT_EQ(p.targets[static_cast<std::size_t>(p.moves[3].target)].name, "P[4]");
}

TEST(Readers, KrlMovesHaveTheToolAndBaseOfTheirInlineForm) {
  const Program p = read_corpus("traps.src", "traps.dat");
  const Target& t = named(p, "XP1");
  EXPECT_EQ(t.source, 1U);
  EXPECT_EQ(values_of(t.written), (std::vector<double>{1400, 10, 900, 0, 170, 5}));
  EXPECT_EQ(t.tool + "/" + t.frame, "1/0");
  EXPECT_EQ(named(p, "XP4").frame, "3");
  EXPECT_NEAR(p.frames.at("3").X->p(0), 0.1, 1e-15);
  EXPECT_NEAR(p.frames.at("3").X->R(1, 0), std::sin(10.0 * 3.14159265358979 / 180.0), 1e-12);
  EXPECT_TRUE(*t.configuration.elbow_front);
  EXPECT_EQ(t.configuration.ranges[3].high_deg, 0.0);  // T 8: axis 4 negative
  const Target& in_fold = named(p, "target of the move");
  EXPECT_EQ(in_fold.copies.size(), 6U) << "the comment of the fold holds it once more";
  EXPECT_EQ(named(p, "XTRAPTOOL").tool, "(computed)");
  EXPECT_EQ(named(p, "XTRAPBASE").frame, "(computed)");
}

TEST(Readers, UrscriptMovesKnowTheToolThatWasSetLast) {
  const Program p = read_corpus("traps.script");
  const Target& t = named(p, "good_p");
  EXPECT_EQ(t.line, 4);
  EXPECT_EQ(t.written.notation, Notation::kVector);
  EXPECT_NEAR(p.tools.at(t.tool).X->p(2), 0.15, 1e-15);
  bool near = false;
  for (const Move& move : p.moves)
    near = near || (move.joints_deg.size() == 6 && std::abs(move.joints_deg[1] + 85.9437) < 1e-3);
  EXPECT_TRUE(near) << "qnear says where the joints are";
  EXPECT_FALSE(p.tools.at(named(p, "trap_tool_p").tool).X);
}

TEST(Readers, TellALanguageByTheEndingOfTheName) {
  EXPECT_EQ(language_of("a/B.MOD")->name, "RAPID");
  EXPECT_EQ(language_of("x.Ls")->name, "Fanuc LS");
  EXPECT_EQ(language_of("x.dat")->name, "KRL");
  for (const char* const file : {"x", "x.tp", ".mod", "mod", "x.mo", "x.mod.", ""})
    EXPECT_EQ(language_of(file), nullptr) << file;
  EXPECT_EQ(known_endings(), ".mod, .prg, .ls, .src, .dat, .script");
}

TEST(Readers, AToolThatStandsInTheCellIsNotTakenForOneOfTheArm) {
  const std::string data =
      "DEFDAT x\nDECL E6POS XP1={X 1,Y 2,Z 3,A 0,B 0,C 0}\n"
      "DECL FDAT FP1={TOOL_NO 1,BASE_NO 0,IPO_FRAME #TCP}\nENDDAT\n";
  EXPECT_EQ(read_bytes("x.src", "DEF x()\nFDAT_ACT=FP1\nLIN XP1\nEND\n", data).targets[0].tool,
            "(the tool stands in the cell)");
  EXPECT_EQ(read_bytes("x.src", "DEF x()\nBAS(#TOOL,1)\n$IPO_MODE=#TCP\nLIN XP1\nEND\n", data)
                .targets[0]
                .tool,
            "(the tool stands in the cell)");
  EXPECT_EQ(read_bytes("x.src", "DEF x()\nBAS(#TOOL,1)\nLIN XP1\nEND\n", data).targets[0].tool,
            "1");
}

TEST(Lexer, NumbersHaveTheirSignAndTheirPlace) {
  const Source source{"x", "a := -1.5E-3, +.25 - 4 \"7\" 9E999"};
  const Tokens tokens(source, 0, {.comments = {"!"}});
  std::vector<double> found;
  for (std::size_t i = 0; i < tokens.size();) {
    if (const auto number = tokens.number(i)) {
      found.push_back(number->value);
      EXPECT_NE(source.bytes.substr(number->begin, number->end - number->begin), "");
    } else {
      ++i;
    }
  }
  EXPECT_EQ(found, (std::vector<double>{-1.5e-3, 0.25, -4.0}));
}

TEST(Readers, NoBytesMakeAReaderFail) {
  const long count = tests::scaled(3000);
  std::mt19937_64 random(40);
  long targets = 0;
  for (const auto& [file, data] :
       std::vector<std::pair<std::string, std::string>>{{"traps.mod", ""},
                                                        {"displaced.prg", ""},
                                                        {"TRAPS.LS", ""},
                                                        {"traps.src", "traps.dat"},
                                                        {"traps.script", ""}}) {
    const std::string whole = corpus(file), beside = data.empty() ? "" : corpus(data);
    for (long k = 0; k < count; ++k) {
      std::string bytes = whole;
      for (std::uint64_t edits = 1 + random() % 4; edits > 0 && !bytes.empty(); --edits) {
        const std::size_t at = random() % bytes.size();
        constexpr std::string_view kNasty = "[]{}(),;:=\\\"'!#p-+.eE0 \n\r\t\0\xff/";
        switch (random() % 4) {
          case 0:
            bytes[at] = static_cast<char>(random());
            break;
          case 1:
            bytes.erase(at, 1 + random() % 40);
            break;
          case 2:
            bytes.insert(at, 1 + random() % 3, kNasty[random() % kNasty.size()]);
            break;
          default:
            bytes.insert(at, bytes.substr(random() % bytes.size(), random() % 80));
        }
        if (random() % 50 == 0) bytes.resize(at);
      }
      const Program p = read_bytes(file, bytes, beside);
      std::vector<Edit> same;
      for (const Target& target : p.targets)
        for (const Number& n : target.written.numbers) {
          ASSERT_LT(n.begin, n.end);
          ASSERT_LE(n.end, p.sources[n.source].bytes.size());
          same.push_back({n, p.sources[n.source].bytes.substr(n.begin, n.end - n.begin)});
        }
      targets += static_cast<long>(p.targets.size());
      ASSERT_EQ(edited(p, same)[0], bytes);
      ASSERT_GE(marked(*language_of(file), bytes, {"m", "0"}).size(), bytes.size());
    }
  }
  std::printf("%ld programs, seed 40, %ld targets\n", 5 * count, targets);
}

}  // namespace
}  // namespace plumb::offline::programs

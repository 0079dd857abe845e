// SPDX-License-Identifier: Apache-2.0
#include "programs/current_frame.hpp"

#include <cmath>

#include "programs/names.hpp"
#include "programs/rewriting.hpp"
#include "programs/settle.hpp"
#include "programs/written.hpp"
#include "tests/programs/corpus.hpp"

namespace plumb::offline::programs {
namespace {

/// What is not sure is not taken for known: of each kind of doubt the smallest program, and beside
/// it the same one without.

constexpr const char* kNoAxes = "[9E9,9E9,9E9,9E9,9E9,9E9]";

std::string robtarget(const std::string& name, const std::string& axes = kNoAxes) {
  return "CONST robtarget " + name + ":=[[1,2,3],[1,0,0,0],[0,0,0,0]," + axes + "];\n";
}

std::vector<Program> read_together(const std::string& ending,
                                   const std::vector<std::string>& texts) {
  std::vector<std::vector<Source>> sources;
  for (const std::string& text : texts)
    sources.push_back({{std::string(1, static_cast<char>('a' + sources.size())) + ending, text}});
  return read_programs(*language_of("x" + ending), std::move(sources));
}

bool free(const Program& program, const std::string& target) {
  return free_targets(program).contains(target);
}

// -- Tools and frames that are stated as numbers

TEST(Doubts, PosesThatDifferOnlyInTheirLastDigitsAreTwo) {
  const std::string more = ".12345678901234567890";
  const std::string start = "p[0" + more + ",0" + more + ",0" + more + ",0,0,";
  const Program ur =
      read_bytes("x.script", "def x():\nset_tcp(" + start + "0])\nmovel(p[1,0,0,0,0,0])\n" +
                                 "set_tcp(" + start + "1])\nmovel(p[2,0,0,0,0,0])\nend\n");
  ASSERT_EQ(ur.targets.size(), 2U);
  EXPECT_NE(ur.targets[0].tool, ur.targets[1].tool);
  EXPECT_NEAR(ur.tools.at(ur.targets[1].tool).X->R(0, 1), -std::sin(1.0), 1e-12);
  EXPECT_NEAR(ur.tools.at(ur.targets[0].tool).X->R(0, 1), 0.0, 1e-12);
  const std::string pose = "{X 0" + more + ",Y 0" + more + ",Z 0" + more + ",A 0,B 0,C ";
  const Program krl =
      read_bytes("x.src", "DEF x()\n$TOOL=" + pose + "0}\n$BASE=" + pose +
                              "0}\nLIN {X 1,Y 0,Z 0,A 0,B 0,C 0}\n$TOOL=" + pose +
                              "1}\n$BASE=" + pose + "1}\nLIN {X 2,Y 0,Z 0,A 0,B 0,C 0}\nEND\n");
  ASSERT_EQ(krl.targets.size(), 2U);
  EXPECT_NE(krl.targets[0].tool, krl.targets[1].tool);
  EXPECT_NE(krl.targets[0].frame, krl.targets[1].frame);
}

// -- Configurations

bool configured(const Program& program, const std::string& target) {
  return named(program, target).configuration.front.has_value();
}

TEST(Doubts, AConfigurationCountsOnlyInMovesThatFollowIt) {
  const std::string data =
      "DEFDAT x\nDECL E6POS XA={X 1,Y 2,Z 3,A 0,B 0,C 0,S 2,T 0}\nDECL E6POS XB={X 1,Y 2,Z 3,A 0,B "
      "0,C 0,S 2,T 0}\nENDDAT\n";
  for (const std::string word : {"PTP", "SPTP"})
    EXPECT_TRUE(configured(read_bytes("x.src", "DEF x()\n" + word + " XA\nEND\n", data), "XA"));
  for (const std::string word : {"LIN", "SLIN"})
    EXPECT_FALSE(configured(read_bytes("x.src", "DEF x()\n" + word + " XA\nEND\n", data), "XA"));
  for (const std::string word : {"CIRC", "SCIRC"}) {
    const Program p = read_bytes("x.src", "DEF x()\n" + word + " XA,XB\nEND\n", data);
    EXPECT_FALSE(configured(p, "XA") || configured(p, "XB"));
  }
  EXPECT_TRUE(configured(read_bytes("x.src", "DEF x()\nLIN XA\nPTP XA\nEND\n", data), "XA"));
}

TEST(Doubts, RapidConfigurationsAreOffWhereverAnyProgramSwitchesThemOff) {
  const std::string text =
      "MODULE m\n" + robtarget("pJ") + robtarget("pL") + robtarget("pC") +
      "PROC main()\nMoveJ pJ,v100,fine,tool0;\nMoveL "
      "pL,v100,fine,tool0;\nMoveC pL,pC,v100,fine,tool0;\nENDPROC\nENDMODULE\n";
  const auto said = [&](const std::string& words) {
    std::string own = text;
    own.insert(own.find("MoveJ"), words);
    const Program inside = read_bytes("m.mod", own);
    const auto beside = read_together(".mod", {text, "PROC x()\n" + words + "\nENDPROC\n"});
    std::string out;
    for (const Program* p : std::initializer_list<const Program*>{&inside, &beside[0]})
      for (const auto* name : {"pJ", "pL", "pC"}) out += configured(*p, name) ? "1" : "0";
    return out;
  };
  EXPECT_EQ(said(""), "111111");
  EXPECT_EQ(said("ConfJ\\On; ConfL\\On;"), "111111");
  EXPECT_EQ(said("ConfJ \\Off;"), "011011");
  EXPECT_EQ(said("ConfL\\Off;"), "100100");
}

TEST(Doubts, OfAFanucConfigurationOnlyFrontAndElbowAreRead) {
  for (const std::string text : {"N U T, 0, 0, 0", "F U T, 1, -1, 2", "FUT,0,0,0"}) {
    const Program p = read_bytes("x.ls",
                                 "/MN\n 1:L P[1] 9mm/sec FINE ;\n/POS\nP[1]{\n GP1:\n UF : 1, "
                                 "UT : 1, CONFIG : '" +
                                     text +
                                     "',\n X = 1 mm, Y = 1 mm, Z = 1 "
                                     "mm,\n W = 0 deg, P = 0 deg, R = 0 deg\n};\n/END\n");
    const Configuration& c = named(p, "P[1]").configuration;
    EXPECT_TRUE(c.ranges.empty());
    EXPECT_TRUE(c.front.value_or(false) && c.elbow_front.value_or(false)) << text;
  }
}

// -- Mentions

std::string tool_module(const std::string& extra) {
  return "MODULE m\nPERS tooldata "
         "tG:=[TRUE,[[0,0,1],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];\nPERS "
         "wobjdata wT:=[FALSE,TRUE,\"\",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];\n" +
         robtarget("pA") + "PROC main()\nMoveL pA,v100,fine,tG\\WObj:=wT;\n" + extra +
         "\nENDPROC\nENDMODULE\n";
}

TEST(Doubts, EveryMentionOfAToolOrFrameThatIsNoMoveSpoilsIt) {
  const auto known = [](const Program& p) {
    return std::string(p.tools.at("tg").X ? "1" : "0") + (p.frames.at("wt").X ? "1" : "0");
  };
  for (const std::string harmless :
       {"", "x:=CRobT(\\Tool:=tG\\WObj:=wT);", "SearchL d,p1,p2,v1,tG\\WObj:=wT;",
        "ArcL p1,v1,s1,w1,fine,tG\\WObj:=wT;"})
    EXPECT_EQ(known(read_bytes("m.mod", tool_module(harmless))), "11") << harmless;
  for (const std::string harm :
       {"tG:=tOld;", "tG.tframe.trans.z:=7;", "MToolTCPCalib a,b,c,d,tG,m,n;", "Change tG;",
        "SetDataVal \"tG\",tOld;", "x:=CRobT(Change(tG));"})
    EXPECT_EQ(known(read_bytes("m.mod", tool_module(harm))), "01") << harm;
  EXPECT_EQ(known(read_bytes("m.mod", tool_module("wT.uframe.trans:=[0,0,1];"))), "10");
  EXPECT_TRUE(read_bytes("m.mod", tool_module("Change tG;")).tools.at("tg").moving);
  const Program any = read_bytes("m.mod", tool_module("SetDataVal name,tOld;"));
  EXPECT_TRUE(any.tools.at(kAllFrames).moving && any.frames.at(kAllFrames).moving);
  EXPECT_FALSE(free(any, "pA"));
  EXPECT_TRUE(read_bytes("m.mod", tool_module("SetDataVal \"T_ROB1/tG\",tOld;"))
                  .tools.at(kAllFrames)
                  .moving);
}

TEST(Doubts, WhatAnotherProgramDoesCountsAsWell) {
  const std::string own = tool_module("");
  const auto other = [&](const std::string& text) {
    return read_together(".mod", {own, "PROC x()\n" + text + "\nENDPROC\n"})[0];
  };
  EXPECT_TRUE(free(other("MoveL pB,v1,fine,tool0;"), "pA"));
  EXPECT_EQ(named(other("\nMoveL PA,v1,fine,tool0;"), "pA").why.substr(0, 15), "b.mod:3 uses it");
  EXPECT_FALSE(free(other("pA.trans.x:=7;"), "pA"));
  EXPECT_TRUE(other("MoveL pB,v1,fine,tG\\WObj:=wT;").tools.at("tg").X);
  EXPECT_TRUE(other("tG.tframe.trans.x:=7;").tools.at("tg").moving);
  EXPECT_TRUE(other("wT:=wOld;").frames.at("wt").moving);
  EXPECT_FALSE(free(other("PDispOn p1,tool0;"), "pA"));
  EXPECT_FALSE(free(other("SetDataVal n,p1;"), "pA"));
  // A name of its own is another target.
  EXPECT_TRUE(
      free(read_together(
               ".mod", {own, robtarget("pA") + "PROC x()\nMoveL pA,v1,fine,tool0;\nENDPROC\n"})[0],
           "pA"));
  const std::string krl = "DEF a()\nDECL E6POS XA={X 1,Y 2,Z 3,A 0,B 0,C 0}\nPTP XA\nEND\n";
  EXPECT_TRUE(free(read_together(".src", {krl, "DEF b()\nPTP XB\nEND\n"})[0], "XA"));
  EXPECT_FALSE(free(read_together(".src", {krl, "DEF b()\nXA.X=7\nEND\n"})[0], "XA"));
}

TEST(Doubts, AWorkObjectThatIsChosenOrConditionalIsNotKnown) {
  for (const std::string form : {"\\WObj?wT", "\\WObj:=wT{1}", "\\WObj", "\\WObj:=Pick(1)"}) {
    std::string text = tool_module("");
    text.replace(text.find("\\WObj:=wT"), 9, form);
    EXPECT_EQ(named(read_bytes("m.mod", text), "pA").frame, "(computed)") << form;
  }
}

// -- Which tool is in force

/// The numbers of the tools of the moves of a URScript program: 0.1 of A, 0.2 of B, "-" not known.
std::string tools_of(std::string text) {
  const auto all = [&](const std::string& from, const std::string& to) {
    for (std::size_t at; (at = text.find(from)) != std::string::npos;)
      text.replace(at, from.size(), to);
  };
  all("SETA", "set_tcp(p[0,0,0.1,0,0,0])");
  all("SETB", "set_tcp(p[0,0,0.2,0,0,0])");
  all("GO", "movel(p[0.5,0.1,0.4,0,3.1416,0])");
  const Program p = read_bytes("x.script", text);
  std::string out;
  for (const Move& move : p.moves) {
    if (move.target < 0) continue;
    const auto at = p.tools.find(move.tool);
    out += at == p.tools.end() || !at->second.X ? "-" : at->second.X->p(2) < 0.15 ? "A" : "B";
  }
  return out;
}

TEST(Doubts, TheToolIsKnownBehindAStatementOfTheSameRoutineOnly) {
  EXPECT_EQ(tools_of("def x():\nSETA\nGO\nSETB\nGO\nend\n"), "AB");
  EXPECT_EQ(tools_of("def x():\nGO\nSETA\nGO\nend\n"), "-A");
  EXPECT_EQ(tools_of("def x():\nSETA\nend\ndef y():\nGO\nend\n"), "-");
  EXPECT_EQ(tools_of("SETA\nGO\ndef y():\nGO\nend\nGO\n"), "A-A") << "around routines too";
}

TEST(Doubts, ABlockThatSetsAnotherToolLeavesItUnknown) {
  EXPECT_EQ(tools_of("def x():\nSETA\nif a:\nGO\nSETB\nGO\nend\nGO\nSETA\nGO\nend\n"), "AB-A");
  EXPECT_EQ(tools_of("def x():\nSETA\nif a:\nSETB\nGO\nelif b:\nGO\nelse:\nGO\nend\nend\n"), "BAA");
  EXPECT_EQ(tools_of("def x():\nSETA\nif a:\nSETA\nend\nGO\nend\n"), "A");
  EXPECT_EQ(tools_of("def x():\nif a:\nSETA\nGO\nend\nGO\nend\n"), "A-");
  EXPECT_EQ(tools_of("def x():\nSETA\nwhile a:\nGO\nSETB\nGO\nend\nGO\nend\n"), "-B-");
  EXPECT_EQ(tools_of("def x():\nSETA\nwhile a:\nGO\nif b:\nif c:\nSETB\nend\nend\nGO\nend\nend\n"),
            "--");
  EXPECT_EQ(tools_of("def x():\nSETA\nwhile a:\nSETA\nGO\nend\nGO\nend\n"), "AA");
  EXPECT_EQ(tools_of("SETA\nif a:\nSETB\nend\nGO\n"), "-") << "in the text of the file as well";
}

TEST(Doubts, ARoutineWithinAnotherIsOneOfItsOwn) {
  EXPECT_EQ(tools_of("def x():\nSETA\ndef y():\nGO\nSETB\nGO\nend\nGO\nend\n"), "-BA");
  EXPECT_EQ(tools_of("def x():\nSETA\nwhile a:\ndef y():\nSETB\nend\nGO\nend\nend\n"), "A");
}

TEST(Doubts, ACallOfARoutineThatSetsAToolLeavesItUnknown) {
  const std::string y = "def y():\nSETB\nend\n", z = "def z():\nif a:\ny()\nend\nend\n";
  EXPECT_EQ(tools_of(y + "def x():\nSETA\ny()\nGO\nSETA\nGO\nend\n"), "-A");
  EXPECT_EQ(tools_of(y + z + "def x():\nSETA\nz()\nGO\nend\n"), "-");
  EXPECT_EQ(tools_of(y + z + "def x():\nSETA\nwhile a:\nGO\nz()\nend\nend\n"), "-");
  EXPECT_EQ(tools_of("def w():\nGO\nend\ndef x():\nSETA\nw()\nGO\nend\n"), "-A");
  const std::string krl =
      "DEF a()\n$TOOL=TOOL_DATA[1]\n$BASE=BASE_DATA[1]\nsub()\nPTP {X 1,Y 2,Z 3,A "
      "0,B 0,C 0}\nEND\n";
  const auto with = [&](const std::string& sub) {
    const Move move = first_move(read_together(".src", {krl, sub})[0]);
    return move.tool + "/" + move.frame;
  };
  EXPECT_EQ(with("DEF other()\n$TOOL=TOOL_DATA[2]\nEND\n"), "1/1");
  EXPECT_EQ(with("DEF sub()\n$TOOL=TOOL_DATA[2]\nEND\n"), "(set by a routine that is called)/1");
  EXPECT_EQ(with("DEF sub()\ndeep()\nEND\nDEF deep()\n$BASE=BASE_DATA[2]\nEND\n"),
            "1/(set by a routine that is called)");
}

TEST(Doubts, AThreadOrAnInterruptThatSetsAToolLeavesItUnknownEverywhere) {
  EXPECT_EQ(tools_of("thread t():\nSETB\nend\ndef x():\nSETA\nGO\nrun t()\nGO\nend\n"), "--");
  EXPECT_EQ(tools_of("def y():\nSETB\nend\nthread t():\ny()\nend\ndef x():\nSETA\nGO\nend\n"), "-");
  EXPECT_EQ(tools_of("thread t():\nsleep(1)\nend\ndef x():\nSETA\nGO\nend\n"), "A");
  const auto tool = [](const std::string& line) {
    return read_bytes("x.src", "DEF x()\n" + line +
                                   "\n$TOOL=TOOL_DATA[1]\nPTP {X 1,Y 2,Z 3,A 0,B 0,C "
                                   "0}\nEND\nDEF isr()\n$TOOL=TOOL_DATA[2]\nEND\n")
        .moves[0]
        .tool;
  };
  EXPECT_EQ(tool("INTERRUPT DECL 3 WHEN $IN[1] DO isr()"), "(set by a thread or an interrupt)");
  EXPECT_EQ(tool("TRIGGER WHEN DISTANCE=0 DELAY=0 DO isr() PRIO=-1"),
            "(set by a thread or an interrupt)");
  EXPECT_EQ(tool(""), "1");
}

TEST(Doubts, WithJumpsAToolIsKnownOnlyIfNoneCanPassItBy) {
  const std::string go = "PTP {X 1,Y 2,Z 3,A 0,B 0,C 0}\n", one = "$TOOL=TOOL_DATA[1]\n",
                    two = "$TOOL=TOOL_DATA[2]\n", jump = "GOTO L\n", label = "L:\n";
  const auto tool = [&](const std::string& body) {
    return first_move(read_bytes("x.src", "DEF x()\n" + body + "END\n")).tool;
  };
  EXPECT_EQ(tool(one + label + go + jump), "1");
  EXPECT_EQ(tool(one + label + go + one + jump), "1");
  EXPECT_EQ(tool(one + label + go + two + jump), "(set where a jump may pass it by)");
  EXPECT_EQ(tool(label + one + go + jump), "(set where a jump may pass it by)");
  EXPECT_EQ(tool("IF a THEN\n" + jump + "ENDIF\n" + one + label + go),
            "(set where a jump may pass it by)");
  EXPECT_EQ(tool(jump + one + label + go), "(set where a jump may pass it by)");
  EXPECT_EQ(tool(jump + label + go), "default");
}

// -- KRL

std::string krl_frame(const std::string& body, const std::string& data = "") {
  const Program p =
      read_bytes("x.src", "DEF x()\n" + body + "END\n", "DEFDAT x\n" + data + "ENDDAT\n");
  const Move move = first_move(p);
  const auto at = p.frames.find(move.frame), all = p.frames.find(kAllFrames);
  if (all != p.frames.end() && all->second.moving) return "moving";
  if (at == p.frames.end()) return move.frame;
  return at->second.X ? "known" : at->second.moving ? "moving" : "unknown";
}

TEST(Doubts, ASplineBlockSaysWhatItsMovesAreMadeWith) {
  const std::string go = "SLIN {X 1,Y 2,Z 3,A 0,B 0,C 0}\nENDSPLINE\n";
  EXPECT_EQ(krl_frame("$BASE=$NULLFRAME\nSPLINE\n" + go), "known");
  EXPECT_EQ(krl_frame("$BASE=$NULLFRAME\nSPLINE WITH $BASE=BASE_DATA[2]\n" + go),
            "(set by the SPLINE block)");
  EXPECT_EQ(krl_frame("$BASE=$NULLFRAME\nSPLINE WITH $BASE=BASE_DATA[2]\nENDSPLINE\n" + go),
            "known");
}

TEST(Doubts, AToolThatStandsInTheCellStaysThereWhateverToolIsNamed) {
  const auto tool = [](const std::string& body) {
    return first_move(read_bytes("x.src", "DEF x()\n" + body + "END\n")).tool;
  };
  const std::string go = "LIN {X 1,Y 2,Z 3,A 0,B 0,C 0}";
  EXPECT_EQ(tool("$IPO_MODE=#BASE\n$TOOL=TOOL_DATA[1]\n" + go + "\n"), "1");
  EXPECT_EQ(tool("$IPO_MODE=#TCP\n$TOOL=TOOL_DATA[1]\n" + go + "\n"),
            "(the tool stands in the cell)");
  EXPECT_EQ(tool("$IPO_MODE=mode\n$TOOL=TOOL_DATA[1]\n" + go + "\n"),
            "(the tool stands in the cell)");
  EXPECT_EQ(tool("$TOOL=TOOL_DATA[1]\nS" + go + " WITH $IPO_MODE=#TCP\n"),
            "(the tool stands in the cell)");
  EXPECT_EQ(tool("$TOOL=TOOL_DATA[1]\nTRIGGER WHEN DISTANCE=0 DELAY=0 DO $TOOL=TOOL_DATA[2]\n" +
                 go + "\n"),
            "(set by a thread or an interrupt)");
  EXPECT_EQ(
      tool("f()\n$TOOL=TOOL_DATA[1]\nf()\n" + go + "\nEND\nDEFFCT INT f()\n$TOOL=TOOL_DATA[2]\n"),
      "(set by a routine that is called)");
}

TEST(Doubts, AnElementOfBaseDataIsKnownOnlyIfItIsStatedOnceBeforeAllMoves) {
  const std::string pose = "{X 1,Y 0,Z 0,A 0,B 0,C 0}", set = "BASE_DATA[3]=" + pose + "\n";
  const std::string go = "$BASE=BASE_DATA[3]\nLIN {X 1,Y 2,Z 3,A 0,B 0,C 0}\n";
  EXPECT_EQ(krl_frame(go, set), "known");
  EXPECT_EQ(krl_frame("BAS (#INITMOV,0 )\n" + set + go), "known");
  EXPECT_EQ(krl_frame(go, "BASE_DATA[3]=" + pose + ":SHIFT\n"), "unknown");
  EXPECT_EQ(krl_frame(set + go, set), "moving");
  EXPECT_EQ(krl_frame(go + set), "moving");
  EXPECT_EQ(krl_frame("IF a THEN\n" + set + "ENDIF\n" + go), "moving");
  EXPECT_EQ(krl_frame("BASE_DATA[I]=" + pose + "\n" + go, set), "moving");
  EXPECT_EQ(krl_frame("MEASURE(BASE_DATA[3])\n" + go, set), "moving");
  EXPECT_EQ(krl_frame("MEASURE(BASE_DATA[])\n" + go, set), "moving");
  EXPECT_EQ(krl_frame("BASE_DATA[3].X=7\n" + go, set), "moving");
  EXPECT_EQ(krl_frame("DECL FRAME BASE_DATA[32]\n" + go, set), "known");
}

TEST(Doubts, ARecordOfAnInlineFormThatIsChangedSaysNothing) {
  const std::string data = "DECL FDAT FP1={TOOL_NO 1,BASE_NO 0,IPO_FRAME #BASE}\n";
  const std::string go = "FDAT_ACT=FP1\nLIN {X 1,Y 2,Z 3,A 0,B 0,C 0}\n";
  EXPECT_EQ(krl_frame(go, data), "known");
  EXPECT_EQ(krl_frame("FP1.BASE_NO=3\n" + go, data), "(computed)");
  EXPECT_EQ(krl_frame("FP1=FP2\n" + go, data), "(computed)");
  EXPECT_EQ(krl_frame("CALC(FP1)\n" + go, data), "(computed)");
  EXPECT_EQ(krl_frame("FDAT_ACT=FP1\nFDAT_ACT.BASE_NO=3\nLIN {X 1,Y 2,Z 3,A 0,B 0,C 0}\n", data),
            "(computed)");
  EXPECT_EQ(krl_frame("SLIN {X 1,Y 2,Z 3,A 0,B 0,C 0} WITH $BASE=SBASE(FP1.BASE_NO)\n", data),
            "known");
}

TEST(Doubts, TheCopyInAFoldIsFoundAtWholeNumbersOnlyAndWrittenOnce) {
  const std::string pose = "X 420.5,Y 10,Z 900,A 0,B 170,C 5";
  const auto copies = [&](const std::string& comment) {
    const Program p = read_bytes(
        "x.src", "DEF x()\n;FOLD LIN {" + comment + "};%{PE}\nLIN {" + pose + "}\n;ENDFOLD\nEND\n");
    return p.targets[0].copies.size();
  };
  EXPECT_EQ(copies(pose), 6U);
  EXPECT_EQ(copies(pose + ",S 2"), 6U);
  for (const std::string longer : {"5", ".5", "0"}) EXPECT_EQ(copies(pose + longer), 0U) << longer;
  for (const std::string longer : {"1", "-", "+", "."}) {
    std::string other = pose;
    EXPECT_EQ(copies(other.insert(2, longer)), 0U) << longer;
  }
  const Program two = read_bytes("x.src", "DEF x()\n;FOLD LIN {" + pose + "};%{PE}\nLIN {" + pose +
                                              "}\nLIN {" + pose + "}\n;ENDFOLD\nEND\n");
  std::vector<Edit> edits;
  for (const Target& target : two.targets) {
    auto values = values_of(target.written);
    values[0] = 1234.56;
    const auto made = new_digits(two, target, values, {.position = 2, .orientation = 0});
    edits.insert(edits.end(), made.edits.begin(), made.edits.end());
  }
  const std::string now = edited(two, edits)[0];
  std::size_t count = 0;
  for (std::size_t at = 0;
       (at = now.find("{X 1234.56,Y 10,Z 900,A 0,B 170,C 5}", at)) != std::string::npos; ++at)
    ++count;
  EXPECT_EQ(count, 3U) << now;
  const std::string fold = "DEF x()\n$BASE=$NULLFRAME\n;FOLD LIN {" + pose + "};%{PE}\nLIN {" +
                           pose + "}\n$TOOL=TOOL_DATA[2]\nLIN {" + pose + "}\n;ENDFOLD\nEND\n";
  EXPECT_TRUE(free_targets(read_bytes("x.src", fold)).empty()) << "one comment for two tools";
}

// -- Where the arm was

/// The moves of the first program: "m", or "?" where the arm may be anywhere from there on.
std::string way(const std::string& ending, const std::vector<std::string>& texts) {
  std::string out;
  const auto programs = read_together(ending, texts);
  for (const Move& move : programs[0].moves) out += move.target < 0 ? "?" : "m";
  return out;
}

TEST(Doubts, MovesOfOtherRoutinesComeBetweenThoseOfTheText) {
  const std::string go = "MoveL pA,v1,fine,tool0;\n";
  const std::string main = robtarget("pA") + "PROC main()\n" + go + "sub;\n" + go + "ENDPROC\n";
  EXPECT_EQ(way(".mod", {main}), "mm");
  EXPECT_EQ(way(".mod", {main, "PROC sub()\nMoveL pB,v1,fine,tool0;\nENDPROC\n"}), "m?m");
  EXPECT_EQ(way(".mod", {main, "PROC sub()\ndeep;\nENDPROC\nPROC deep()\n" + go + "ENDPROC\n"}),
            "m?m");
  for (const std::string call : {"%\"sub\"%;", "CallByVar \"sub\",1;"}) {
    std::string other = main;
    EXPECT_EQ(way(".mod", {other.replace(other.find("sub;"), 4, call)}).back(), 'm');
    EXPECT_NE(way(".mod", {other}), "mm") << call;
  }
  EXPECT_EQ(way(".mod", {main + "PROC x()\n" + go + "ENDPROC\n"}), "mm?m");
  EXPECT_EQ(way(".mod", {robtarget("pA") + "PROC main()\nArcL p1,v1,s,w,fine,tool0;\n" + go}),
            "?m");
  const std::string lin = "LIN {X 1,Y 2,Z 3,A 0,B 0,C 0}\n";
  const std::string krl = "DEF a()\n" + lin + "sub()\n" + lin + "END\n";
  EXPECT_EQ(way(".src", {krl}), "mm?");
  EXPECT_EQ(way(".src", {krl, "DEF sub()\n" + lin + "END\n"}), "m?m?");
  EXPECT_EQ(way(".src", {"DEF a()\nsub()\n" + lin, "DEF sub()\n" + lin + "END\n"}), "?m");
  const std::string ur = "movel(p[1,0,0,0,0,0])\n";
  EXPECT_EQ(way(".script", {"def x():\n" + ur + "y()\n" + ur + "end\n"}), "mm?");
  EXPECT_EQ(way(".script", {"def y():\n" + ur + "end\ndef x():\n" + ur + "y()\n" + ur + "end\n"}),
            "m??m?m?");
  const std::string ls =
      "/PROG A\n/MN\n 1:L P[1] 9mm/sec FINE ;\n 2: CALL B ;\n 3:L P[1] 9mm/sec "
      "FINE ;\n/POS\nP[1]{\n GP1:\n X = 1 mm, Y = 1 mm, Z = 1 mm,\n W = 0 deg, P = 0 "
      "deg, R = 0 deg\n};\n/END\n";
  std::string b = ls;
  EXPECT_EQ(way(".ls", {ls}), "mm");
  std::string chosen = ls;
  EXPECT_EQ(way(".ls", {chosen.replace(ls.find("CALL B"), 6, "CALL SR[1]")}), "m?m");
  EXPECT_EQ(way(".ls", {ls, b.replace(6, 1, "B")}), "m?m");
}

// -- What moves tools, frames and targets

TEST(Doubts, ToolsAndFramesThatChangeOrMoveAreMarkedAsSuch) {
  const std::string pose = "[[0,0,1],[1,0,0,0]]";
  const auto tool = [&](const std::string& held) {
    return read_bytes("m.mod", "PERS tooldata t:=[" + held + "," + pose + ",[1]];\n").tools.at("t");
  };
  const auto work = [&](const std::string& flags) {
    return read_bytes("m.mod", "PERS wobjdata w:=[" + flags + "," + pose + "," + pose + "];\n")
        .frames.at("w");
  };
  EXPECT_TRUE(tool("TRUE").X && !tool("TRUE").moving);
  EXPECT_TRUE(tool("FALSE").moving);
  EXPECT_TRUE(work("FALSE,TRUE,\"\"").X && !work("FALSE,TRUE,\"\"").moving);
  for (const auto* flags : {"TRUE,TRUE,\"\"", "FALSE,FALSE,\"\"", "FALSE,TRUE,\"STN1\""})
    EXPECT_TRUE(work(flags).moving && !work(flags).X) << flags;
  const auto fanuc = [](const std::string& line) {
    return read_bytes("x.ls", "/MN\n 1: " + line + " ;\n/POS\n/END\n");
  };
  EXPECT_TRUE(fanuc("UTOOL[2]=PR[9]").tools.at("2").moving);
  EXPECT_TRUE(fanuc("UFRAME[2:jig]=PR[9]").frames.at("2").moving);
  EXPECT_TRUE(fanuc("UTOOL[R[1]]=PR[9]").tools.at(kAllFrames).moving);
  EXPECT_TRUE(fanuc("UFRAME[R[1:n]]=PR[9]").frames.at(kAllFrames).moving);
  EXPECT_EQ(fanuc("PR[9]=UTOOL[2]").tools.size(), 1U);
  const auto shared =
      read_together(".ls", {"/MN\n 1: UTOOL[2]=PR[9] ;\n/POS\n/END\n", "/MN\n/POS\n/END\n"});
  EXPECT_TRUE(shared[1].tools.at("2").moving);
}

TEST(Doubts, MotionThatMovesTargetsListsThem) {
  const std::string position =
      "/POS\nP[1]{\n GP1:\n UF : 1, UT : 1, CONFIG : 'N U T, 0, 0, 0',\n X = 1 mm, "
      "Y = 1 mm, Z = 1 mm,\n W = 0 deg, P = 0 deg, R = 0 deg\n};\n/END\n";
  const auto fanuc = [&](const std::string& head, const std::string& line) {
    return free(read_bytes("x.ls", "/PROG X\n" + head + "/MN\n 1: " + line +
                                       " ;\n 2:L P[1] 9mm/sec FINE ;\n" + position),
                "P[1]");
  };
  EXPECT_TRUE(fanuc("/APPL\nLINE_TRACK;\nLINE_TRACK_SCHEDULE_NUMBER : 0;\n", "R[1]=1"));
  EXPECT_FALSE(fanuc("/APPL\nLINE_TRACK;\nLINE_TRACK_SCHEDULE_NUMBER : 1;\n", "R[1]=1"));
  for (const std::string line :
       {"Touch Offset PR[1]", "Track TAST[1]", "TRACK {AVC}[1]", "OFFSET CONDITION PR[1]",
        "TOOL_OFFSET CONDITION PR[1]", "VOFFSET CONDITION VR[1]", "MP Offset PR[1] RPM[1]"})
    EXPECT_FALSE(fanuc("", line)) << line;
  EXPECT_TRUE(fanuc("", "Track End"));
  EXPECT_FALSE(fanuc("", "P[R[1]]=LPOS")) << "it may be any of them";
  for (const std::string line : {"track_conveyor_linear(p[1,0,0,0,0,0],1)", "path_offset_enable()",
                                 "force_mode(tool_pose(),a,b,2,c)"})
    EXPECT_TRUE(
        free_targets(read_bytes("x.script", "def x():\nmovel(p[1,0,0,0,0,0])\n" + line + "\nend\n"))
            .empty())
        << line;
  EXPECT_FALSE(free(read_bytes("m.mod", tool_module("FCAct tG;")), "pA"));
  EXPECT_TRUE(free_targets(read_bytes("x.src",
                                      "DEF x()\nret=RSI_MOVECORR()\nPTP {X 1,Y 2,Z 3,A 0,B 0,C "
                                      "0}\nEND\n"))
                  .empty());
}

TEST(Doubts, ATargetKnowsWhetherItMovesExternalAxes) {
  const auto rapid = [](const std::string& axes) {
    return read_bytes("m.mod", robtarget("p", axes)).targets[0].external_axes;
  };
  EXPECT_FALSE(rapid(kNoAxes) || rapid("[9E9,9E+09,9E+9,9000000000,9E9,9E9]"));
  EXPECT_TRUE(rapid("[0,9E9,9E9,9E9,9E9,9E9]") && rapid("[9E9,9E9,9E9,9E9,9E9,-12.5]"));
  EXPECT_TRUE(rapid("where"));
  const auto krl = [](const std::string& axes) {
    return read_bytes("x.src", "DECL E6POS P={X 1,Y 2,Z 3,A 0,B 0,C 0" + axes + "}\n")
        .targets[0]
        .external_axes;
  };
  EXPECT_FALSE(krl("") || krl(",S 2,T 0,E1 0.0,E6 0"));
  EXPECT_TRUE(krl(",E1 100") && krl(",E1 0,E6 -1") && krl(",E1 where"));
}

TEST(Doubts, JointsThatAreChangedAreNoStartOfTheNextMove) {
  const std::string head = "def x():\nq=[0,-1,1,0,1,0]\np1=p[0.5,0,0.4,0,3.1,0]\n";
  const auto joints = [&](const std::string& text) {
    const Program p = read_bytes("x.script", head + text + "\nend\n");
    return std::pair(p.moves[0].joints_deg.size(), free(p, "p1"));
  };
  EXPECT_EQ(joints("movej(get_inverse_kin(p1,qnear=q))"), std::pair(std::size_t{6}, true));
  EXPECT_EQ(joints("movej(get_inverse_kin(p1,qnear=q))\nq[0]=1"), std::pair(std::size_t{0}, false));
  EXPECT_EQ(joints("movej(get_inverse_kin(p1,qnear=r))"), std::pair(std::size_t{0}, false));
}

TEST(Doubts, AFileInWhichNothingIsFoundSaysSo) {
  for (const std::string file : {"x.mod", "x.ls", "x.src", "x.script"}) {
    EXPECT_TRUE(read_bytes(file, "\x01\x7f what is this?").states_nothing) << file;
    EXPECT_TRUE(read_bytes(file, "").states_nothing) << file;
  }
  EXPECT_TRUE(
      read_bytes("x.src", "DEF x()\r;a\rPTP {X 1,Y 2,Z 3,A 0,B 0,C 0}\rEND\r").states_nothing);
  EXPECT_FALSE(read_bytes("x.mod", tool_module("")).states_nothing);
  EXPECT_FALSE(
      read_bytes("x.mod", "PERS tooldata t:=[TRUE,[[0,0,1],[1,0,0,0]],[1]];\n").states_nothing);
}

/// Whether the arm is known to be at the target before when it begins the last move of a program.
bool follows(const Program& p) {
  std::size_t last = p.moves.size();
  while (last > 0 && p.moves[last - 1].target < 0) --last;
  return last > 1 && p.moves[last - 2].target >= 0;
}

TEST(Doubts, WhereTextsMeetAndBehindOtherMotionTheArmMayBeAnywhere) {
  const std::string go = "LIN {X 1,Y 2,Z 3,A 0,B 0,C 0}\n";
  const auto krl = [&](const std::string& between) {
    return follows(read_bytes("x.src", "DEF x()\n" + go + between + go + "END\n"));
  };
  EXPECT_TRUE(krl(""));
  EXPECT_TRUE(krl("$VEL.CP=1\n"));
  for (const char* between : {"LOOP\n", "IF a THEN\nENDIF\n", "here:\n", "SPL XP1\n"})
    EXPECT_FALSE(krl(between)) << between;
  const auto ur = [](const std::string& between) {
    const std::string move = "  movel(p[1,0,0,0,0,0])\n";
    return follows(read_bytes("x.script", "def x():\n" + move + between + move + "end\n"));
  };
  EXPECT_TRUE(ur("  sleep(1)\n"));
  for (const char* between :
       {"  servoj([0,0,0,0,0,0])\n", "  while True:\n", "  if a:\n  end\n", "  speedl(v)\n"})
    EXPECT_FALSE(ur(between)) << between;
  const auto fanuc = [](const std::string& between) {
    return follows(read_bytes("x.ls", "/MN\n1: L P[1] 10mm/sec FINE ;\n" + between +
                                          "3: L P[2] 10mm/sec FINE ;\n/POS\n/END\n"));
  };
  EXPECT_TRUE(fanuc("2: WAIT 1.00(sec) ;\n"));
  for (const char* between : {"2: LBL[1] ;\n", "2: ENDIF ;\n", "2: ELSE ;\n", "2: ENDFOR ;\n"})
    EXPECT_FALSE(fanuc(between)) << between;
}

const std::string kTarget = "[[1,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]";

TEST(Doubts, AWorkObjectBehindACommaIsThatOfTheMove) {
  const auto frame = [](const std::string& end) {
    return first_move(read_bytes("x.mod", "MODULE m\nCONST robtarget p:=" + kTarget +
                                              ";\nPROC a()\nMoveL p,v100,fine,tool0" + end +
                                              ";\nENDPROC\nENDMODULE\n"))
        .frame;
  };
  EXPECT_EQ(frame("\\WObj:=wT"), "wt");
  EXPECT_EQ(frame(",\\WObj:=wT"), "wt");
  EXPECT_EQ(frame(""), "wobj0");
}

TEST(Doubts, AToolOfARoutineOrOfAnotherModuleIsNotThatOfTheMove) {
  const std::string tool =
      "PERS tooldata g:=[TRUE,[[0,0,9],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];\n";
  const std::string moves = "CONST robtarget p:=" + kTarget +
                            ";\nPROC main()\nMoveL p,v100,fine,g;\nENDPROC\nENDMODULE\n";
  const Program own = read_bytes("a.mod", "MODULE a\nPROC b()\n" + tool + "ENDPROC\n" + moves);
  EXPECT_TRUE(own.tools.at("g").moving);
  const auto with = [&](const std::string& scope) {
    return read_together(".mod",
                         {"MODULE a\n" + moves, "MODULE b\n" + scope + tool + "ENDMODULE\n"})[0]
        .tools.contains("g");
  };
  EXPECT_TRUE(with(""));
  EXPECT_FALSE(with("LOCAL "));
}

TEST(Doubts, AnApostropheHidesNothingBehindIt) {
  const Program p = read_bytes(
      "x.ls",
      "/MN\n1: MESSAGE[DON'T WAIT] ;\n2: SOFTFLOAT[1] ;\n3:L P[1] 9mm/sec FINE ;\n/POS\n"
      "P[1]{\nGP1:\nUF : 0, UT : 1, CONFIG : 'N U T, 0, 0, 0',\nX = 1 mm, Y = 2 mm, Z = 3 mm,\n"
      "W = 4 deg, P = 5 deg, R = 6 deg\n};\n/END\n");
  EXPECT_NE(named(p, "P[1]").why, "");
  EXPECT_EQ(named(p, "P[1]").configuration.side, 'n');
}

TEST(Doubts, TheInverseOfAStatedPoseIsAMoveToIt) {
  const Program p = read_bytes(
      "x.script",
      "def x():\n movej(get_inverse_kin(p[1,2,3,0,0,0], qnear=[0,1.5,0,0,0,0]), a=1)\nend\n");
  const Move move = first_move(p);
  ASSERT_EQ(move.joints_deg.size(), 6U);
  EXPECT_NEAR(move.joints_deg[1], 1.5 * 180.0 / 3.14159265358979, 1e-9);
  EXPECT_EQ(values_of(p.targets[static_cast<std::size_t>(move.target)].written)[2], 3.0);
}

}  // namespace
}  // namespace plumb::offline::programs

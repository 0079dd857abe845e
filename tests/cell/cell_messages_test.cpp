// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdio>

#include "cell/cell.hpp"
#include "support.hpp"

namespace plumb::offline {
namespace {

const std::string kRobot =
    "schema = \"cell/1\"\n"
    "[robot]\n"
    "dh_convention = \"standard\"\n"
    "joints = [{ name = \"J1\", a = 100, q = [-90, 90] }, { name = \"J2\", q = [-90, 90] }]\n";

std::vector<Problem> problems_in(const std::string& text) {
  return problems_of([&] { parse_cell(text, "/c/cell.toml"); });
}

std::vector<Problem> remarks_in(const std::string& text) {
  return parse_cell(text, "/c/cell.toml").remarks;
}

/// The problem of a robot's file with one more line, the fifth.
Summary with(const std::string& line) { return summary(problems_in(kRobot + line + "\n")); }

Summary with_joint(const std::string& joint) {
  return summary(
      problems_in("schema = \"cell/1\"\n[robot]\ndh_convention = \"standard\"\njoints = [\n" +
                  joint + "\n]\n"));
}

TEST(CellMessage, IsRenderedWithCaretAndRemedy) {
  const Folder folder;
  const auto file = folder.put("cell.toml", kRobot + "[cell]\ntolerence_mm = 0.1\n");
  const auto problems = problems_of([&] { read_cell(file); });
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(render(problems[0]),
            "error[E-CELL-KEY]: unknown key 'cell.tolerence_mm'\n"
            "  --> " +
                file.string() +
                ":6:1\n"
                "   |\n"
                " 6 | tolerence_mm = 0.1\n"
                "   | ^^^^^^^^^^^^ did you mean 'tolerance_mm'?\n"
                "   = help: rename it to 'tolerance_mm'");
}

TEST(CellMessage, OfBrokenTomlPointsAtIt) {
  EXPECT_EQ(summary(problems_in("schema = \"cell/1\"\na = [1, 2\nb = 3\n")), Summary{"E-TOML 3:1"});
  EXPECT_EQ(summary(problems_in("a = 1\na = 2\n")), Summary{"E-TOML 2:5"});
  EXPECT_EQ(summary(problems_in("a = \"\xFC\"\n")), Summary{"E-TOML 1:5"});
}

TEST(CellMessage, OfMissingKeysSaysWhereTheyBelong) {
  EXPECT_EQ(summary(problems_in("")), (Summary{"E-CELL-MISSING 1:1", "E-CELL-MISSING 1:1"}));
  const auto problems = problems_in("\nschema = \"cell/1\"\n[robot]\n");
  EXPECT_EQ(summary(problems), (Summary{"E-CELL-MISSING 3:1", "E-CELL-MISSING 3:1"}));
  EXPECT_EQ(problems[0].message, "'robot.dh_convention' is missing");
  EXPECT_EQ(problems[1].message, "'robot.joints' is missing");
}

TEST(CellMessage, OfAnotherSchema) {
  EXPECT_EQ(summary(problems_in("schema = \"cell/2\"" + kRobot.substr(17))),
            Summary{"E-CELL-SCHEMA 1:10"});
}

TEST(CellMessage, OfUnknownKeysAnywhere) {
  EXPECT_EQ(with("foo = 1"), Summary{"E-CELL-KEY 5:1"});
  EXPECT_EQ(with("[cel]"), Summary{"E-CELL-KEY 5:2"});
  EXPECT_EQ(with("payload = { kg = 1 }"), Summary{"E-CELL-KEY 5:13"});
  EXPECT_EQ(with("base = { xyz = [0,0,0], quat = 1 }"), Summary{"E-CELL-KEY 5:25"});
  EXPECT_EQ(with("[measurement]\nfiles = [\"a.csv\"]\nsigma_mm = 1"), Summary{"E-CELL-KEY 7:1"});
  EXPECT_EQ(with("[fit]\nmodle = \"dh\""), Summary{"E-CELL-KEY 6:1"});
  EXPECT_EQ(with("[deploy]\ncycle_ms = 4"), Summary{"E-CELL-KEY 6:1"});
  EXPECT_EQ(with("[[robot.links]]\njoint = \"J1\"\nmass = 1"), Summary{"E-CELL-KEY 7:1"});
  EXPECT_EQ(with("[effects.local_tree]\nleaves = 3"), Summary{"E-CELL-KEY 6:1"});
}

TEST(CellMessage, OfWrongTypes) {
  EXPECT_EQ(with("name = 3"), Summary{"E-CELL-TYPE 5:8"});
  EXPECT_EQ(with("gravity = [0, 0]"), Summary{"E-CELL-TYPE 5:11"});
  EXPECT_EQ(with("gravity = [0, \"g\", 0]"), Summary{"E-CELL-TYPE 5:15"});
  EXPECT_EQ(with("gravity = [0, nan, 0]"), Summary{"E-CELL-TYPE 5:15"});
  EXPECT_EQ(with("base = [0, 0, 0]"), Summary{"E-CELL-TYPE 5:8"});
  EXPECT_EQ(with("[measurement]\nfiles = \"a.csv\""), Summary{"E-CELL-TYPE 6:9"});
  EXPECT_EQ(with("[measurement]\nfiles = [\"a.csv\", 3]"), Summary{"E-CELL-TYPE 6:19"});
  EXPECT_EQ(with("[effects]\ngeometry = \"yes\""), Summary{"E-CELL-TYPE 6:12"});
  EXPECT_EQ(with("[effects]\nlocal_tree = 3"), Summary{"E-CELL-TYPE 6:14"});
  EXPECT_EQ(with_joint("{ a = \"1\" }"), Summary{"E-CELL-TYPE 5:7"});
  EXPECT_EQ(with_joint("{ parallel_next = 1 }"), Summary{"E-CELL-TYPE 5:19"});
  EXPECT_EQ(with_joint("3"), Summary{"E-CELL-TYPE 5:1"});
  EXPECT_EQ(summary(problems_in("schema = 1\nrobot = 2\n")),
            (Summary{"E-CELL-TYPE 1:10", "E-CELL-TYPE 2:9"}));
}

TEST(CellMessage, OfJointsOutOfRange) {
  EXPECT_EQ(with_joint("{ q = [3, 2] }"), Summary{"E-CELL-RANGE 5:7"});
  EXPECT_EQ(with_joint("{ q = [2, 2] }"), Summary{"E-CELL-RANGE 5:7"});
  EXPECT_EQ(with_joint("{ alpha = inf }"), Summary{"E-CELL-RANGE 5:11"});
  EXPECT_EQ(with_joint("{ d = nan }"), Summary{"E-CELL-RANGE 5:7"});
  EXPECT_EQ(with_joint("{ scale = 0 }"), Summary{"E-CELL-RANGE 5:11"});
  EXPECT_EQ(with_joint("{ gear_ratio = -1 }"), Summary{"E-CELL-RANGE 5:16"});
  EXPECT_EQ(with_joint("{ name = \"J1\" }, { name = \"J1\" }"), Summary{"E-CELL-RANGE 5:27"});
  EXPECT_EQ(with_joint("{ name = \"J2\" }, { }"), Summary{"E-CELL-RANGE 5:18"});  // J2 by default
  EXPECT_EQ(with_joint("{ name = \"a.b\" }"), Summary{"E-CELL-RANGE 5:10"});
  EXPECT_EQ(with_joint("{ type = \"prismatc\" }"), Summary{"E-CELL-RANGE 5:10"});
  EXPECT_EQ(with_joint(""), Summary{"E-CELL-RANGE 4:10"});
  EXPECT_EQ(with_joint("{},{},{},{},{},{},{},{},{},{}"), Summary{"E-CELL-RANGE 4:10"});
  EXPECT_TRUE(with_joint("{},{},{},{},{},{},{},{},{}").empty());
}

TEST(CellMessage, OfWordsThatAreNoChoice) {
  EXPECT_EQ(with("length_unit = \"deg\""), Summary{"E-CELL-RANGE 5:15"});
  EXPECT_EQ(with("angle_unit = \"grad\""), Summary{"E-CELL-RANGE 5:14"});
  EXPECT_EQ(with("[fit]\nmodel = \"DH\""), Summary{"E-CELL-RANGE 6:9"});
  const auto problems =
      problems_in("schema = \"cell/1\"\n[robot]\ndh_convention = \"modifed\"\njoints = [{}]\n");
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].help, "dh_convention = \"modified\"");
}

TEST(CellMessage, OfSettingsOutOfRange) {
  const auto measured = [](const std::string& line) { return with("[measurement]\n" + line); };
  EXPECT_EQ(measured("sigma_um = 0"), Summary{"E-CELL-RANGE 6:12"});
  EXPECT_EQ(measured("sigma_urad = -1"), Summary{"E-CELL-RANGE 6:14"});
  EXPECT_EQ(measured("seed = 1.5"), Summary{"E-CELL-RANGE 6:8"});
  EXPECT_EQ(measured("seed = -1"), Summary{"E-CELL-RANGE 6:8"});
  EXPECT_EQ(measured("frame = \"given\""), Summary{"E-CELL-RANGE 6:9"});
  EXPECT_EQ(measured("target = \"\""), Summary{"E-CELL-RANGE 6:10"});
  EXPECT_EQ(measured("files = [\"a.csv\", \"./a.csv\"]"), Summary{"E-CELL-RANGE 6:19"});
  EXPECT_EQ(measured("files = [\"\"]"), Summary{"E-CELL-RANGE 6:10"});
  EXPECT_EQ(with("[cell]\ntolerance_mm = 0"), Summary{"E-CELL-RANGE 6:16"});
  EXPECT_EQ(with("payload = { mass_kg = -1 }"), Summary{"E-CELL-RANGE 5:23"});
  EXPECT_EQ(with("[deploy]\ncycle_us = 1"), Summary{"E-CELL-RANGE 6:12"});
  EXPECT_EQ(with("[deploy]\nmax_correction_mm = 0"), Summary{"E-CELL-RANGE 6:21"});
  EXPECT_EQ(with("[deploy]\nlink = \"cam\""), Summary{"E-CELL-RANGE 6:8"});
  EXPECT_EQ(with("[deploy]\ninterface = \"\""), Summary{"E-CELL-RANGE 6:13"});
  for (const char* address :
       {"", "10.0.0.7:", ":1502", "10.0.0.7:0", "10.0.0.7:x", "10.0.0.7:65536"})
    EXPECT_EQ(with(fmt::format("[deploy]\naddress = \"{}\"", address)),
              Summary{"E-CELL-RANGE 6:11"})
        << address;
  for (const char* address : {"10.0.0.7", "10.0.0.7:1502", "fe80::1"})
    EXPECT_EQ(with(fmt::format("[deploy]\naddress = \"{}\"", address)), Summary{}) << address;
  EXPECT_EQ(with("[deploy.bus]\nbit_rate = 0"), Summary{"E-CELL-BUS 6:12"});
  EXPECT_EQ(with("[deploy.bus.target]\ncan_id = 0x800"), Summary{"E-CELL-BUS 6:10"});
  EXPECT_EQ(with("[deploy.bus]\nbitrate = 1"), Summary{"E-CELL-KEY 6:1"});
  EXPECT_EQ(with("[effects.local_tree]\nmin_gain = \"2\""), Summary{"E-CELL-RANGE 6:12"});
  EXPECT_EQ(with("[effects.local_tree]\nform = \"smooth\""), Summary{"E-CELL-RANGE 6:8"});
  EXPECT_EQ(with("[effects.local_tree]\nsplits = \"both\""), Summary{"E-CELL-RANGE 6:10"});
  EXPECT_EQ(with("[effects.local_tree]\ndegree = 3"), Summary{"E-CELL-RANGE 6:10"});
}

TEST(CellMessage, OfHeldOutRulesThatAreNone) {
  for (const char* rule :
       {"", "20", "0%", "100%", "-5%", "nan%", "2 %", "kfold", "kfold:", "kfold:1", "kfold:101",
        "kfold:5x", "column:", "column:fold", "file:", "Auto"})
    EXPECT_EQ(with("[measurement]\nheld_out = \"" + std::string(rule) + "\""),
              Summary{"E-CELL-HELD 6:12"})
        << rule;
}

TEST(CellMessage, OfUnknownJoints) {
  EXPECT_EQ(with("[[robot.links]]\njoint = \"J3\""), Summary{"E-CELL-JOINT 6:9"});
  EXPECT_EQ(with("[fit]\nfixed = [\"J1.d\", \"J9.d\"]"), Summary{"E-CELL-JOINT 6:18"});
  EXPECT_EQ(with("[effects.local_tree]\njoints = [\"J1\", \"j2\"]"), Summary{"E-CELL-JOINT 6:17"});
  EXPECT_EQ(with("[fit]\nfixed = [\"J1.q\"]"), Summary{"E-CELL-RANGE 6:10"});
  EXPECT_EQ(with("[fit]\nfixed = [\"frame.w\"]"), Summary{"E-CELL-RANGE 6:10"});
  EXPECT_TRUE(with("[fit]\nfixed = [\"J1.beta\", \"frame.rx\", \"J2.post.ez\"]").empty());
  EXPECT_EQ(with("[[robot.links]]\njoint = \"J1\"\n[[robot.links]]\njoint = \"J1\""),
            Summary{"E-CELL-RANGE 8:9"});
  EXPECT_EQ(with("[[robot.links]]\nmass_kg = 1"), Summary{"E-CELL-MISSING 5:1"});
}

TEST(CellMessage, OfOptionsThatMakeNoSense) {
  const auto code = [](const std::string& effect, const std::string& option) {
    const auto problems = with("[effects." + effect + "]\n" + option);
    return problems.empty() ? std::string() : problems.front();
  };
  for (const char* cycles : {"0", "-3", "1e6"})
    EXPECT_EQ(code("gear_ripple", std::string("cycles_per_turn = ") + cycles), "E-CELL-RANGE 6:19");
  EXPECT_EQ(code("joint_compliance_soft", "torque_Nm = 0"), "E-CELL-RANGE 6:13");
  EXPECT_EQ(code("backlash_load", "torque_Nm = -50"), "E-CELL-RANGE 6:13");
  EXPECT_EQ(code("drift", "settling_s = 0"), "E-CELL-RANGE 6:14");
  EXPECT_EQ(code("gravity_compensator", "anchor_ratio = 1e9"), "E-CELL-RANGE 6:16");
  EXPECT_EQ(code("step", "after_row = 0"), "E-CELL-RANGE 6:13");
  EXPECT_EQ(code("step", "after_row = 8.5"), "E-CELL-RANGE 6:13");
  EXPECT_EQ(with("[effects.step]\nafter_row = 8\nof = \"tol\""), Summary{"E-CELL-RANGE 7:6"});
  EXPECT_EQ(with("[effects.step]\nafter_row = 8"), Summary{});
  EXPECT_EQ(with("[effects]\ngear_ripple = true"), Summary{"E-CELL-MISSING 6:15"});
  EXPECT_EQ(with("[effects]\nstep = true"), Summary{"E-CELL-MISSING 6:8"});
}

TEST(CellMessage, OfJointsThatAnEffectCannotHave) {
  for (const char* effect : {"drift", "tracker", "tool_sag", "base_compliance", "local_tree"})
    EXPECT_EQ(with(std::string("[effects.") + effect + "]\njoints = [\"J1\"]"),
              Summary{"E-CELL-JOINT 6:10"})
        << effect;
  EXPECT_EQ(with("[effects.cross_compliance]"), Summary{"E-CELL-JOINT 5:1"});
  EXPECT_EQ(with("[effects]\ncross_compliance = true"), Summary{"E-CELL-JOINT 6:20"});
  EXPECT_EQ(with("[effects.cross_compliance]\njoints = [\"J1\", \"J1\"]"),
            Summary{"E-CELL-JOINT 6:10"});
  EXPECT_EQ(with("[effects.rail_bow]"), Summary{"E-CELL-JOINT 5:1"});
  EXPECT_EQ(with("[effects]\nrail_bow = true"), Summary{"E-CELL-JOINT 6:12"});
  EXPECT_EQ(with("[effects.rail_bow]\njoints = [\"J1\"]"), Summary{"E-CELL-JOINT 6:10"});
  EXPECT_EQ(with("[effects.drive_coupling]"), Summary{"E-CELL-JOINT 5:1"});
  EXPECT_EQ(with("[effects.joint_compliance]\njoints = [\"J1\", \"J1\"]"),
            Summary{"E-CELL-JOINT 6:10"});
  EXPECT_EQ(with("[effects.step]\nafter_row = 3\njoints = [\"J1\"]"), Summary{"E-CELL-JOINT 7:10"});
  EXPECT_EQ(with("[effects.step]\nafter_row = 3\nof = \"joint\""), Summary{"E-CELL-JOINT 5:1"});
  EXPECT_EQ(with("[effects.step]\nafter_row = 3\nof = \"joint\"\njoints = [\"J1\"]"), Summary{});
}

TEST(CellMessage, OfCouplingsThatNoControllerHas) {
  const auto coupled = [](const std::string& text) {
    return summary(problems_in("schema = \"cell/1\"\n[robot]\ndh_convention = \"standard\"\n" +
                               text +
                               "\njoints = [{ q = [-90, 90] }, { q = [-90, 90] },\n{ type = "
                               "\"prismatic\", q = [0, 9] }]\n"));
  };
  const auto pair = [&](const std::string& joint, const std::string& of, const char* share) {
    return "{joint=\"" + joint + "\", of=\"" + of + "\", share=" + share + "}";
  };
  const auto list = [&](const std::string& entries) {
    return coupled("coupling=[" + entries + "]");
  };
  EXPECT_EQ(list(pair("J2", "J1", "1")), Summary{});
  EXPECT_EQ(list(pair("J2", "J1", "-0.5")), Summary{});
  EXPECT_EQ(list(""), Summary{});
  EXPECT_EQ(list(pair("J2", "J7", "1")), Summary{"E-CELL-JOINT 4:27"});
  EXPECT_EQ(list("{ joint = \"J2\", share = 1 }"), Summary{"E-CELL-MISSING 4:11"});
  EXPECT_EQ(list("{ joint = \"J2\", of = \"J1\" }"), Summary{"E-CELL-MISSING 4:11"});
  EXPECT_EQ(list(pair("J2", "J1", "0")), Summary{"E-CELL-RANGE 4:39"});
  EXPECT_EQ(list(pair("J2", "J1", "11")), Summary{"E-CELL-RANGE 4:39"});
  EXPECT_EQ(list(pair("J3", "J1", "1")), Summary{"E-CELL-RANGE 4:27"});
  EXPECT_EQ(list(pair("J2", "J1", "1") + "," + pair("J2", "J1", "1")),
            Summary{"E-CELL-RANGE 4:58"});
  EXPECT_EQ(list(pair("J2", "J1", "1") + "," + pair("J1", "J2", "1")),
            Summary{"E-CELL-RANGE 4:10"});
  EXPECT_EQ(list(pair("J1", "J1", "1")), Summary{"E-CELL-RANGE 4:10"});
  EXPECT_EQ(coupled("coupling = { \"J2,J1\" = 1 }").size(), 1U);
  EXPECT_EQ(summary(problems_in("schema = \"cell/1\"\n[robot]\ndh_convention = \"standard\"\n"
                                "joints = [{ q = [-90, 90] }, { q = [-90, 90] }]\n"
                                "[[robot.coupling]]\njoint = \"J2\"\nof = \"J1\"\nshare = 1\n")),
            Summary{"E-CELL-RANGE 5:1"});
}

TEST(CellMessage, OfConventionsByOtherNames) {
  for (const auto& [word, meant] :
       std::vector<std::pair<std::string, std::string>>{{"craig", "modified"},
                                                        {"Craig", "modified"},
                                                        {"proximal", "modified"},
                                                        {"distal", "standard"},
                                                        {"classic", "standard"}}) {
    const auto problems = problems_in("schema = \"cell/1\"\n[robot]\ndh_convention = \"" + word +
                                      "\"\njoints = [{ q = [-90, 90] }]\n");
    ASSERT_EQ(summary(problems), Summary{"E-CELL-RANGE 3:17"}) << word;
    EXPECT_EQ(problems[0].help, "dh_convention = \"" + meant + "\"");
  }
}

TEST(CellMessage, OfUnknownEffects) {
  const auto problems = problems_in(kRobot + "[effects]\nlocal_tre = true\nzzzzzz = {}\n");
  EXPECT_EQ(summary(problems), (Summary{"E-CELL-EFFECT 6:13", "E-CELL-EFFECT 7:10"}));
  EXPECT_EQ(problems[0].place->label, "did you mean 'local_tree'?");
}

TEST(CellMessage, OfPriors) {
  EXPECT_EQ(with("[fit]\nprior = 1"), Summary{"E-CELL-TYPE 6:9"});
  EXPECT_EQ(with("[fit]\nprior = { \"J1.q\" = 1 }"), Summary{"E-CELL-RANGE 6:20"});
  EXPECT_EQ(with("[fit]\nprior = { \"J1.d\" = 0 }"), Summary{"E-CELL-RANGE 6:20"});
  EXPECT_EQ(with("[fit]\nprior = { \"frame.x\" = 1 }"), Summary{"E-CELL-RANGE 6:23"});
  EXPECT_TRUE(with("[fit]\nprior = { \"J1.d\" = 0.1, \"J1.alpha\" = 0.02 }").empty());
  EXPECT_TRUE(with("[fit]\nprior_mm = 0.2\nprior_mrad = 0").empty());
  EXPECT_EQ(with("[fit]\nprior_mm = -1"), Summary{"E-CELL-RANGE 6:12"});
  EXPECT_EQ(with("[fit]\nprior_mrad = \"wide\""), Summary{"E-CELL-TYPE 6:14"});
}

TEST(CellMessage, OfAllProblemsComesInTheOrderOfTheFile) {
  EXPECT_EQ(
      summary(problems_in("schema = \"cell/1\"\nx = 1\n[robot]\njoints = [{ q = [1, 0], b = 2 }]\n"
                          "[fit]\nmodel = 3\n[cell]\ntolerance_mm = -1\n")),
      (Summary{"E-CELL-KEY 2:1", "E-CELL-MISSING 3:1", "E-CELL-RANGE 4:17", "E-CELL-KEY 4:25",
               "E-CELL-TYPE 6:9", "E-CELL-RANGE 8:16"}));
}

TEST(CellMessage, NotesAssumedLimits) {
  const auto remarks = remarks_in(
      "schema = \"cell/1\"\n[robot]\ndh_convention = \"standard\"\n"
      "joints = [{}, { type = \"prismatic\" }, { q = [-90, 90] }]\n");
  ASSERT_EQ(summary(remarks), Summary{"N-CELL-LIMITS 4:10"});
  EXPECT_EQ(remarks[0].message, "no q limits for J1, J2: ±360° or ±10 m are assumed");
}

TEST(CellText, KnowsWhichLimitsAreAssumedAndWritesThemOutAsNotGiven) {
  const Folder folder;
  const auto file = folder.put("cell.toml",
                               "schema = \"cell/1\"\n[robot]\ndh_convention = \"standard\"\n"
                               "joints = [{}, { type = \"prismatic\" }, { q = [-90, 90] }]\n");
  const Cell cell = read_cell(file);
  const std::vector<bool> assumed{true, true, false};
  EXPECT_EQ(cell.assumed_limits, assumed);
  const Cell back = parse_cell(write_cell(cell), file);
  EXPECT_EQ(back.assumed_limits, assumed);
  EXPECT_EQ(back.nominal, cell.nominal);
}

TEST(CellMessage, WarnsOfNumbersInAnotherUnit) {
  const auto warned = [](const std::string& units, const std::string& joint) {
    return summary(remarks_in("schema = \"cell/1\"\n[robot]\ndh_convention = \"standard\"\n" +
                              units + "\njoints = [{ q = [-1, 1e1], " + joint + " }]\n"));
  };
  EXPECT_EQ(warned("angle_unit = \"rad\"", "alpha = -90"), Summary{"W-CELL-ANGLE 5:36"});
  EXPECT_EQ(warned("angle_unit = \"deg\"", "alpha = -1.5708"), Summary{"W-CELL-ANGLE 5:36"});
  EXPECT_EQ(warned("length_unit = \"m\"", "a = -612"), Summary{"W-CELL-LENGTH 5:32"});
  EXPECT_EQ(warned("length_unit = \"mm\"", "a = -612, alpha = 90, theta = 180"), Summary{});
  EXPECT_EQ(summary(remarks_in("schema = \"cell/1\"\n[robot]\ndh_convention = \"standard\"\n"
                               "joints = [{ q = [-3.14, 3.14] }]\n")),
            Summary{"W-CELL-ANGLE 4:17"});
}

TEST(CellMessage, OfNoCellAtAll) {
  const Folder folder;
  EXPECT_EQ(summary(problems_of([&] { find_cell(folder.path()); })), Summary{"E-CELL-NONE 0:0"});
  EXPECT_EQ(summary(problems_of([&] { read_cell(folder.path() / "cell.toml"); })),
            Summary{"E-READ 0:0"});
  const auto file = folder.put("cell.toml", "");
  std::filesystem::create_directories(folder.path() / "a" / "b");
  EXPECT_EQ(find_cell(folder.path() / "a" / "b"), file);
}

}  // namespace
}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>

#include "cell/cell.hpp"
#include "plumb/runtime/chain.hpp"
#include "plumb/runtime/coupling.hpp"
#include "tests/import/temporary_file.hpp"
#include "tests/random_numbers.hpp"
#include "urdf/urdf_reader.hpp"
#include "urdf/urdf_writer.hpp"

namespace plumb::offline {
namespace {

using tests::Random;
using tests::scaled;

/// An arm drawn joint by joint; KDL is built from the same numbers, never from our reader.
struct RandomArm {
  KDL::Chain kdl;
  std::string urdf = "<robot name=\"random\">\n  <link name=\"l0\"/>\n";
  int moving = 0;

  explicit RandomArm(std::uint64_t seed) {
    Random dice(seed);
    const int joints = 1 + dice.below(9);
    for (int i = 0; i < joints + 2; ++i) {
      // Square angles, parallel and collinear axes are the usual case; so are rounded ones.
      const auto angle = [&] {
        const int kind = dice.below(4);
        if (kind == 0) return 0.0;
        if (kind == 1) return M_PI_2 * (dice.below(4) - 1);
        return kind == 2 ? 1.5707963 * (dice.below(3) - 1) : dice.uniform(-3, 3);
      };
      const auto length = [&] { return dice.below(3) == 0 ? 0.0 : dice.uniform(-0.5, 0.5); };
      const double x = length(), y = length(), z = length(), r = angle(), p = angle(), w = angle();
      const bool fixed = i >= joints || dice.below(6) == 0;
      const bool slides = dice.below(5) == 0;
      double axis[3] = {0, 0, dice.below(2) == 0 ? 1.0 : -1.0};
      if (dice.below(4) == 0)
        for (double& a : axis) a = dice.uniform(-1, 1);
      urdf += fmt::format(
          "  <link name=\"l{}\"><inertial><mass value=\"{}\"/><origin xyz=\"0.1 0 0\"/>"
          "<inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" "
          "izz=\"1\"/></inertial></link>\n"
          "  <joint name=\"j{}\" type=\"{}\"><origin xyz=\"{} {} {}\" rpy=\"{} {} {}\"/>"
          "<parent link=\"l{}\"/><child link=\"l{}\"/><axis xyz=\"{} {} {}\"/>"
          "<limit lower=\"-2\" upper=\"2\" effort=\"1\" velocity=\"1\"/></joint>\n",
          i + 1, i + 1.5, i + 1,
          fixed    ? "fixed"
          : slides ? "prismatic"
                   : "revolute",
          x, y, z, r, p, w, i, i + 1, axis[0], axis[1], axis[2]);
      const KDL::Frame origin(KDL::Rotation::RPY(r, p, w), KDL::Vector(x, y, z));
      kdl.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::None), origin));
      if (fixed) continue;
      const KDL::Vector direction(axis[0], axis[1], axis[2]);
      kdl.addSegment(
          KDL::Segment(KDL::Joint("", KDL::Vector::Zero(), direction,
                                  slides ? KDL::Joint::TransAxis : KDL::Joint::RotAxis)));
      ++moving;
    }
    urdf += "</robot>\n";
  }
};

/// Largest difference of the two forward kinematics over some poses [m], and of rotations.
double worst_difference(const KDL::Chain& kdl, const format::Chain& ours, Random& dice) {
  KDL::ChainFkSolverPos_recursive solver(kdl);
  const Chain chain(ours);
  const auto n = static_cast<unsigned>(chain.joints());
  double worst = 0.0;
  for (int k = 0; k < 5; ++k) {
    KDL::JntArray q(n);
    std::vector<double> own;
    for (unsigned j = 0; j < n; ++j) own.push_back(q(j) = dice.uniform(-2, 2));
    KDL::Frame there;
    solver.JntToCart(q, there);
    const Transformd X = chain.forward(own);
    for (int i = 0; i < 3; ++i) {
      worst = std::max(worst, std::abs(X.p(i) - there.p(i)));
      for (int j = 0; j < 3; ++j) worst = std::max(worst, std::abs(X.R(i, j) - there.M(i, j)));
    }
  }
  return worst;
}

TEST(Urdf, BecomesDhRowsWithTheSameForwardKinematics) {
  const long arms = scaled(400);
  const tests::TemporaryFolder folder;
  int read = 0;
  double worst = 0.0;
  for (long seed = 1; seed <= arms; ++seed) {
    const RandomArm arm(seed);
    if (arm.moving == 0) continue;
    const auto file = folder.put("arm.urdf", arm.urdf);
    for (const auto convention : {format::Convention::kStandard, format::Convention::kModified}) {
      const Cell cell = read_urdf(file, {}, convention);
      ASSERT_EQ(cell.joints(), arm.moving);
      Random dice(seed);
      const double difference = worst_difference(arm.kdl, cell.nominal, dice);
      EXPECT_LT(difference, 1e-9) << "seed " << seed << "\n" << arm.urdf;
      worst = std::max(worst, difference);
      ++read;
    }
  }
  std::printf("%d arms, worst difference %.1e\n", read, worst);
}

TEST(Urdf, WrittenAndReadAgainIsTheSameArm) {
  const tests::TemporaryFolder folder;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const RandomArm arm(seed);
    if (arm.moving == 0) continue;
    Cell cell = read_urdf(folder.put("arm.urdf", arm.urdf), {}, format::Convention::kStandard);
    Random dice(seed);
    for (auto& row : cell.nominal.joints) {
      row.alpha += dice.uniform(-1e-3, 1e-3);
      row.beta += dice.uniform(-1e-3, 1e-3);
      row.post.d = {dice.uniform(-1e-3, 1e-3), 0, 1e-4};
      row.offset = dice.uniform(-1e-3, 1e-3);
    }
    const Cell again = read_urdf(folder.put("out.urdf", write_urdf("R&D <arm>", cell.nominal)),
                                 {.tip = "tool0"}, format::Convention::kModified);
    const Chain a(cell.nominal), b(again.nominal);
    std::vector<double> q;
    for (int j = 0; j < cell.joints(); ++j) q.push_back(dice.uniform(-2, 2));
    EXPECT_LT((a.forward(q).p - b.forward(q).p).norm(), 1e-9);
  }
}

TEST(Urdf, ACellWrittenFromItReadsBackToTheSameArm) {
  const tests::TemporaryFolder folder;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const RandomArm arm(seed);
    if (arm.moving == 0) continue;
    Cell cell = read_urdf(folder.put("arm.urdf", arm.urdf), {}, format::Convention::kModified);
    cell.measurement.files = {"/cell/measurements.csv"};
    cell.directory = "/cell";
    const Cell again = parse_cell(write_cell(cell), "/cell/cell.toml");
    Random dice(seed);
    EXPECT_LT(worst_difference(arm.kdl, again.nominal, dice), 1e-9) << write_cell(cell);
  }
}

TEST(Urdf, MassesOfFixedChildrenHangOnTheJointAheadOfThem) {
  const tests::TemporaryFolder folder;
  const RandomArm arm(7);
  const Cell cell = read_urdf(folder.put("arm.urdf", arm.urdf), {}, format::Convention::kStandard);
  double sum = 0.0;
  for (const auto& m : cell.mechanics) sum += m.link_mass_kg.value_or(0.0);
  double expected = 0.0;
  bool moving = false;
  for (std::size_t at = 0; (at = arm.urdf.find("<joint", at)) != std::string::npos; ++at) {
    const auto type = arm.urdf.find("type=\"", at) + 6;
    moving = moving || arm.urdf.compare(type, 5, "fixed") != 0;
    const auto mass = arm.urdf.rfind("mass value=\"", at) + 12;
    if (moving) expected += std::stod(arm.urdf.substr(mass));
  }
  EXPECT_NEAR(sum, expected, 1e-9);
}

std::string refusal(const std::string& urdf, const std::string& tip = "") {
  const tests::TemporaryFolder folder;
  try {
    (void)read_urdf(folder.put("arm.urdf", urdf), {.tip = tip}, format::Convention::kStandard);
  } catch (const Failure& f) {
    EXPECT_EQ(f.exit_code(), Exit::kInput);
    EXPECT_FALSE(f.problems().front().help.empty());
    return f.problems().front().code;
  }
  return "accepted";
}

std::string link(const std::string& name) { return "<link name=\"" + name + "\"/>"; }
std::string joint(const std::string& name, const std::string& parent, const std::string& child,
                  const std::string& inside = "", const std::string& type = "continuous") {
  return fmt::format(
      "<joint name=\"{}\" type=\"{}\"><parent link=\"{}\"/><child link=\"{}\"/>{}</joint>", name,
      type, parent, child, inside);
}
std::string robot(const std::string& inside) { return "<robot name=\"a\">" + inside + "</robot>"; }

TEST(Urdf, WhatIsNestedOrChainedTooDeepIsRefusedBeforeAnyParserRecurses) {
  std::string nested, chain = link("l0");
  for (int i = 0; i < 50000; ++i) nested += "<a>";
  for (int i = 0; i < 50000; ++i) nested += "</a>";
  EXPECT_EQ(refusal(robot(link("l") + nested)), "E-URDF-SIZE");
  EXPECT_EQ(refusal(nested.substr(0, nested.size() / 2)), "E-URDF-SIZE");
  for (int i = 0; i < 50000; ++i)
    chain += link(fmt::format("l{}", i + 1)) + joint(fmt::format("j{}", i), fmt::format("l{}", i),
                                                     fmt::format("l{}", i + 1), "", "fixed");
  EXPECT_EQ(refusal(robot(chain)), "E-URDF-SIZE");
  // What only looks deep is not: comments, quoted brackets, elements that close themselves.
  std::string flat = link("l") + link("m") + joint("j", "l", "m");
  for (int i = 0; i < 500; ++i) flat += "<!-- <a> --><gazebo x=\"&lt;a>\"/>";
  EXPECT_EQ(refusal(robot(flat)), "accepted");
}

TEST(Urdf, ALinkWithTwoParentsOrItsOwnAncestorEndsInAMessage) {
  const std::string links = link("r") + link("a") + link("b");
  EXPECT_EQ(
      refusal(robot(links + joint("i", "r", "a") + joint("j", "a", "b") + joint("k", "b", "a")),
              "b"),
      "E-URDF");
  for (const char* type : {"revolute", "fixed"}) {
    const std::string arm = link("c") + joint("i", "r", "a") + joint("j", "a", "b");
    EXPECT_EQ(
        refusal(robot(links + arm + joint("k", "b", "c") + joint("m", "r", "c", "", type)), "c"),
        "E-URDF");
    EXPECT_EQ(
        refusal(robot(links + joint("m", "r", "c", "", type) + arm + joint("k", "b", "c")), "c"),
        "E-URDF");
    // Beside the way to the tip, too: which of two places its mass hangs at is not said.
    EXPECT_EQ(
        refusal(robot(links + arm + joint("k", "a", "c") + joint("m", "r", "c", "", type)), "b"),
        "E-URDF");
  }
}

TEST(Urdf, AMimicJointStandsInTheWayOnlyOnTheWayToTheTip) {
  const std::string hand =
      link("l") + link("m") + link("finger") + joint("j", "l", "m") +
      joint("f", "m", "finger", "<origin xyz=\"0 0.1 0\"/><mimic joint=\"j\"/>");
  EXPECT_EQ(refusal(robot(hand), "m"), "accepted");
  const tests::TemporaryFolder folder;
  try {
    (void)read_urdf(folder.put("a.urdf", robot(hand)), {.tip = "finger"},
                    format::Convention::kStandard);
    FAIL() << "accepted";
  } catch (const Failure& f) {
    EXPECT_NE(f.problems().front().help.find("<mimic>"), std::string::npos);
    EXPECT_NE(f.problems().front().help.find("--tip"), std::string::npos);
  }
}

TEST(Urdf, LimitsThatTheFileDoesNotGiveAreAssumed) {
  const std::string limit = "<limit lower=\"-0.1\" upper=\"1.5\" effort=\"1\" velocity=\"1\"/>";
  const tests::TemporaryFolder folder;
  const Cell cell = read_urdf(
      folder.put("a.urdf",
                 robot(link("l") + link("m") + link("n") + link("o") + joint("j", "l", "m") +
                       joint("k", "m", "n", limit, "prismatic") + joint("i", "n", "o", limit))),
      {}, format::Convention::kStandard);
  EXPECT_EQ(cell.assumed_limits, (std::vector<bool>{true, false, true}));
  EXPECT_DOUBLE_EQ(cell.nominal.joints[1].q_min, -0.1);
  EXPECT_DOUBLE_EQ(cell.nominal.joints[1].q_max, 1.5);
}

TEST(Urdf, WhatIsNoSerialArmIsRefusedByName) {
  EXPECT_EQ(refusal("<robot"), "E-URDF");
  EXPECT_EQ(refusal("<robot name=\"a\"><link name=\"l\"/></robot>"), "E-URDF-JOINT");
  const std::string floating =
      "<robot name=\"a\"><link name=\"l\"/><link name=\"m\"/><joint name=\"j\" type=\"floating\">"
      "<parent link=\"l\"/><child link=\"m\"/></joint></robot>";
  EXPECT_EQ(refusal(floating), "E-URDF-JOINT");
  const std::string two =
      "<robot name=\"a\"><link name=\"l\"/><link name=\"m\"/><link name=\"n\"/>"
      "<joint name=\"j\" type=\"continuous\"><parent link=\"l\"/><child link=\"m\"/></joint>"
      "<joint name=\"k\" type=\"continuous\"><parent link=\"l\"/><child "
      "link=\"n\"/></joint></robot>";
  EXPECT_EQ(refusal(two), "E-URDF-TIP");
  EXPECT_EQ(refusal(two, "o"), "E-URDF-TIP");
  EXPECT_EQ(refusal(two, "n"), "accepted");
}

/// A joint behind an origin.
std::string placed(const std::string& name, const std::string& parent, const std::string& child,
                   const std::string& origin, const std::string& type = "continuous",
                   const std::string& more = "") {
  return joint(name, parent, child, "<origin " + origin + "/><axis xyz=\"0 1 0\"/>" + more, type);
}

std::string arm_of_three(const std::string& xyz, const std::string& rpy = "0 0 0") {
  return robot(link("w") + link("b") + link("m") + link("n") + link("o") +
               placed("base", "w", "b", "xyz=\"0 0 2\" rpy=\"3.141592653589793 0 0\"", "fixed") +
               placed("j", "b", "m", "xyz=\"" + xyz + "\" rpy=\"" + rpy + "\"") +
               placed("k", "m", "n", "xyz=\"0.3 0 0\"") + placed("i", "n", "o", "xyz=\"0 0 0.2\""));
}

/// A drawn arm some of whose joints mimic others, beside a joint about the same axis. KDL knows
/// nothing of mimicking: every joint of the file gets the position that the file says.
struct MimicArm {
  KDL::Chain kdl;
  std::string urdf = "<robot name=\"m\"><link name=\"l0\"/>";
  struct Moving {
    int leader = -1;  // itself: -1
    double multiplier = 1.0, offset = 0.0;
  };
  std::vector<Moving> moving;

  void add(const KDL::Frame& origin, bool slides, double sign, const Moving& one) {
    const std::size_t i = moving.size();
    double r = 0, p = 0, y = 0;
    origin.M.GetRPY(r, p, y);
    std::string inside = fmt::format(
        "<origin xyz=\"{} {} {}\" rpy=\"{} {} {}\"/><axis xyz=\"0 0 {}\"/>"
        "<limit lower=\"-1\" upper=\"2\" effort=\"1\" velocity=\"1\"/>",
        origin.p.x(), origin.p.y(), origin.p.z(), r, p, y, sign);
    if (one.leader >= 0)
      inside += fmt::format("<mimic joint=\"j{}\" multiplier=\"{}\" offset=\"{}\"/>", one.leader,
                            one.multiplier, one.offset);
    urdf += link(fmt::format("l{}", i + 1)) + joint(fmt::format("j{}", i), fmt::format("l{}", i),
                                                    fmt::format("l{}", i + 1), inside,
                                                    slides ? "prismatic" : "revolute");
    kdl.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::None), origin));
    kdl.addSegment(KDL::Segment(KDL::Joint("", KDL::Vector::Zero(), KDL::Vector(0, 0, sign),
                                           slides ? KDL::Joint::TransAxis : KDL::Joint::RotAxis)));
    moving.push_back(one);
  }

  /// Largest difference from our reading of the file over some poses [m].
  double difference(format::Convention convention, Random& dice) const {
    const tests::TemporaryFolder folder;
    Cell cell = read_urdf(folder.put("m.urdf", urdf + "</robot>"), {}, convention);
    cell.measurement.files = {"/cell/measurements.csv"};
    cell.directory = "/cell";
    cell = parse_cell(write_cell(cell), "/cell/cell.toml");
    KDL::ChainFkSolverPos_recursive solver(kdl);
    double worst = 0.0;
    for (int pose = 0; pose < 20; ++pose) {
      KDL::JntArray q(static_cast<unsigned>(moving.size()));
      std::vector<double> own;
      for (unsigned i = 0; i < moving.size(); ++i)
        if (moving[i].leader < 0) own.push_back(q(i) = dice.uniform(-1, 2));
      // A joint may mimic one that mimics a third one, in any order.
      for (std::size_t round = 0; round < moving.size(); ++round)
        for (unsigned i = 0; i < moving.size(); ++i)
          if (const Moving& m = moving[i]; m.leader >= 0)
            q(i) = m.multiplier * q(static_cast<unsigned>(m.leader)) + m.offset;
      KDL::Frame there;
      solver.JntToCart(q, there);
      EXPECT_EQ(own.size(), static_cast<std::size_t>(cell.joints()));
      Coupling(cell.nominal.coupling).to_angles(own);
      for (int i = 0; i < cell.joints(); ++i) {
        EXPECT_GE(own[i], cell.nominal.joints[i].q_min - 1e-9);
        EXPECT_LE(own[i], cell.nominal.joints[i].q_max + 1e-9);
      }
      const Transformd X = Chain(cell.nominal).forward(own);
      for (int i = 0; i < 3; ++i) {
        worst = std::max(worst, std::abs(X.p(i) - there.p(i)));
        for (int j = 0; j < 3; ++j) worst = std::max(worst, std::abs(X.R(i, j) - there.M(i, j)));
      }
    }
    return worst;
  }
};

TEST(UrdfMimic, BesideAJointOnItsAxisItIsACouplingWithTheSameForwardKinematics) {
  double worst = 0.0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Random dice(seed);
    MimicArm arm;
    const auto frame = [&] {
      return KDL::Frame(KDL::Rotation::RPY(dice.uniform(-3, 3), dice.uniform(-1, 1), 0.4),
                        KDL::Vector(dice.uniform(-1, 1), dice.uniform(-1, 1), 0.3));
    };
    // Along the axis, turned about it, perhaps upside down.
    const auto on_axis = [&] {
      return KDL::Frame(KDL::Rotation::RPY(dice.below(2) * M_PI, 0, dice.uniform(-3, 3)),
                        KDL::Vector(0, 0, dice.uniform(-1, 1)));
    };
    const auto sign = [&] { return dice.below(2) == 0 ? 1.0 : -1.0; };
    const auto follows = [&](int leader) {
      return MimicArm::Moving{leader, dice.uniform(-1.5, 1.5), dice.uniform(-1, 1)};
    };
    const bool slides = dice.below(4) == 0;  // the pair of joints 1 to 4
    arm.add(frame(), false, sign(), {});     // 0
    arm.add(frame(), slides, sign(), {});    // 1: the leader
    switch (dice.below(4)) {
      case 0:  // behind its neighbour
        arm.add(frame(), slides, sign(), {});
        arm.add(on_axis(), slides, sign(), follows(1));
        break;
      case 1:  // ahead of it
        arm.add(frame(), slides, sign(), follows(1));
        arm.add(on_axis(), slides, sign(), {});
        break;
      case 2:  // two of them, one of which mimics the other
        arm.add(frame(), slides, sign(), {});
        arm.add(on_axis(), slides, sign(), follows(1));
        arm.add(on_axis(), slides, sign(), follows(3));
        break;
      default:  // the leader's own axis, so that it moves twice
        arm.add(on_axis(), slides, sign(), {1, 0.5, 0.3});
    }
    arm.add(frame(), false, sign(), {});
    for (const auto convention : {format::Convention::kStandard, format::Convention::kModified})
      worst = std::max(worst, arm.difference(convention, dice));
  }
  EXPECT_LT(worst, 1e-9);
}

/// A palletiser: rods keep the forearm's bearing upright while J2 leans the upper arm.
std::string palletiser(const std::string& bearing_to_forearm, const std::string& mimic) {
  const std::string limit = "<limit lower=\"-1\" upper=\"2\" effort=\"1\" velocity=\"1\"/>";
  return robot(link("b") + link("c") + link("u") + link("t") + link("f") + link("h") +
               placed("J1", "b", "c", "xyz=\"0 0 0.5\"", "revolute", limit) +
               placed("J2", "c", "u", "xyz=\"0.3 0 0\"", "revolute", limit) +
               placed("rod", "u", "t", "xyz=\"0 0 1.1\"", "revolute", limit + mimic) +
               placed("J3", "t", "f", bearing_to_forearm, "revolute", limit) +
               placed("hand", "f", "h", "xyz=\"1.3 0 0\"", "fixed"));
}

TEST(UrdfMimic, APalletisersRodIsTheCouplingOfItsForearm) {
  const tests::TemporaryFolder folder;
  std::vector<Problem> remarks;
  const std::string mimic = "<mimic joint=\"J2\" multiplier=\"-1\"/>";
  const Cell cell = read_urdf(folder.put("p.urdf", palletiser("xyz=\"0 0.1 0\"", mimic)), {},
                              format::Convention::kStandard, &remarks);
  EXPECT_EQ(cell.nominal.coupling, (std::vector<format::JointCoupling>{{2, 1, -1.0}}));
  EXPECT_DOUBLE_EQ(cell.nominal.joints[2].q_min, -3.0);
  EXPECT_DOUBLE_EQ(cell.nominal.joints[2].q_max, 3.0);
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_EQ(remarks[0].code, "N-URDF-MIMIC");
  std::vector<double> leaning = {0.0, 0.4, 0.2}, upright = {0.0, 0.0, 0.2};
  Coupling(cell.nominal.coupling).to_angles(leaning);
  const Chain chain(cell.nominal);
  EXPECT_LT((chain.forward(leaning).R - chain.forward(upright).R).norm(), 1e-12);
  EXPECT_NEAR(chain.forward(leaning).p(0) - chain.forward(upright).p(0), 1.1 * std::sin(0.4), 1e-9);
}

TEST(UrdfMimic, WhatIsNoCouplingOfDhRowsIsRefusedWithTheReasonAndTheRemedy) {
  const tests::TemporaryFolder folder;
  const auto mimics = [](const std::string& leader, double multiplier) {
    return fmt::format("<mimic joint=\"{}\" multiplier=\"{}\"/>", leader, multiplier);
  };
  const std::string near = "xyz=\"0 0 0\"";
  for (const auto& [urdf, tip, reason] : std::vector<std::array<std::string, 3>>{
           {palletiser("xyz=\"0.2 0 0\"", mimics("J2", -1)), "h", "about an axis of its own"},
           {palletiser("xyz=\"0 0 0\" rpy=\"0.1 0 0\"", mimics("J2", -1)), "h", "of its own"},
           {palletiser(near, mimics("rod", -1)), "h", "mimics itself"},
           {palletiser(near, mimics("hand", -1)), "h", "'hand', which does not move"},
           {palletiser(near, mimics("J3", -1)), "t", "'J3', which does not move"},
           {palletiser(near, mimics("no such joint", -1)), "h", "which does not move"},
           {palletiser(near, mimics("J2", 11)), "h", "more than 10 times"},
           {palletiser(near, mimics("J3", -1)), "h", "0.5 to 2 times"}})
    try {
      (void)read_urdf(folder.put("p.urdf", urdf), {.tip = tip}, format::Convention::kStandard);
      ADD_FAILURE() << reason;
    } catch (const Failure& failure) {
      const Problem& problem = failure.problems().front();
      EXPECT_EQ(problem.code, "E-URDF-JOINT");
      EXPECT_NE(problem.message.find("'rod'"), std::string::npos) << problem.message;
      EXPECT_NE(problem.message.find(reason), std::string::npos) << problem.message;
      EXPECT_NE(problem.help.find("delete its <mimic> element"), std::string::npos);
    }
}

TEST(UrdfText, TabsAndLineEndsInAnAttributeAreBlanks) {
  const tests::TemporaryFolder folder;
  const auto read = [&](const std::string& text) {
    return write_cell(read_urdf(folder.put("a.urdf", text), {}, format::Convention::kStandard));
  };
  const std::string plain = read(arm_of_three("0.1 0 0.4"));
  for (const char* xyz : {"0.1\t0\t0.4", "0.1\n0 0.4", " 0.1\r\n\t0  0.4\n", "0.1 0 0.4\t"})
    EXPECT_EQ(read(arm_of_three(xyz)), plain) << xyz;
  EXPECT_EQ(read("<!-- 'a\tb' --><?x y='\n'?>" + arm_of_three("0.1 0 0.4")), plain);
}

TEST(UrdfText, WhatIsNoUrdfIsNamedWithWhatToDo) {
  struct {
    std::string text;
    const char *named, *remedy;
  } const cases[] = {
      {arm_of_three("0 0 ${a1}"), "xacro", "xacro "},
      {arm_of_three("$(arg x) 0 0"), "xacro", "> arm.urdf"},
      {robot("<xacro:include filename='a.xacro'/>"), "xacro", "xacro "},
      {"<?xml version='1.0'?><sdf version='1.9'><model name='a'/></sdf>", "SDF", "URDF"},
      {"<!-- arm --><mujoco model=\"a\"/>", "MJCF", "URDF"},
      {"joint,alpha_deg\nJ1,0\n", "no XML", "URDF"},
      {std::string("\xFF\xFE<\0r\0>\0", 8), "UTF-16", "iconv -f UTF-16 "},
      {std::string("<\0r\0o\0b\0o\0t\0 \0n\0/\0>\0", 20), "UTF-16", "iconv -f UTF-16LE"},
  };
  const tests::TemporaryFolder folder;
  for (const auto& c : cases) try {
      (void)read_urdf(folder.put("a.urdf", c.text), {}, format::Convention::kStandard);
      ADD_FAILURE() << c.named;
    } catch (const Failure& failure) {
      const Problem& problem = failure.problems().front();
      EXPECT_EQ(problem.code, "E-URDF") << c.named;
      EXPECT_NE(problem.message.find(c.named), std::string::npos) << problem.message;
      EXPECT_NE(problem.help.find(c.remedy), std::string::npos) << problem.help;
    }
  // What xacro wrote still declares its prefix, and may speak of it in a comment.
  EXPECT_EQ(refusal("<robot name='a' xmlns:xacro='http://ros.org'><!-- <xacro:x y='${z}'/> -->" +
                    link("l") + link("m") + joint("j", "l", "m") + "</robot>"),
            "accepted");
}

TEST(UrdfText, DegreesAreQuestionedAndRadiansAreNot) {
  const tests::TemporaryFolder folder;
  const auto doubts = [&](const std::string& text) {
    std::vector<Problem> out;
    (void)read_urdf(folder.put("a.urdf", text), {}, format::Convention::kStandard, &out);
    return out.size();
  };
  EXPECT_EQ(doubts(arm_of_three("0 0 0.4", "0 -90 0")), 1u);
  EXPECT_EQ(doubts(arm_of_three("0 0 0.4", "1.5707963 -3.1415927 6.2831853")), 0u);
  EXPECT_EQ(doubts(arm_of_three("90 0 0.4", "0 0 0")), 0u) << "only angles are looked at";
  const auto limited = [&](const char* type, const char* limit) {
    return robot(link("l") + link("m") + joint("j", "l", "m", limit, type));
  };
  const char* wide = "<limit lower=\"-180\" upper=\"180\" effort=\"1\" velocity=\"1\"/>";
  EXPECT_EQ(doubts(limited("revolute", wide)), 1u);
  EXPECT_EQ(doubts(limited("prismatic", wide)), 0u);
}

TEST(UrdfBase, TheArmBeginsAtTheNamedLinkAndGravityIsSeenFromThere) {
  const tests::TemporaryFolder folder;
  const auto file = folder.put("a.urdf", arm_of_three("0 0 0.4"));
  const auto read = [&](const char* base) {
    return read_urdf(file, {.tip = "o", .base = base}, format::Convention::kModified);
  };
  EXPECT_EQ(write_cell(read("w")), write_cell(read("")));
  const Cell hanging = read("b");
  EXPECT_EQ(hanging.joints(), 3);
  EXPECT_NEAR(hanging.gravity[2], 9.81, 1e-9);
  EXPECT_EQ(read("m").joints(), 2);
  for (const char* base : {"no such link", "o"}) try {
      (void)read_urdf(file, {.tip = "n", .base = base}, format::Convention::kModified);
      ADD_FAILURE() << base;
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.problems().front().code, "E-URDF-BASE");
      EXPECT_EQ(failure.problems().front().help, "--base w or b or m");
    }
}

}  // namespace
}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <sstream>

#include "check/check.hpp"
#include "plumb/runtime/chain.hpp"
#include "simulate/simulate.hpp"
#include "tests/cases/random_cell.hpp"
#include "tests/check/scrambled.hpp"

namespace plumb::offline {
namespace {

using scrambled::Files;

Cell arm(std::uint64_t seed = 1) {
  return random_cell(seed, 6, format::Convention::kModified, ArmKind::kRevolute);
}

SimulationPlan plan_of(double geometry, std::uint64_t seed = 1) {
  SimulationPlan plan;
  plan.poses = 120;
  plan.seed = seed;
  plan.truth.geometry_m = plan.truth.geometry_rad = geometry;
  return plan;
}

Files files_of(const Cell& cell, const SimulationPlan& plan) {
  return {write_cell(cell), simulated_csv(cell, simulate(cell, plan)), {}};
}

Files files_of(double geometry = 0.5e-3, std::uint64_t seed = 1) {
  return files_of(arm(seed), plan_of(geometry, seed));
}

/// The number of a column with which a name begins: x_mm is 0, y_mm 1, z_mm 2; q1_deg 10,
/// q2_deg 11.
int column_of(const std::string& header) {
  if (header.size() == 4 && header.ends_with("_mm")) return header[0] - 'x';
  if (header.size() == 6 && header[0] == 'q' && header.ends_with("_deg"))
    return 10 + header[1] - '1';
  return -1;
}

using Change = std::function<double(int row, int column, double value)>;

/// The files again, with what `change` makes of the numbers of x, y, z [mm] and q [deg].
Files changed(Files files, const Change& change, const char* format = "%.6f") {
  std::istringstream in(files.csv);
  std::string out;
  std::vector<int> columns;
  int row = 0;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with('#')) {
      out += line + "\n";
      continue;
    }
    std::istringstream cells(line);
    const bool header = columns.empty();
    std::size_t k = 0;
    std::string made;
    for (std::string cell; std::getline(cells, cell, ','); ++k) {
      if (header) {
        columns.push_back(column_of(cell));
      } else if (columns[k] >= 0) {
        char text[40];
        const bool point = columns[k] < 3;
        std::snprintf(text, sizeof text, point ? format : "%.8f",
                      change(row, columns[k], std::stod(cell)));
        cell = text;
      }
      made += (k > 0 ? "," : "") + cell;
    }
    out += made + "\n";
    if (!header) ++row;
  }
  files.csv = out;
  return files;
}

/// The same of the points alone; k is 0, 1, 2.
Files with_points(const Files& files, const Change& change, const char* format = "%.6f") {
  return changed(
      files, [&](int row, int k, double v) { return k < 3 ? change(row, k, v) : v; }, format);
}

Files scaled(double geometry, double factor) {
  return with_points(files_of(geometry), [=](int, int, double v) { return v * factor; });
}

const Problem* found(const Check& check, const std::string& code) {
  for (const auto& problem : check.findings)
    if (problem.code == code) return &problem;
  return nullptr;
}

Check checked(const Files& files) {
  const scrambled::Folder folder;
  const auto c = opened(files, folder.path());
  return check_cell(c.cell, c.measured);
}

constexpr const char* kCodes[] = {"W-CHECK-COARSE", "W-CHECK-ROUNDED",    "W-CHECK-PATTERN",
                                  "W-CHECK-SCALE",  "W-CHECK-CONTRADICT", "W-CHECK-GRAVITY",
                                  "W-CHECK-ROWS",   "W-CHECK-MOVED"};

/// Only this one of the doubts is said; its sentence holds the words. An empty code: none is.
Check expect_only(const Files& files, const std::string& code, const std::string& words = "") {
  Check check = checked(files);
  for (const char* each : kCodes) {
    const Problem* problem = found(check, each);
    EXPECT_EQ(problem != nullptr, each == code) << each << (problem ? problem->message : "");
    if (problem == nullptr || each != code) continue;
    EXPECT_EQ(problem->severity, Severity::kWarning);
    EXPECT_NE((problem->message + " = " + problem->help).find(words), std::string::npos)
        << problem->message << " = " << problem->help;
    EXPECT_FALSE(problem->help.empty());
  }
  return check;
}

TEST(Readings, SoundOnesRaiseNoDoubtWhateverTheArmLacks) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) expect_only(files_of(0.5e-3, seed), "");
  for (const char* effect : {"reversal", "gear_harmonics", "joint_compliance", "thermal_growth"}) {
    SimulationPlan plan = plan_of(0.3e-3);
    plan.truth.effects = {effect};
    expect_only(files_of(arm(), plan), "");
  }
}

TEST(Readings, RoundedPointsAreSizedAgainstTheNoise) {
  const Change same = [](int, int, double v) { return v; };
  expect_only(with_points(files_of(), same, "%.0f"), "W-CHECK-COARSE", "rounded to 1 mm");
  expect_only(with_points(files_of(), same, "%.1f"), "W-CHECK-COARSE", "rounded to 0.1 mm");
  expect_only(with_points(files_of(), same, "%.3f"), "");
  expect_only(with_points(files_of(), [](int, int, double v) { return std::round(v * 2.0) / 2.0; }),
              "W-CHECK-COARSE", "rounded to 0.5 mm");
  expect_only(
      with_points(files_of(), [](int, int k, double v) { return k == 2 ? std::round(v) : v; }),
      "W-CHECK-COARSE", "rounded to 1 mm");
}

TEST(Readings, RoundedJointsAreNoFaultWhereTheArmStoodThereExactly) {
  SimulationPlan plan = plan_of(0.5e-3);
  const Cell cell = arm();
  plan.q = simulate(cell, plan).measured.q;
  const double degree = M_PI / 180.0;
  for (double& q : plan.q.reshaped()) q = std::round(q / degree) * degree;
  expect_only(files_of(cell, plan), "");
  expect_only(
      changed(files_of(), [](int, int k, double v) { return k < 3 ? v : std::round(v * 10) / 10; }),
      "W-CHECK-ROUNDED", "rounded to 0.1 deg");
}

TEST(Readings, RepeatsThatScatterFarMoreThanStatedAreSaid) {
  SimulationPlan plan = plan_of(0.3e-3);
  plan.repeats = 3;
  Files files = files_of(arm(), plan);
  EXPECT_EQ(found(checked(files), "W-CHECK-REPEATS"), nullptr);
  const Files moved = with_points(
      files, [](int row, int k, double v) { return v + 0.3 * std::sin(37.1 * row + 11.3 * k); });
  const Check check = checked(moved);
  const Problem* problem = found(check, "W-CHECK-REPEATS");
  ASSERT_NE(problem, nullptr);
  EXPECT_NE(problem->message.find("but sigma_um says 0.01 mm"), std::string::npos)
      << problem->message;
}

TEST(Readings, ARegularPatternOfOffsetsIsSaidWithItsPeriodAndVector) {
  const double off[] = {0.3, -0.2, 0.5};
  const auto every = [&](int n) {
    return with_points(files_of(),
                       [=](int row, int k, double v) { return v + (row % n == 1 ? off[k] : 0.0); });
  };
  expect_only(every(2), "W-CHECK-PATTERN", "every second reading");
  expect_only(every(3), "W-CHECK-PATTERN", "every third reading");
  expect_only(every(7), "W-CHECK-PATTERN", "every seventh reading");
  const auto pairs = with_points(
      files_of(), [&](int row, int k, double v) { return v + (row % 4 < 2 ? off[k] : 0.0); });
  expect_only(pairs, "W-CHECK-PATTERN", "repeat every 4 rows");
}

TEST(Readings, APatternThatTheJointsFollowMayBeTheArmsAndIsNotSaid) {
  const Cell cell = arm();
  SimulationPlan plan = plan_of(0.5e-3);
  plan.q = simulate(cell, plan).measured.q;
  for (int i = 0; i < plan.q.rows(); ++i)  // left, right, left, right
    plan.q(i, 0) = (i % 2 == 0 ? 1.0 : -1.0) * (0.2 + std::abs(plan.q(i, 0)));
  const auto to_one_side = [](int row, int k, double v) {
    return v + (row % 2 == 0 && k == 2 ? 0.3 : 0.0);
  };
  expect_only(with_points(files_of(cell, plan), to_one_side), "");
}

TEST(Readings, OneFactorOnAllPointsIsToldFromTheScatterOfTheLengths) {
  expect_only(scaled(1e-5, 1.001), "W-CHECK-SCALE",
              "longer than the nominal ones by one factor, 1.0009");
  expect_only(scaled(1e-5, 0.9995), "W-CHECK-SCALE",
              "shorter than the nominal ones by one factor, 0.9994");
  expect_only(scaled(0.3e-3, 1.02), "W-CHECK-SCALE", "longer");
  expect_only(scaled(0.5e-3, 1.0002), "");  // an arm built to half a millimetre hides that
}

TEST(Readings, AGrossFactorIsNamedWithTheUnitThatWouldExplainIt) {
  for (const auto& [factor, words] :
       {std::pair{0.1, "points in cm, not mm"}, std::pair{10.0, "DH table in cm, not mm"},
        std::pair{1.3, "no unit of length"}}) {
    const Check check = expect_only(scaled(0.3e-3, factor), "W-CHECK-SCALE", words);
    EXPECT_EQ(check.exit, Exit::kInput);
    ASSERT_NE(found(check, "E-CHECK-NOFIT"), nullptr) << factor;
    EXPECT_NE(found(check, "E-CHECK-NOFIT")->message.find("one common factor"), std::string::npos);
  }
}

TEST(Readings, MicrometresUnderMillimetresAreOfThePointsAndNotOfTheTable) {
  const Check check = checked(scaled(0.3e-3, 1000.0));
  ASSERT_TRUE(check.detection.changed);
  ASSERT_EQ(check.changes.size(), 1U);
  EXPECT_NE(check.changes[0].find("the measured points are in um"), std::string::npos)
      << check.changes[0];
}

/// A share of the rows, here and there.
bool is_bad(int row, int of_ten) { return (row * 7 + row / 10) % 10 < of_ten; }

TEST(Readings, AThirdOfThemWrongContradictsTheOthersHoweverFarOff) {
  for (const double size_mm : {1.0, 10.0, 300.0}) {
    const Files files = with_points(files_of(), [=](int row, int k, double v) {
      return v + (is_bad(row, 3) ? size_mm * (1.0 + 0.5 * std::sin(1.7 * row + k)) : 0.0);
    });
    expect_only(files, "W-CHECK-CONTRADICT", "30 % of the readings");
  }
  const Files scattered = with_points(files_of(), [](int row, int k, double v) {
    return v + (is_bad(row, 4) ? 20.0 * std::sin(97.3 * row + 31.0 * k) : 0.0);
  });
  expect_only(scattered, "W-CHECK-CONTRADICT", "% of the readings");
}

TEST(Readings, ContradictingOnesThatFollowAJointAreTheArmsAndAreNotSaid) {
  const Cell cell = arm();
  const SimulationPlan plan = plan_of(0.5e-3);
  const RowsN q = simulate(cell, plan).measured.q;
  const double middle = q.col(1).mean();
  const Files files = with_points(files_of(cell, plan), [&](int row, int k, double v) {
    return v + (k == 2 && q(row, 1) > middle + 0.5 ? 3.0 : 0.0);
  });
  expect_only(files, "");
}

/// Points of an arm whose joints yield under a load at the tool, gravity along g.
Files yielding(const std::array<double, 3>& g, const std::array<double, 3>& in_cell) {
  Cell cell = arm();
  SimulationPlan plan = plan_of(0.3e-3);
  plan.q = simulate(cell, plan).measured.q;
  const RowsN seen = plan.q;
  const Chain chain(cell.nominal);
  ChainFrames frames;
  const Vector3 down(g[0], g[1], g[2]);
  for (int i = 0; i < seen.rows(); ++i) {
    chain.frames({seen.row(i).data(), 6}, frames);
    for (std::size_t j = 0; j < 6; ++j) {
      const Vector3 lever = frames.tip.p - frames.joint[j].p;
      plan.q(i, static_cast<int>(j)) += 1e-3 * frames.joint[j].R.col(2).dot(lever.cross(down));
    }
  }
  cell.gravity = {9.81 * in_cell[0], 9.81 * in_cell[1], 9.81 * in_cell[2]};
  return changed(files_of(cell, plan), [&](int row, int k, double v) {
    return k < 3 ? v : seen(row, k - 10) * 180.0 / M_PI;
  });
}

TEST(EffectOptions, ThatNoArmHasAreSaidAndUsualOnesAreNot) {
  SimulationPlan plan = plan_of(0.3e-3);
  plan.directions = Recorded::kAlways;
  const Files files = files_of(arm(), plan);
  const auto said = [&](const std::string& table) {
    Files with = files;
    const auto at = with.cell.find("[deploy]");
    with.cell.insert(at == std::string::npos ? with.cell.size() : at, table + "\n");
    const Problem* problem = nullptr;
    const Check check = checked(with);
    problem = found(check, "W-CHECK-EFFECT");
    return problem == nullptr ? std::string() : problem->message;
  };
  EXPECT_EQ(said("[effects.reversal]\njoints = [\"J2\"]\ntransition_deg = 0.5"), "");
  EXPECT_NE(said("[effects.reversal]\njoints = [\"J2\"]\ntransition_deg = 180").find("180"),
            std::string::npos);
  EXPECT_NE(said("[effects.drift]\nsettling_s = 1e9").find("settling_s"), std::string::npos);
}

TEST(EffectSizes, ABacklashOfDecimetresIsSaidAndOneOfMicrometresIsNot) {
  const auto said = [](const char* effect) {
    SimulationPlan plan = plan_of(0.3e-3);
    const Cell cell = arm();
    plan.truth.effects = {effect};
    Files files = files_of(cell, plan);
    const auto at = files.cell.find("[deploy]");
    files.cell.insert(at == std::string::npos ? files.cell.size() : at,
                      "[effects.reversal]\njoints = [\"J1\"]\n");
    const Check check = checked(files);
    return found(check, "W-CHECK-EFFECT") != nullptr;
  };
  EXPECT_FALSE(said("reversal:J1=100urad"));
  EXPECT_TRUE(said("reversal:J1=60mrad"));
}

TEST(Gravity, ThatTheJointsContradictIsSaidWithTheOneTheyYieldTo) {
  expect_only(yielding({0, 0, -1}, {0, 0, -1}), "");
  expect_only(yielding({0, 0, 1}, {0, 0, 1}), "");
  expect_only(yielding({0, 0, -1}, {0, 0, 1}), "W-CHECK-GRAVITY", "gravity = [0, 0, -9.81]");
  expect_only(yielding({0, 0, -1}, {1, 0, 0}), "W-CHECK-GRAVITY", "gravity = [0, 0, -9.81]");
  expect_only(yielding({0, 1, 0}, {0, 0, -1}), "W-CHECK-GRAVITY", "gravity = [0, 9.81, 0]");
}

TEST(Gravity, ThatDoesNotPointDownTheBaseIsANoteThatSaysWhatItMeans) {
  const auto note = [](std::array<double, 3> g) {
    Cell cell = arm();
    cell.gravity = g;
    const Check check = checked(files_of(cell, plan_of(0.3e-3)));
    EXPECT_EQ(check.exit, Exit::kDone);
    EXPECT_EQ(found(check, "W-CHECK-GRAVITY"), nullptr);
    const Problem* problem = found(check, "N-CHECK-GRAVITY");
    return problem == nullptr ? std::string() : problem->message;
  };
  EXPECT_EQ(note({0, 0, -9.81}), "");
  EXPECT_NE(note({0, 0, 0}).find("switches the weight of the arm off"), std::string::npos);
  EXPECT_NE(note({0, 0, 9.81}).find("ceiling"), std::string::npos);
  EXPECT_NE(note({-9.81, 0, 0}).find("wall"), std::string::npos);
  EXPECT_NE(note({0, 4.905, -8.4957}).find("tilted"), std::string::npos);
}

}  // namespace
}  // namespace plumb::offline

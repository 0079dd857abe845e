// SPDX-License-Identifier: Apache-2.0
#include "check/joint_maps.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <sstream>

#include "check/check.hpp"
#include "plumb/runtime/transform.hpp"
#include "simulate/simulate.hpp"
#include "tests/cases/random_cell.hpp"
#include "tests/check/scrambled.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::offline {
namespace {

using scrambled::Case;
using scrambled::Files;
using scrambled::six_joints;

constexpr double kDegree = M_PI / 180.0;

/// The file whose joint columns were made of the others' values [deg]: `change(q)`.
Files read_otherwise(Files files, const std::function<void(std::vector<double>&)>& change) {
  std::istringstream in(files.csv);
  std::string out;
  int first = -1;
  for (std::string line; std::getline(in, line);) {
    std::vector<std::string> cells;
    std::istringstream parts(line);
    for (std::string cell; std::getline(parts, cell, ',');) cells.push_back(cell);
    if (line.empty() || line[0] == '#') {
    } else if (first < 0) {
      while (cells[static_cast<std::size_t>(++first)].rfind("q1_", 0) != 0) {
      }
    } else {
      std::vector<double> q;
      for (std::size_t j = 0; j < 6; ++j)
        q.push_back(std::stod(cells[static_cast<std::size_t>(first) + j]));
      change(q);
      for (std::size_t j = 0; j < 6; ++j)
        cells[static_cast<std::size_t>(first) + j] = fmt::format("{:.6f}", q[j]);
      line = fmt::format("{}", fmt::join(cells, ","));
    }
    out += line + "\n";
  }
  files.csv = out;
  return files;
}

std::string changes_of(const Case& c, const Detection& d) {
  return fmt::format("{}",
                     fmt::join(in_words(c.cell, d.present.convention, d.best.convention), "; "));
}

/// What is said of the files after --fix: nothing, and they fit.
void expect_whole(const Files& files, const Case& c, const Detection& d,
                  const scrambled::Folder& folder) {
  const Convention& labels = d.present.convention;
  const Convention& meant = d.best.convention;
  const Files fixed{
      edited(files.cell, "cell.toml", cell_edit(c.cell, labels, meant)),
      edited(files.csv, c.measured.tables[0].header_line, measurement_edit(c.cell, labels, meant)),
      {}};
  const Case again = opened(fixed, folder.path());
  const Detection found = detect_convention(again.cell, again.measured);
  EXPECT_FALSE(found.changed) << changes_of(again, found);
  EXPECT_LT(found.best.fitted_m, 1e-3);
}

TEST(JointMaps, AZeroThatIsNoQuarterTurnIsNamedWithItsAngle) {
  const scrambled::Folder folder;
  const std::vector<std::vector<double>> zeros{
      {0, 0, 30, 0, 0, 0},   {0, -17.5, 0, 0, 45, 0}, {0, 0, 0, -65, 0, 0},  {0, 101.3, 0, 0, 0, 0},
      {0, 12, -33, 0, 0, 0}, {0, 0, 0, 0, 140, 0},    {25, 0, 20, 0, 0, -70}};
  std::uint64_t seed = 0;
  for (const auto& zero : tests::first_of(zeros, 4)) {
    const Files broken = read_otherwise(six_joints(++seed), [&](std::vector<double>& q) {
      for (std::size_t j = 0; j < 6; ++j) q[j] += zero[j];
    });
    const Case c = opened(broken, folder.path());
    const Detection d = detect_convention(c.cell, c.measured);
    ASSERT_TRUE(d.changed) << seed;
    for (std::size_t j = 0; j < 6; ++j) {
      // Those of the first and the last joint belong to frame and target as well.
      const double expected = j == 0 || j == 5 ? 0.0 : -zero[j];
      EXPECT_NEAR(d.best.convention.zero[j] / kDegree, expected, 0.3)
          << seed << ": " << changes_of(c, d);
    }
    expect_whole(broken, c, d, folder);
  }
}

TEST(JointMaps, OneColumnInAnotherUnitOrScaleIsNamed) {
  const scrambled::Folder folder;
  struct Column {
    std::size_t joint;
    double factor, zero;
    const char* words;
  };
  const std::vector<Column> cases{
      {0, kDegree, 0, "column q1 (J1) alone is in rad, not deg"},
      {3, 0.5, 0, "column q4 (J4) counts otherwise, its numbers are to be multiplied by 2 "},
      {4, -0.5, 0, "multiplied by -2 "},
      {2, kDegree, 0.6, "column q3 (J3) alone is in rad, not deg"},
      {4, 1000 * kDegree, 0, "column q5 (J5) alone is in mrad, not deg"},
      {1, 101, 0, "column q2 (J2) counts otherwise, its numbers are to be multiplied by 1/101 "},
      {2, kDegree, 0, "column q3 (J3) alone is in rad, not deg"},
      {5, kDegree, 0, "column q6 (J6) alone is in rad, not deg"},
  };
  std::uint64_t seed = 10;
  for (const auto& a : tests::first_of(cases, 5)) {
    const Files broken = read_otherwise(six_joints(++seed), [&](std::vector<double>& q) {
      q[a.joint] = a.factor * q[a.joint] + a.zero;
    });
    const Case c = opened(broken, folder.path());
    const Detection d = detect_convention(c.cell, c.measured);
    EXPECT_NE(changes_of(c, d).find(a.words), std::string::npos)
        << seed << ": " << changes_of(c, d);
    if (d.changed) expect_whole(broken, c, d, folder);
  }
}

TEST(JointMaps, NothingIsSaidWhereFrameOrTargetOrAnotherArmMayBeIt) {
  const scrambled::Folder folder;
  const std::vector<std::pair<const char*, std::function<void(std::vector<double>&)>>> cases{
      {"a zero of the first joint is the tracker's frame", [](auto& q) { q[0] += 37.0; }},
      {"one of the last joint is the target", [](auto& q) { q[5] -= 50.0; }},
      {"a zero that the fit finds", [](auto& q) { q[2] += 0.7; }},
      {"coupled joints", [](auto& q) { q[2] += q[1]; }},
      {"half a coupling", [](auto& q) { q[4] -= 0.5 * q[3]; }},
      {"readings of another day", [](auto& q) { q[1] = 40.0 * std::sin(q[1]); }},
  };
  std::uint64_t seed = 2;
  for (const auto& [what, change] : cases) {
    ++seed;
    const Case c = opened(read_otherwise(six_joints(seed), change), folder.path());
    const Detection d = detect_convention(c.cell, c.measured);
    const Convention& labels = d.present.convention;
    EXPECT_EQ(d.best.convention.zero, labels.zero) << what << ": " << changes_of(c, d);
    EXPECT_EQ(d.best.convention.factor, labels.factor) << what << ": " << changes_of(c, d);
    EXPECT_EQ(d.best.convention.own_unit, labels.own_unit) << what << ": " << changes_of(c, d);
  }
}

TEST(JointMaps, AGivenFrameTurnedAboutTheFirstAxisMayBeTheZeroOfThatJoint) {
  Cell cell = random_cell(4, 6, format::Convention::kStandard, ArmKind::kRevolute);
  cell.measurement.fit_frame = false;
  SimulationPlan plan;
  plan.poses = 40;
  plan.seed = 4;
  const Simulation s = simulate(cell, plan);
  const auto remedy = [&](const format::Pose& wrong) {
    Cell other = cell;
    other.measurement.X_MB = to_pose(from_pose(cell.measurement.X_MB) * from_pose(wrong));
    for (const Problem& problem : check_cell(other, s.measured).findings)
      if (problem.code == "E-CHECK-FRAME") return problem.help;
    return std::string("nothing");
  };
  const double half = 0.3;
  EXPECT_NE(remedy({{}, {std::cos(half), 0.0, 0.0, std::sin(half)}}).find("the offset of J1"),
            std::string::npos);
  EXPECT_EQ(remedy({{}, {std::cos(half), std::sin(half), 0.0, 0.0}}).find("offset"),
            std::string::npos);
}

}  // namespace
}  // namespace plumb::offline

// SPDX-License-Identifier: Apache-2.0
#include "check/convention_search.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <numeric>

#include "arm/predicted_points.hpp"
#include "check/check.hpp"
#include "fit/calibrate.hpp"
#include "fit/cell_data.hpp"
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

/// RMS 3-D residual with frame and target placed by the calibration's own code.
double placed_rms(const Cell& cell, const MeasurementFiles& m) {
  std::vector<int> rows(m.size());
  std::iota(rows.begin(), rows.end(), 0);
  const Rows3 left = residuals(m, predict_points(place_nominal(cell, m, rows), m.q));
  return std::sqrt(left.squaredNorm() / m.size());
}

/// What --fix would make of the files.
Files fixed(const Files& files, const Case& c, const Convention& meant) {
  const Convention labels = labelled_convention(c.cell, c.measured);
  return {
      edited(files.cell, "cell.toml", cell_edit(c.cell, labels, meant)),
      edited(files.csv, c.measured.tables[0].header_line, measurement_edit(c.cell, labels, meant)),
      {}};
}

std::string words(const Cell& cell, const Detection& d) {
  return fmt::format("{}",
                     fmt::join(in_words(cell, d.present.convention, d.best.convention), "; "));
}

struct Timed {
  double total_ms = 0.0, most_ms = 0.0;
  Detection detect(const Case& c) {
    const auto start = std::chrono::steady_clock::now();
    Detection out = detect_convention(c.cell, c.measured);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    total_ms += took.count();
    most_ms = std::max(most_ms, took.count());
    return out;
  }
};

// A reading is right if the repaired files predict the points as well as the files before the
// scrambling did: what predicts the same points cannot be told apart by points.
TEST(ConventionSearch, NamesTheRightReadingOfScrambledFiles) {
  const long count = tests::scaled(30);
  const std::uint64_t seed = 20;
  std::printf("%ld scrambled cells, seed %d\n", count, static_cast<int>(seed));
  tests::Random random(seed);
  const scrambled::Folder folder;
  Timed timed;
  long right = 0;
  for (long i = 0; i < count; ++i) {
    const Files sound = scrambled::random_files(random);
    const Files broken = scrambled::scramble(sound, random);
    const Case c = opened(broken, folder.path());
    const Detection d = timed.detect(c);
    const Case repaired = opened(fixed(broken, c, d.best.convention), folder.path());
    const double rms = placed_rms(repaired.cell, repaired.measured);
    const Case before = opened(sound, folder.path());
    const double truth = placed_rms(before.cell, before.measured);
    if (std::abs(rms / truth - 1.0) < 0.02) {
      ++right;
      continue;
    }
    std::printf("%ld: done %s; found %s; %.4f mm instead of %.4f mm; %d joints, %d poses\n", i,
                fmt::format("{}", fmt::join(broken.done, ", ")).c_str(), words(c.cell, d).c_str(),
                rms * 1e3, truth * 1e3, c.cell.joints(), c.measured.size());
  }
  std::printf("right in %ld of %ld; %.1f ms each, at most %.1f ms\n", right, count,
              timed.total_ms / static_cast<double>(count), timed.most_ms);
  EXPECT_GE(static_cast<double>(right), 0.99 * static_cast<double>(count));
}

TEST(ConventionSearch, ChangesNothingInSoundFiles) {
  const long count = tests::scaled(60);
  const std::uint64_t seed = 21;
  std::printf("%ld sound cells, seed %d\n", count, static_cast<int>(seed));
  tests::Random random(seed);
  const scrambled::Folder folder;
  Timed timed;
  for (long i = 0; i < count; ++i) {
    const Case c = opened(scrambled::random_files(random), folder.path());
    const Detection d = timed.detect(c);
    EXPECT_FALSE(d.changed) << i << ": " << words(c.cell, d);
    EXPECT_EQ(d.best.convention, labelled_convention(c.cell, c.measured));
  }
  std::printf("%.1f ms each, at most %.1f ms\n", timed.total_ms / static_cast<double>(count),
              timed.most_ms);
}

TEST(ConventionSearch, FindsZerosTurnedByQuarterTurns) {
  const scrambled::Folder folder;
  Timed timed;
  const long count = tests::scaled(10);
  for (long seed = 1; seed <= count; ++seed) {
    const Files sound = six_joints(static_cast<std::uint64_t>(seed));
    Case c = opened(sound, folder.path());
    const double truth = placed_rms(c.cell, c.measured);
    CellEdit turned;
    const int a = 1 + static_cast<int>(seed) % 4, b = 1 + static_cast<int>(seed / 2) % 4;
    turned.theta[a] = c.cell.nominal.joints[a].theta + M_PI_2;
    if (b != a) turned.theta[b] = c.cell.nominal.joints[b].theta - M_PI;
    const Files broken{edited(sound.cell, "cell.toml", turned), sound.csv, {}};
    c = opened(broken, folder.path());
    const Detection d = timed.detect(c);
    const Case repaired = opened(fixed(broken, c, d.best.convention), folder.path());
    EXPECT_NEAR(placed_rms(repaired.cell, repaired.measured) / truth, 1.0, 0.02)
        << "seed " << seed << ": " << words(c.cell, d);
  }
  std::printf("%ld arms, %.0f ms each, at most %.0f ms\n", count,
              timed.total_ms / static_cast<double>(count), timed.most_ms);
}

/// The file with the headings of its joint columns exchanged: column `from[j]` gets the name of
/// joint j.
Files with_columns(Files files, const std::vector<int>& from) {
  const auto begin = files.csv.find("q1_deg"), end = files.csv.find('\n', begin);
  std::string header = files.csv.substr(begin, end - begin);
  for (std::size_t j = 0; j < from.size(); ++j) {
    const std::string held = fmt::format("q{}_deg", from[j] + 1);
    header.replace(header.find(held), held.size(), fmt::format("Q{}_deg", j + 1));
  }
  for (char& c : header)
    if (c == 'Q') c = 'q';
  files.csv.replace(begin, end - begin, header);
  return files;
}

// Sorted by name, the wrist in another order, two of them swapped, reversed: what a list of joint
// states looks like.
TEST(ConventionSearch, FindsJointColumnsInAnotherOrder) {
  const scrambled::Folder folder;
  const std::vector<std::vector<int>> orders{{2, 1, 0, 3, 4, 5},
                                             {0, 1, 2, 4, 5, 3},
                                             {0, 1, 2, 3, 5, 4},
                                             {5, 4, 3, 2, 1, 0},
                                             {1, 2, 3, 4, 5, 0}};
  for (const std::uint64_t seed : tests::first_of<std::uint64_t>({5, 1, 2}, 1))
    for (const auto& order : orders) {
      const Files sound = six_joints(seed);
      const Case before = opened(sound, folder.path());
      const Files broken = with_columns(sound, order);
      const Case c = opened(broken, folder.path());
      const Detection d = detect_convention(c.cell, c.measured);
      EXPECT_TRUE(d.changed) << seed;
      const Case repaired = opened(fixed(broken, c, d.best.convention), folder.path());
      EXPECT_NEAR(
          placed_rms(repaired.cell, repaired.measured) / placed_rms(before.cell, before.measured),
          1.0, 0.02)
          << seed << ": " << words(c.cell, d);
    }
}

TEST(ConventionSearch, SaysWhichJointColumnsAreSwapped) {
  const scrambled::Folder folder;
  const Case c = opened(with_columns(six_joints(2), {2, 1, 0, 3, 4, 5}), folder.path());
  EXPECT_NE(words(c.cell, detect_convention(c.cell, c.measured)).find("q1 and q3 are swapped"),
            std::string::npos);
}

TEST(ConventionSearch, WithAGivenFrameSaysWhichAxisIsWrongAndThatTheFrameIsTheInverse) {
  const scrambled::Folder folder;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Cell cell = random_cell(seed, 6, format::Convention::kStandard, ArmKind::kRevolute);
    cell.measurement.fit_frame = false;
    cell.measurement.X_MB = {{2.5, -1.0, 0.4}, {0.8, 0.0, 0.36, 0.48}};
    SimulationPlan plan;
    plan.poses = 60;
    plan.seed = seed;
    plan.truth.geometry_m = plan.truth.geometry_rad = 0.5e-3;
    const Simulation s = simulate(cell, plan);
    const auto with = [&](const format::Pose& X_MB, int negated) {
      Cell other = cell;
      other.measurement.X_MB = X_MB;
      MeasurementFiles m = s.measured;
      if (negated >= 0) m.p_M.col(negated) *= -1.0;
      return detect_convention(other, m);
    };
    const auto& X_MB = cell.measurement.X_MB;
    EXPECT_FALSE(with(X_MB, -1).changed);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_EQ(static_cast<int>(with(X_MB, axis).best.convention.mirror), 1 + axis);
    const format::Pose X_BM = to_pose(from_pose(X_MB).inverse());
    const Detection inverted = with(X_BM, -1);
    EXPECT_TRUE(inverted.best.convention.frame_inverted) << "seed " << seed;
    EXPECT_EQ(inverted.best.convention.mirror, Mirror::kNone);
  }
}

// The frame is blamed, not the arm; a frame that is only as good as it was set up is left alone.
TEST(GivenFrame, ThatThePointsContradictIsNamedWithTheOneThatFits) {
  const auto said = [](const Check& check) {
    std::string out;
    for (const auto& problem : check.findings)
      if (problem.severity == Severity::kError) out += problem.code + ": " + problem.message + "\n";
    return out;
  };
  for (const std::uint64_t seed : {2U, 4U, 5U}) {
    Cell cell = random_cell(seed, 6, format::Convention::kStandard, ArmKind::kRevolute);
    cell.measurement.fit_frame = false;
    cell.measurement.X_MB = {{2.35, -1.21, 0.64}, {0.8, 0.0, 0.36, 0.48}};
    const Transformd truth = from_pose(cell.measurement.X_MB);
    SimulationPlan plan;
    plan.poses = 60;
    plan.seed = seed;
    plan.noise_m = 20e-6;
    plan.truth.geometry_m = plan.truth.geometry_rad = 0.5e-3;
    const Simulation s = simulate(cell, plan);
    const auto with = [&](const std::array<double, 3>& moved_B, double turned_deg, double scale) {
      const double half = turned_deg * M_PI / 360.0;
      const Transformd wrong =
          truth * from_pose({moved_B, {std::cos(half), 0.0, 0.0, std::sin(half)}});
      Cell other = cell;
      other.measurement.X_MB = to_pose(wrong);
      for (double& p : other.measurement.X_MB.p) p *= scale;
      return said(check_cell(other, s.measured));
    };
    EXPECT_EQ(with({}, 0.0, 1.0), "") << seed;
    EXPECT_EQ(with({1e-3, -1e-3, 0.5e-3}, 0.05, 1.0), "") << seed;
    for (const auto& [found, words] :
         {std::pair{with({}, 180.0, 1.0), " deg about z"},
          std::pair{with({}, -37.0, 1.0), " deg about z"},
          std::pair{with({0.0, 0.0, -0.3}, 0.0, 1.0), " mm off along its z"},
          std::pair{with({0.25, 0.0, 0.0}, 0.0, 1.0), " mm off along its x"},
          std::pair{with({}, 0.0, 1e-3), "its xyz is in m instead of mm"}}) {
      EXPECT_EQ(found.rfind("E-CHECK-FRAME", 0), 0U) << seed << found;
      EXPECT_NE(found.find(words), std::string::npos) << seed << found;
      EXPECT_NE(found.find("xyz = [23"), std::string::npos) << found;
      EXPECT_EQ(found.find("E-FIT-FAR"), std::string::npos) << seed << found;
    }
  }
}

TEST(ConventionSearch, LeavesALargeUnmodelledErrorAlone) {
  const scrambled::Folder folder;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Cell cell = random_cell(seed, 6, format::Convention::kStandard, ArmKind::kRevolute);
    SimulationPlan plan;
    plan.poses = 60;
    plan.seed = seed;
    plan.truth.geometry_m = plan.truth.geometry_rad = 5e-3;
    plan.truth.effects = {"joint_compliance=3mrad"};
    const Simulation s = simulate(cell, plan);
    EXPECT_FALSE(detect_convention(cell, s.measured).changed) << "seed " << seed;
  }
}

TEST(ConventionSearch, KeepsTheLabelsOfARealArm) {
  const std::filesystem::path folder = PLUMB_SHARED_DATA;
  if (!std::filesystem::exists(folder / "cell.toml")) GTEST_SKIP() << "no " << folder;
  for (const char* series : {"series_A.csv", "series_B.csv"}) {
    Cell cell = read_cell(folder / "cell.toml");
    cell.measurement.files = {folder / series};
    Case c{cell, read_cell_measurements(cell)};
    Timed timed;
    const Detection d = timed.detect(c);
    std::printf("%s: %.3f mm placed, %.3f mm fitted, %.0f ms\n", series, d.best.placed_m * 1e3,
                d.best.fitted_m * 1e3, timed.total_ms);
    EXPECT_FALSE(d.changed) << words(c.cell, d);
    // And finds a joint reversed in it.
    c.measured.q.col(2) *= -1.0;
    const Detection reversed = detect_convention(c.cell, c.measured);
    ASSERT_TRUE(reversed.changed);
    EXPECT_TRUE(reversed.best.convention.reversed[2]) << words(c.cell, reversed);
  }
}

}  // namespace
}  // namespace plumb::offline
